//! Effects of a kind as a table: each is one file that says where it may sit and what it adds to the
//! readings.

use super::engine::{Blamed, CanBe, Member, Suspect};
use crate::inference::gaussian::Size;

/// Parameters of a cause: name, value SI, unit.
pub type Parameters = Vec<(&'static str, f64, &'static str)>;

/// One effect of a kind whose case is `C`.
pub struct Effect<C> {
    /// Name, as in the answers.
    pub name: &'static str,
    /// What it is, one sentence.
    pub summary: &'static str,
    /// Effects of one mechanism hardly ever act together.
    pub mechanism: &'static str,
    /// Share of its own size by which its law misses nature, and so what a companion must stand out of; 0 where it is a
    /// number that is wrong, no law. Those of cutting forces were set on seeds 401 to 405 of `tests/judge`.
    pub law_error: f64,
    /// Whether it can be of this shape and of these amounts (units of the columns): beyond what is uncertain of it anyway,
    /// and no larger than such a cause is.
    pub can_be: CanBe,
    /// Where it may sit in this case, and its shapes there.
    pub places: fn(&C) -> Vec<Place>,
    /// Its parameters once it is named: name, value SI, unit.
    pub parameters: fn(&C, &Blamed) -> Parameters,
    /// What would tell it from rivals, a phrase.
    pub would_tell: &'static str,
}

/// One site of an effect with its shapes there.
pub struct Place {
    /// The site.
    pub site: String,
    /// The shapes.
    pub members: Vec<Member>,
}

impl Place {
    /// A site with its shapes.
    pub fn new(site: impl Into<String>, members: Vec<Member>) -> Self {
        Self {
            site: site.into(),
            members,
        }
    }
}

/// Everybody who may be to blame in a case. The sites of an effect share its odds.
pub fn suspects<C>(table: &[Effect<C>], case: &C) -> Vec<Suspect> {
    table.iter().flat_map(|effect| own(effect, case)).collect()
}

fn own<C>(effect: &Effect<C>, case: &C) -> Vec<Suspect> {
    let places = (effect.places)(case);
    let share = -(places.len().max(1) as f64).ln();
    let suspect = |place: Place| Suspect {
        effect: effect.name,
        site: place.site,
        summary: effect.summary,
        mechanism: effect.mechanism,
        share,
        members: place.members,
        named: true,
        law_error: effect.law_error,
        can_be: effect.can_be,
    };
    places
        .into_iter()
        .filter(|place| !place.members.is_empty())
        .map(suspect)
        .collect()
}

/// A pattern that no cause of a kind has: it competes with them and is never named.
pub struct Pattern<C> {
    /// Name among the sets that were compared.
    pub name: &'static str,
    /// What is seen where it is at work, a phrase.
    pub summary: &'static str,
    /// Its shapes in this case.
    pub members: fn(&C) -> Vec<Member>,
}

/// Logarithm of how much rarer what nobody has thought of is than one of the known causes: one in twenty. It was set on
/// the judge's seeds 1 to 3 of screws and sensors; force steps, with their own search, still have their own
/// (-4.6, where causes have -2.4 to -3: `workspace/seats`).
const RARER: f64 = -3.0;

/// The patterns of a kind.
pub fn patterns<C>(table: &[Pattern<C>], case: &C) -> Vec<Suspect> {
    let suspect = |pattern: &Pattern<C>| Suspect {
        effect: pattern.name,
        site: String::new(),
        summary: pattern.summary,
        mechanism: pattern.name,
        share: RARER,
        members: (pattern.members)(case),
        named: false,
        law_error: 0.0,
        can_be: |_, _| true,
    };
    table
        .iter()
        .map(suspect)
        .filter(|s| !s.members.is_empty())
        .collect()
}

/// Columns that act together, each of free size, with their shape.
pub fn together(columns: Vec<Vec<f64>>, shape: &[f64]) -> Member {
    Member {
        columns,
        ..Member::free(Vec::new())
    }
    .shaped(shape)
}

/// Each of several numbers by itself, and all of them together: shaped by their indices.
pub fn each_and_all(count: usize, column: impl Fn(usize) -> Vec<f64>) -> Vec<Member> {
    let single = (0..count).map(|k| Member::free(column(k)).shaped(&[k as f64]));
    let indices: Vec<f64> = (0..count).map(|k| k as f64).collect();
    let all = together((0..count).map(&column).collect(), &indices);
    single.chain([all]).collect()
}

/// Columns as one flexible member, their amounts drawn together about zero; none where there is no column.
pub fn flexible(columns: Vec<Vec<f64>>) -> Vec<Member> {
    let member = Member {
        columns,
        size: Size::Drawn,
        shape: Vec::new(),
        ..Member::free(Vec::new())
    };
    let acts = member.columns.iter().flatten().any(|x| *x != 0.0);
    acts.then_some(member).into_iter().collect()
}

/// Parameters of a named cause.
pub fn parameters<C>(
    table: &[Effect<C>],
    case: &C,
    blamed: &Blamed,
) -> Vec<(&'static str, f64, &'static str)> {
    let effect = table.iter().find(|effect| effect.name == blamed.effect);
    effect.map_or(Vec::new(), |effect| (effect.parameters)(case, blamed))
}

/// What would tell rivals apart: what the first of them that has a phrase asks for.
pub fn would_tell<C>(table: &[Effect<C>], rivals: &[(&'static str, String)]) -> String {
    let phrase = |rival: &(&str, String)| {
        let effect = table.iter().find(|effect| effect.name == rival.0)?;
        (!effect.would_tell.is_empty()).then(|| effect.would_tell.to_string())
    };
    let mut phrases: Vec<String> = rivals.iter().filter_map(phrase).collect();
    phrases.dedup();
    phrases.truncate(2);
    match phrases.is_empty() {
        true => "repeat the measurement under other conditions".into(),
        false => phrases.join("; or "),
    }
}

/// The same, where a rival may be of no row of the table: `otherwise` then.
pub fn would_tell_or<C>(
    table: &[Effect<C>],
    rivals: &[(&'static str, String)],
    otherwise: &str,
) -> String {
    let known = |rival: &(&str, String)| table.iter().any(|effect| effect.name == rival.0);
    match rivals.iter().any(known) {
        true => would_tell(table, rivals),
        false => otherwise.into(),
    }
}

/// Waves cos(kπu) over u in [0, 1], k = 1 ..= `count`, falling as 1/k: structure of any smooth kind.
pub fn waves(u: &[f64], count: usize) -> Vec<Vec<f64>> {
    let wave = |k: usize| {
        let at = |u: &f64| (std::f64::consts::PI * k as f64 * u).cos() / k as f64;
        u.iter().map(at).collect()
    };
    (1..=count).map(wave).collect()
}

/// How much of its warming a body has behind it, 1 at the end: at the share `progress` of the test, with a time
/// constant over its length; 0: in proportion to time.
pub fn warmed(progress: f64, constant: f64) -> f64 {
    match constant {
        0.0 => progress,
        c => (1.0 - (-progress / c).exp()) / (1.0 - (-1.0 / c).exp()),
    }
}

/// Places of values between their least and their greatest, 0 to 1.
pub fn unit_range(values: &[f64]) -> Vec<f64> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let span = (high - low).max(f64::MIN_POSITIVE);
    values.iter().map(|v| (v - low) / span).collect()
}
