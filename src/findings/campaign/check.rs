//! What one experiment found, held against the others: a cause must explain every experiment in which it
//! would show.

use crate::findings::answer::Answer;

/// What a robot extended by one experiment means for another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Agreement {
    /// The other experiment is predicted better.
    Confirmed,
    /// It is predicted worse.
    Contradicted,
    /// It cannot see the difference.
    Unseen,
}

/// One experiment held against what another found.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// Where the causes come from.
    pub from: String,
    /// The causes, as `missing_tilt at A2-tilt`.
    pub causes: Vec<String>,
    /// What they are held against.
    pub against: String,
    /// Error there before, in `unit`.
    pub before: f64,
    /// With the extended robot; nothing was fitted to this experiment.
    pub after: f64,
    /// Unit of both.
    pub unit: &'static str,
    /// What that means.
    pub agreement: Agreement,
}

/// Relative change of an error below which nothing is confirmed and nothing contradicted.
const NOTICEABLE: f64 = 0.05;

impl Check {
    /// `before` and `after`: errors of the other experiment under the two robots.
    pub fn new(from: (&str, &Answer), against: (&str, &Answer), after: &Answer) -> Self {
        let before = against.1.discrepancy.rms;
        let change = after.discrepancy.rms / before - 1.0;
        Self {
            from: from.0.into(),
            causes: named(from.1),
            against: against.0.into(),
            before,
            after: after.discrepancy.rms,
            unit: against.1.unit,
            agreement: match change {
                change if change < -NOTICEABLE => Agreement::Confirmed,
                change if change > NOTICEABLE => Agreement::Contradicted,
                _ => Agreement::Unseen,
            },
        }
    }

    /// What the check says, in words.
    pub fn word(&self) -> &'static str {
        match self.agreement {
            Agreement::Confirmed => "confirmed",
            Agreement::Contradicted => "contradicted",
            Agreement::Unseen => "not seen there",
        }
    }
}

/// What an answer names, as `drive_stiffness at A2`; of a group its first member.
pub fn named(answer: &Answer) -> Vec<String> {
    let causes = answer.causes.iter().map(|c| (c.effect, c.site.as_str()));
    let groups = answer.groups.iter().filter_map(|g| {
        let site = g.sites.first().map_or("", String::as_str);
        g.effects.first().map(|effect| (*effect, site))
    });
    let said = |(effect, site): (&str, &str)| format!("{effect} at {site}");
    causes.chain(groups).map(said).collect()
}
