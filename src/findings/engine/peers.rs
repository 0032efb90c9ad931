//! Kinds that are not linear: beside what was found every rival was compared by its straight line, about another cause. The
//! nearest are fitted until they arrive, too, and weighed by what they are worth there.

use super::choice::HOPELESS;
use super::diagnosis::{Found, Names};
use super::rounds::{BETTER, Course, bent, names, only, refitted};
use super::statement::Statement;

/// How many rivals are tried. A choice for time: of 38 milled parts by strangers four within 16 nats missed one pair that six within
/// [`HOPELESS`] find. No other number was tried.
const TRIED: usize = 6;

/// What was found, weighed beside its rivals where each has arrived; `first`: the statement about nothing.
pub(super) fn beside_peers(course: &Course, first: &mut Statement, best: Found) -> Found {
    let again = course.stated(&best.blamed, &best.uncertain);
    let own = names(&best.blamed);
    let bent = bent(first, &again);
    if own.is_empty() || bent <= BETTER {
        return best;
    }
    let found = course.about(&again);
    if names(&found.blamed) != own {
        return best;
    }
    let near = near(&found, &own, bent).into_iter();
    let peers = near.filter_map(|names| {
        let alone = only(first, &names, |s| course.about(s));
        let alone = refitted(course, (&names, alone))?;
        Some((worth(&alone, &names)?, names, alone))
    });
    let peers: Vec<(f64, Names, Found)> = peers.collect();
    weighed(course, (again, found), &peers).unwrap_or(best)
}

/// Sets that differ from the one that was found by one cause, and are not further behind than what was found is `bent`, best first.
fn near(found: &Found, own: &Names, bent: f64) -> Vec<Names> {
    let Some(most) = of(found, own) else {
        return Vec::new();
    };
    let is_peer = |set: &&(Names, f64)| {
        let others = set.0.iter().filter(|n| !own.contains(n)).count();
        set.0.len() == own.len() && others == 1 && set.1 > most - bent.min(HOPELESS)
    };
    let mut sets: Vec<&(Names, f64)> = found.evidence.iter().filter(is_peer).collect();
    sets.sort_by(|a, b| b.1.total_cmp(&a.1));
    sets.iter().take(TRIED).map(|s| s.0.clone()).collect()
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
