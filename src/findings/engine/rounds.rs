//! Kinds that are not linear: what was found is stated anew until it settles, and then without each of its causes.

use super::bend::{bent, left_by};
use super::diagnosis::{Found, Names, Raised, about, shown, stated};
use super::judgement::Judgement;
use super::materiality::in_noise;
use super::peers::beside_peers;
use super::statement::{Blamed, Experiment, Peers, Statement, Suspect};
use crate::findings::answer::{Discrepancy, Verdict};
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

/// Rounds in which causes have to arrive in the place of a pattern: a choice for time, no measurement; no other number was tried.
const WIDER: usize = 3;

/// What every round is asked of.
pub(super) struct Course<'a> {
    pub(super) experiment: &'a dyn Experiment,
    judgement: &'a Judgement,
    /// The reading of the first statement, about nothing.
    present: Vec<f64>,
}

impl Course<'_> {
    pub fn stated(&self, blamed: &[Blamed], uncertain: &[f64]) -> Statement {
        stated(self.experiment, blamed, uncertain)
    }

    fn stated_among(&self, blamed: &[Blamed], uncertain: &[f64], names: &Names) -> Statement {
        shown(self.experiment.state_among(blamed, uncertain, names))
    }

    /// Nats of what was found beyond the straight lines of the first statement. Where what is uncertain is not the same in all statements, their
    /// readings alone say so.
    pub fn bent(&self, [first, again]: [&Statement; 2], found: &Found) -> f64 {
        let amounts = match self.experiment.peers() {
            Peers::Near => Some((&found.blamed[..], &found.uncertain[..])),
            _ => None,
        };
        0.5 * squares(&bent([first, again], amounts), first)
    }

    /// Nats that what was found costs, stated about it: what it leaves, and how far it moves what is uncertain. Nothing where nobody asks.
    fn cost(&self, statement: &Statement, found: &Found) -> f64 {
        if self.experiment.peers() != Peers::Near {
            return 0.0;
        }
        let left = left_by(statement, (&found.blamed, &found.uncertain));
        left.map_or(f64::INFINITY, |left| {
            0.5 * squares(&left, statement) + found.strain
        })
    }

    pub fn about(&self, statement: &Statement) -> Found {
        self.about_raised(statement, &[])
    }

    pub fn about_raised(&self, statement: &Statement, raised: &Raised) -> Found {
        let statement = (statement, &self.present[..]);
        about(self.experiment, statement, raised, self.judgement)
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
    let far = rms(&told.left) > ASTRAY * rms(&best.left);
    if far || best.blamed.len() == 1 && bends(&course, &first, &best) {
        let other = others(&course, (&mut first, &told), &best);
        best = other.unwrap_or(best);
    }
    while let Some(simpler) = simpler(&course, &best) {
        best = simpler;
    }
    best = whole(&course, &best).unwrap_or(best);
    best = beside_peers(&course, &mut first, best);
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

/// Causes in the place of what a pattern takes: one whose place is sought by and by may be worth more once it has arrived. Only
/// where that leaves nothing.
fn whole(course: &Course, best: &Found) -> Option<Found> {
    let mut wider = best.wider.clone();
    for _ in 0..WIDER {
        let (lead, uncertain) = wider?;
        let statement = course.stated(&lead, &uncertain);
        let found = course.about(&statement);
        if found.answer.verdict == Verdict::Explained {
            let found = followed(course, (&statement, found));
            return (found.answer.verdict == Verdict::Explained).then_some(found);
        }
        wider = found.wider;
    }
    None
}

pub(super) fn names(causes: &[Blamed]) -> Names {
    causes.iter().map(|c| (c.effect, c.site.clone())).collect()
}

/// Other causes of those that came first in the first statement: its straight lines may lead away from what they explain once
/// they have arrived. Fewer that leave no more, or as many that leave less.
fn others(course: &Course, (first, told): (&mut Statement, &Found), best: &Found) -> Option<Found> {
    let mut sets: Vec<&(Names, f64)> = told.evidence.iter().collect();
    sets.sort_by(|a, b| b.1.total_cmp(&a.1));
    let own = names(&best.blamed);
    (1..=own.len()).find_map(|size| {
        let of_size = sets.iter().filter(|s| s.0.len() == size && s.0 != own);
        of_size.take(OTHERS).find_map(|(names, _)| {
            let alone = only(first, names, |s| course.about(s));
            let alone = refitted(course, (names, alone))?;
            match size < own.len() {
                true => instead(course, alone, best),
                false => better(course, first, alone, best),
            }
        })
    })
}

fn bends(course: &Course, first: &Statement, best: &Found) -> bool {
    let again = course.stated(&best.blamed, &best.uncertain);
    course.bent([first, &again], best) > BETTER
}

/// Squares of values over the rows, in noise deviations of a statement.
fn squares(values: &[f64], statement: &Statement) -> f64 {
    let weighted = in_noise(statement, values);
    weighted.iter().map(|v| v * v).sum()
}

/// As many causes, of which what they leave is so much more probable, nats: odds of twenty to one, as an interval of 95 % has
/// them. A choice, no measurement; no other number was tried.
pub(super) const BETTER: f64 = 3.0;

/// What is found from causes that were fitted alone, if that takes no more causes and leaves less; `first`: whose noise they
/// are seen in.
fn better(course: &Course, first: &Statement, alone: Found, best: &Found) -> Option<Found> {
    let most =
        squares(&best.left, first) * (1.0 - 2.0 * BETTER / first.reading.len().max(1) as f64);
    if squares(&alone.left, first) > most {
        return None;
    }
    let found = again(course, &alone);
    (found.blamed.len() <= best.blamed.len() && squares(&found.left, first) <= most)
        .then_some(found)
}

/// The same without one of its causes. A companion may stand for what the straight line of another missed on its way: without
/// it the others are fitted again until they arrive, and only then everybody competes once more.
fn simpler(course: &Course, best: &Found) -> Option<Found> {
    let without = |at: usize| {
        let mut kept = best.blamed.clone();
        kept.remove(at);
        let names = names(&kept);
        let mut statement = course.stated_among(&kept, &best.uncertain, &names);
        let alone = only(&mut statement, &names, |s| course.about(s));
        let alone = refitted(course, (&names, alone))?;
        instead(course, alone, best)
    };
    match best.blamed.len() {
        0 | 1 => None,
        count => (0..count).find_map(without),
    }
}

/// What is found from causes that were fitted alone, if that takes fewer causes and leaves no more, nor moves what is uncertain
/// so far from what is known of it that a cause is cheaper.
fn instead(course: &Course, alone: Found, best: &Found) -> Option<Found> {
    let most = WORSE * rms(&best.left);
    let strained = best.strain + course.judgement.further();
    let is_as_good = |found: &Found| rms(&found.left) <= most && found.strain <= strained;
    if !is_as_good(&alone) {
        return None;
    }
    let found = again(course, &alone);
    (found.blamed.len() < best.blamed.len() && is_as_good(&found)).then_some(found)
}

/// What is found where everybody competes beside causes that were fitted alone.
fn again(course: &Course, alone: &Found) -> Found {
    let statement = course.stated(&alone.blamed, &alone.uncertain);
    let found = course.about(&statement);
    followed(course, (&statement, found))
}

/// Something asked of a statement that has only some of its suspects.
pub(super) fn only<T>(
    statement: &mut Statement,
    names: &Names,
    ask: impl Fn(&Statement) -> T,
) -> T {
    let is_one = |s: &&Suspect| names.iter().any(|n| n.0 == s.effect && n.1 == s.site);
    let own = statement.suspects.iter().filter(is_one).cloned().collect();
    let all = std::mem::replace(&mut statement.suspects, own);
    let answer = ask(statement);
    statement.suspects = all;
    answer
}

/// These causes alone, fitted again until they arrive. None where one of them falls. Where rivals are seen to arrive ([`Peers::Near`]) what
/// a round costs is known once it is stated about: one that costs more than the best before went astray.
pub(super) fn refitted(course: &Course, (names, mut found): (&Names, Found)) -> Option<Found> {
    let (mut least, mut best) = (f64::INFINITY, None);
    for _ in 0..ROUNDS {
        if found.blamed.len() < names.len() {
            return None;
        }
        let mut statement = course.stated_among(&found.blamed, &found.uncertain, names);
        let cost = course.cost(&statement, &found);
        if cost > least + BETTER {
            break;
        }
        let next = only(&mut statement, names, |s| course.about(s));
        let arrived = is_same(&found.blamed, &next.blamed);
        found = next;
        if cost <= least {
            least = cost;
            best = Some(found.clone());
        }
        if arrived {
            return Some(found);
        }
    }
    best.filter(|best| best.blamed.len() == names.len())
}

fn is_same(a: &[Blamed], b: &[Blamed]) -> bool {
    let near = |(x, y): (&Blamed, &Blamed)| {
        let moved: Vec<f64> = x.part.iter().zip(&y.part).map(|(a, b)| a - b).collect();
        x.effect == y.effect && x.site == y.site && rms(&moved) <= ARRIVED * rms(&y.part)
    };
    a.len() == b.len() && a.iter().zip(b).all(near)
}
