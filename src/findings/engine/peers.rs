//! Kinds that are not linear: beside what was found every rival was compared by its straight line, about another cause. The
//! nearest are fitted until they arrive, too, and weighed by what they are worth there.

use super::choice::HOPELESS;
use super::diagnosis::{Found, Names};
use super::rounds::{BETTER, Course, names, only, refitted};
use super::statement::{Peers, Statement};

/// How many rivals are tried. A choice for time: of 38 milled parts by strangers four within 16 nats missed one pair that six within
/// [`HOPELESS`] find. No other number was tried.
const TRIED: usize = 6;

/// What was found, weighed beside its rivals where each has arrived; `first`: the statement about nothing.
pub(super) fn beside_peers(course: &Course, first: &mut Statement, best: Found) -> Found {
    let (own, kin) = (names(&best.blamed), Kin::of(first));
    let may_have = match course.experiment.peers() {
        Peers::Nobody => false,
        Peers::Kin => kin.any(&own),
        Peers::Near => !own.is_empty(),
    };
    if !may_have {
        return best;
    }
    let again = course.stated(&best.blamed, &best.uncertain);
    let bent = course.bent([first, &again], &best);
    // straight kin may be the same on another way
    let is_straight = bent <= BETTER && course.experiment.peers() == Peers::Near;
    if is_straight {
        return best;
    }
    let found = course.about(&again);
    if names(&found.blamed) != own {
        return best;
    }
    let near = near(course, (&found, &own), &kin, bent).into_iter();
    let peers = near.filter_map(|names| {
        let alone = only(first, &names, |s| course.about(s));
        let alone = refitted(course, (&names, alone))?;
        Some((worth(&alone, &names)?, names, alone))
    });
    let peers: Vec<(f64, Names, Found)> = peers.collect();
    weighed(course, (again, found), &peers).unwrap_or(best)
}

/// Sets that differ from the one that was found by one cause, best first: not further behind than what was found is `bent`, or, where
/// kin is asked for, of the same mechanism, however far. Kin make much the same of the readings, and the straight line of one about
/// another says least.
fn near(course: &Course, (found, own): (&Found, &Names), kin: &Kin, bent: f64) -> Vec<Names> {
    let Some(most) = of(found, own) else {
        return Vec::new();
    };
    let is_near = |set: &&(Names, f64)| {
        let mut others = set.0.iter().filter(|n| !own.contains(n));
        let (Some(other), None) = (others.next(), others.next()) else {
            return false;
        };
        set.0.len() == own.len()
            && match course.experiment.peers() {
                Peers::Nobody => false,
                Peers::Near => set.1 > most - bent.min(HOPELESS),
                Peers::Kin => own
                    .iter()
                    .any(|n| !set.0.contains(n) && kin.are(n.0, other.0)),
            }
    };
    let mut sets: Vec<&(Names, f64)> = found.evidence.iter().filter(is_near).collect();
    sets.sort_by(|a, b| b.1.total_cmp(&a.1));
    sets.iter().take(TRIED).map(|s| s.0.clone()).collect()
}

/// Effects of a statement with their mechanisms.
struct Kin(Vec<(&'static str, &'static str)>);

impl Kin {
    fn of(statement: &Statement) -> Self {
        let named = statement.suspects.iter().filter(|s| s.named);
        Self(named.map(|s| (s.effect, s.mechanism)).collect())
    }

    /// Whether two effects have one mechanism.
    fn are(&self, one: &str, other: &str) -> bool {
        let mechanism = |name: &str| self.0.iter().find(|e| e.0 == name).map(|e| e.1);
        mechanism(one).is_some() && mechanism(one) == mechanism(other)
    }

    /// Whether any of these has kin.
    fn any(&self, names: &Names) -> bool {
        let has = |name: &str| self.0.iter().any(|e| e.0 != name && self.are(e.0, name));
        names.iter().any(|n| has(n.0))
    }
}

/// Everybody compared about what was found, peers at what they are worth where they have arrived; about the best of them, if one
/// leads then.
fn weighed(
    course: &Course,
    (again, found): (Statement, Found),
    peers: &[(f64, Names, Found)],
) -> Option<Found> {
    let raised = raised(&found, peers.iter().map(|p| (&p.1, p.0)));
    if raised.is_empty() {
        return None;
    }
    let told = course.about_raised(&again, &raised);
    let lead = names(&told.lead);
    let Some(leader) = peers.iter().find(|p| p.1 == lead) else {
        return Some(told);
    };
    let own = names(&found.blamed);
    let before = worth(&found, &own)?;
    let statement = course.stated(&leader.2.blamed, &leader.2.uncertain);
    let found = course.about(&statement);
    let others = peers.iter().map(|p| (&p.1, p.0)).chain([(&own, before)]);
    let raised = self::raised(&found, others);
    Some(course.about_raised(&statement, &raised))
}

/// By how much each set is worth more than one statement says.
fn raised<'a>(found: &Found, sets: impl Iterator<Item = (&'a Names, f64)>) -> Vec<(Names, f64)> {
    let more = |(names, value): (&'a Names, f64)| {
        let said = worth(found, names)?;
        Some((names.clone(), value - said))
    };
    sets.filter_map(more).collect()
}

/// ln E of a set that was compared.
fn worth(found: &Found, names: &Names) -> Option<f64> {
    Some(found.nothing + of(found, names)?)
}

/// The same over that of no cause.
fn of(found: &Found, names: &Names) -> Option<f64> {
    let set = found.evidence.iter().find(|set| set.0 == *names);
    set.map(|set| set.1)
}
