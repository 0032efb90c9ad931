//! Kinds that are not linear: what was found is stated anew until it settles, and then without each of its causes.

use super::diagnosis::{Found, about, stated};
use super::judgement::Judgement;
use super::statement::{Blamed, Experiment, Statement, Suspect};
use crate::findings::answer::Discrepancy;
use crate::ground::stats::rms;

/// Rounds in which a kind that is not linear is stated anew about what was found.
const ROUNDS: usize = 6;
/// Change of what every cause adds, as a share of it, at which a round has arrived.
const ARRIVED: f64 = 0.03;
/// A round that leaves so much more than the best before went astray ...
const ASTRAY: f64 = 1.15;
/// ... and one that leaves so much more is not the answer, though a later one may be. Little more than a companion must
/// gain (`Judgement::companion_gain`), so that a later round may drop one; at 1.15 a later round told structure
/// where an earlier one had found the chatter (seed 434 of `tests/judge`).
const WORSE: f64 = 1.02;

/// Sets of every size that are fitted alone where the first statement was far from straight: the best of it. A choice for
/// time, no measurement; no other number was tried.
const OTHERS: usize = 4;

/// What every round is asked of.
struct Course<'a> {
    experiment: &'a dyn Experiment,
    judgement: &'a Judgement,
    /// The reading of the first statement, about nothing.
    present: Vec<f64>,
}

impl Course<'_> {
    fn stated(&self, blamed: &[Blamed], uncertain: &[f64]) -> Statement {
        stated(self.experiment, blamed, uncertain)
    }

    fn about(&self, statement: &Statement) -> Found {
        about(self.experiment, (statement, &self.present), self.judgement)
    }
}

/// What is found once it has settled, and needs all of its causes; `first`: the first statement with what it told.
pub(super) fn settled(
    experiment: &dyn Experiment,
    (mut first, told): (Statement, Found),
    judgement: &Judgement,
) -> Found {
    let course = Course {
        experiment,
        judgement,
        present: first.reading.clone(),
    };
    let mut best = followed(&course, (&first, told.clone()));
    if rms(&told.left) > ASTRAY * rms(&best.left) {
        let other = fewer(&course, (&mut first, &told), &best);
        best = other.unwrap_or(best);
    }
    while let Some(simpler) = simpler(&course, &best) {
        best = simpler;
    }
    // what is missed is that of the simulation as it was; the noise is what stays beside what was found
    let noise_rms = best.answer.discrepancy.noise_rms;
    best.missed = told.missed;
    best.answer.discrepancy = Discrepancy {
        noise_rms,
        ..told.answer.discrepancy
    };
    best
}

/// States what was found anew, round by round; the round that leaves least.
fn followed(course: &Course, (first, mut found): (&Statement, Found)) -> Found {
    let (mut best, mut least) = (found.clone(), rms(&found.left));
    let mut last: Option<Statement> = None;
    for _ in 0..ROUNDS {
        let statement = course.stated(&found.lead, &found.uncertain);
        if course
            .experiment
            .is_settled(last.as_ref().unwrap_or(first), &statement)
        {
            break;
        }
        let next = course.about(&statement);
        let left = rms(&next.left);
        if left > ASTRAY * least {
            break;
        }
        let arrived = is_same(&found.lead, &next.lead);
        found = next;
        if left <= WORSE * least {
            best = found.clone();
        }
        least = least.min(left);
        // stated about it, a cause that was found was none
        if arrived || found.lead.is_empty() {
            break;
        }
        last = Some(statement);
    }
    best
}

/// Effects with their sites.
type Names = Vec<(&'static str, String)>;

fn names(causes: &[Blamed]) -> Names {
    causes.iter().map(|c| (c.effect, c.site.clone())).collect()
}

/// Fewer causes that leave no more, of those that came first in the first statement: its straight lines may lead away from
/// what one cause alone explains once it has arrived.
fn fewer(course: &Course, (first, told): (&mut Statement, &Found), best: &Found) -> Option<Found> {
    let mut sets: Vec<&(Names, f64)> = told.evidence.iter().collect();
    sets.sort_by(|a, b| b.1.total_cmp(&a.1));
    (1..best.blamed.len()).find_map(|size| {
        let own = sets.iter().filter(|s| s.0.len() == size).take(OTHERS);
        own.into_iter().find_map(|(names, _)| {
            let alone = only(first, names, |s| course.about(s));
            let alone = refitted(course, (names, alone))?;
            instead(course, alone, best)
        })
    })
}

/// The same without one of its causes. A companion may stand for what the straight line of another missed on its way: without
/// it the others are fitted again until they arrive, and only then everybody competes once more.
fn simpler(course: &Course, best: &Found) -> Option<Found> {
    let without = |at: usize| {
        let mut kept = best.blamed.clone();
        kept.remove(at);
        let names = names(&kept);
        let mut statement = course.stated(&kept, &best.uncertain);
        let alone = only(&mut statement, &names, |s| course.about(s));
        let alone = refitted(course, (&names, alone))?;
        instead(course, alone, best)
    };
    match best.blamed.len() {
        0 | 1 => None,
        count => (0..count).find_map(without),
    }
}

/// What is found from causes that were fitted alone, if that takes fewer causes and leaves no more.
fn instead(course: &Course, alone: Found, best: &Found) -> Option<Found> {
    let most = WORSE * rms(&best.left);
    if rms(&alone.left) > most {
        return None;
    }
    let statement = course.stated(&alone.blamed, &alone.uncertain);
    let found = course.about(&statement);
    let found = followed(course, (&statement, found));
    (found.blamed.len() < best.blamed.len() && rms(&found.left) <= most).then_some(found)
}

/// Something asked of a statement that has only some of its suspects.
fn only<T>(statement: &mut Statement, names: &Names, ask: impl Fn(&Statement) -> T) -> T {
    let is_one = |s: &&Suspect| names.iter().any(|n| n.0 == s.effect && n.1 == s.site);
    let own = statement.suspects.iter().filter(is_one).cloned().collect();
    let all = std::mem::replace(&mut statement.suspects, own);
    let answer = ask(statement);
    statement.suspects = all;
    answer
}

/// These causes alone, fitted again until they arrive. None where one of them falls.
fn refitted(course: &Course, (names, mut found): (&Names, Found)) -> Option<Found> {
    for _ in 0..ROUNDS {
        if found.blamed.len() < names.len() {
            return None;
        }
        let mut statement = course.stated(&found.blamed, &found.uncertain);
        let next = only(&mut statement, names, |s| course.about(s));
        let arrived = is_same(&found.blamed, &next.blamed);
        found = next;
        if arrived {
            return Some(found);
        }
    }
    (found.blamed.len() == names.len()).then_some(found)
}

fn is_same(a: &[Blamed], b: &[Blamed]) -> bool {
    let near = |(x, y): (&Blamed, &Blamed)| {
        let moved: Vec<f64> = x.part.iter().zip(&y.part).map(|(a, b)| a - b).collect();
        x.effect == y.effect && x.site == y.site && rms(&moved) <= ARRIVED * rms(&y.part)
    };
    a.len() == b.len() && a.iter().zip(b).all(near)
}
