//! The searches of a tuning and where they end: from many starts on some of the lines, from where dampings
//! are exchanged, then on all lines from where that ended well.

use super::frf_data::Measured;
use super::frf_identifiability::{Place, inverse, uncertainty};
use super::frf_linear::{Linearised, linearise};
use super::frf_nuisance::{Pull, pulls};
use super::frf_rivals::rivals;
use super::frf_search::{Run, SHARE, descend};
use super::frf_starts::{starts, thinned};
use super::frf_tuning::{Tuned, Tuning, check, freedom, matches, pairs, singular};
use crate::ground::problem::Outcome;
use crate::inference::descent::Stop;
use rayon::prelude::*;

/// Weighted sum of squares within which another minimum explains the data as well as the best: four
/// standard deviations. Springs in series about nearly the same axis have two solutions for their
/// dampings, which only the third order in frequency tells apart.
const RIVAL: f64 = 16.0;

/// The search on all lines.
const SEARCH: Stop = Stop {
    steps: 200,
    gain: 1e-4,
    share: SHARE,
    promise: 0.0,
};
/// Lines per pair on which is searched first.
const LINES: usize = 64;
/// That search: what ends it here is followed on all lines.
const FIRST: Stop = Stop {
    steps: 200,
    gain: 1e-2,
    share: SHARE,
    promise: 0.0,
};
/// At most so many places of that search are followed on all lines: those that are further apart in some
/// logarithm than this.
const PLACES: usize = 4;
const APART: f64 = 0.05;
/// How often a better solution found by exchanging dampings is exchanged in turn.
const EXCHANGES: usize = 3;
/// Gain in cost from which on a solution is a better one.
const ENOUGH: f64 = 0.1;

/// A task solved: where its descents ended.
pub(super) struct Solved {
    runs: Vec<Run>,
    agreeing_starts: f64,
    /// The normal equations at the best place.
    at: Linearised,
}

/// A search that has begun: where descents from all starts ended on some of the lines.
pub(super) struct Begun {
    thin: Tuning,
    solved: Solved,
}

impl Begun {
    /// Where the nuisances went.
    pub(super) fn pulls(&self) -> Vec<Pull> {
        self.solved.pulls(&self.thin)
    }

    /// Whether the model is further from these lines than one that never moves.
    pub(super) fn worse_than_nothing(&self) -> bool {
        self.solved.worse_than_nothing(&self.thin)
    }

    /// Weighted sum of squares over the degrees of freedom of these lines.
    pub(super) fn reduced_chi_square(&self) -> f64 {
        self.solved.at.cost / freedom(&self.thin)
    }
}

/// Descends from all starts on some of the lines.
pub(super) fn begin(task: &Tuning) -> Outcome<Begun> {
    check(task)?;
    let thin = thinned(task, LINES);
    let mut runs = descents(&thin, starts(task), FIRST);
    let solved = Solved {
        agreeing_starts: agreeing(&runs),
        at: at_best(&thin, &mut runs)?,
        runs,
    };
    Ok(Begun { thin, solved })
}

/// Solves the task.
pub(super) fn solve(task: &Tuning) -> Outcome<Solved> {
    finish(task, begin(task)?)
}

/// Descends from where dampings are exchanged, on the same lines; then on all from where that ended well.
pub(super) fn finish(task: &Tuning, begun: Begun) -> Outcome<Solved> {
    let thin = begun.thin;
    let Solved {
        mut runs,
        agreeing_starts,
        mut at,
    } = begun.solved;
    for _ in 0..EXCHANGES {
        let cost = at.cost;
        let near = rivals(task, &runs[0].0, &inverse(&at.normal));
        runs.extend(descents(&thin, near, FIRST));
        at = at_best(&thin, &mut runs)?;
        if at.cost > cost - ENOUGH {
            break;
        }
    }
    let mut runs = descents(task, distinct(task, runs), SEARCH);
    let at = at_best(task, &mut runs)?;
    Ok(Solved {
        runs,
        agreeing_starts,
        at,
    })
}

/// The places of the best runs (sorted) that differ in what is asked for.
fn distinct(task: &Tuning, runs: Vec<Run>) -> Vec<Vec<f64>> {
    let count = task.asked_for();
    let apart = |a: &[f64], b: &[f64]| {
        let each = a[..count].iter().zip(&b[..count]);
        each.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let enough = runs.first().map_or(0.0, |best| 1.5 * best.1 + RIVAL);
    let mut kept: Vec<Vec<f64>> = Vec::new();
    for (theta, _) in runs.into_iter().filter(|run| run.1 <= enough) {
        if kept.len() < PLACES && kept.iter().all(|other| apart(&theta, other) > APART) {
            kept.push(theta);
        }
    }
    kept
}

/// Where searches from `starts` end.
fn descents(task: &Tuning, starts: Vec<Vec<f64>>, stop: Stop) -> Vec<Run> {
    let runs = starts
        .into_par_iter()
        .map(|start| descend(task, start, stop));
    runs.collect::<Vec<_>>().into_iter().flatten().collect()
}

/// Sorts the runs, the best first, and linearises there.
fn at_best(task: &Tuning, runs: &mut [Run]) -> Outcome<Linearised> {
    runs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let best = runs.first();
    best.and_then(|run| linearise(task, &run.0))
        .ok_or_else(singular)
}

/// Share of the runs that reached the best cost (within 1 %).
fn agreeing(runs: &[Run]) -> f64 {
    let lowest = runs.iter().map(|run| run.1).fold(f64::INFINITY, f64::min);
    let near = |run: &&Run| run.1 <= 1.01 * lowest + 1e-12;
    runs.iter().filter(near).count() as f64 / runs.len().max(1) as f64
}

impl Solved {
    /// Logarithms of the best solution.
    fn theta(&self) -> &[f64] {
        &self.runs[0].0
    }

    /// Whether the model is further from the FRFs than one that never moves: no prior mends that.
    pub(super) fn worse_than_nothing(&self, task: &Tuning) -> bool {
        let size = |pair: &Measured| {
            let each = pair.frf.iter().zip(pair.weight());
            each.map(|(h, w)| (h * w).norm_sqr()).sum::<f64>()
        };
        self.at.cost > pairs(task).map(|(_, pair)| size(pair)).sum()
    }

    /// Where the nuisances went.
    pub(super) fn pulls(&self, task: &Tuning) -> Vec<Pull> {
        pulls(task, self.theta(), &self.at.normal)
    }

    /// What the solution says.
    pub(super) fn told(&self, task: &Tuning) -> Tuned {
        let freedom = freedom(task);
        let reduced = self.at.cost / freedom;
        let near = |run: &&Run| run.1 <= self.at.cost + RIVAL * reduced.max(1.0);
        let rivals: Vec<&[f64]> = self.runs.iter().filter(near).map(|r| &r.0[..]).collect();
        let values = task.values(self.theta());
        let place = Place {
            task,
            theta: self.theta(),
            at: &self.at,
        };
        Tuned {
            uncertainty: uncertainty(place, &rivals, (reduced, freedom)),
            reduced_chi_square: reduced,
            matches: matches(task, &values),
            agreeing_starts: self.agreeing_starts,
            pulls: self.pulls(task),
            worse_than_nothing: self.worse_than_nothing(task),
            values,
        }
    }
}
