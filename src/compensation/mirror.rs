//! The mirror: what the simulation leaves is taken away, again and again (source 004). The cut answers a
//! correction, at some places more strongly than it should, and a swing with another phase: what earlier trials
//! answered tells the next step place by place (`trials`).

use super::answering::{Answers, STEP_S, samples};
use super::correction::Correction;
use super::method::{Search, Task};
use super::near::{Left, before_and_in, near};
use super::remaining::{Size, Station, Times, remaining};
use super::trials::{Trial, Trials};
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, add, scale, sub};
use crate::process::setup::{Setup, Support};
use crate::process::way::{Way, normal_part};

/// Most trials: a choice for time.
const ROUNDS: usize = 7;
/// Change of the correction, against the largest deviation, at which it stands still.
const STILL: f64 = 1e-2;
/// The same where it is said that the mirror has converged: swings never stand quite still.
const SETTLED: f64 = 5e-2;
/// A round that lowers neither the largest deviation nor the root mean square by this share gains nothing ...
const GAIN: f64 = 0.03;
/// ... and after so many of them the best is kept: a mix of few trials may leave more before it leaves less.
const PATIENCE: usize = 4;
/// How much more coarsely the cut is resolved while learning: with 1, 2 and 4 nine rounds left 0.190, 0.198 and 0.232 mm of the
/// example's part, and steps that differ by rounding alone 0.182 to 0.214 mm after seven.
const COARSER: f64 = 2.0;
/// Share of what is left that is taken away at once where masses swing.
const CAREFUL: f64 = 0.9;

/// What the simulation leaves is mirrored: straight where springs alone carry the tool; where robot and cut
/// are coupled in time, through the inverse of how the tip answers a command. The best of the corrections is kept.
pub(super) fn mirror(task: &Task, none: Correction) -> Outcome<Search> {
    let mut best = Best::of(none.clone());
    let mut trials = Trials::default();
    let mut tried = none;
    let mut last_change_m = f64::INFINITY;
    let mut idle = 0;
    let milling = Milling::of(task)?;
    for round in 1..=ROUNDS {
        let trial = match milling.with(&tried) {
            Err(problem) if round == 1 => return Err(problem),
            // too far: the best that was milled stands
            Err(_) => break,
            Ok(trial) => trial,
        };
        let gained = best.with(&tried, &trial);
        idle = if gained { 0 } else { idle + 1 };
        // a small step from a trial that left more is a mix that has not found its way yet
        let still = (gained || idle > 1) && last_change_m <= STILL * best.first_m;
        if still || idle >= PATIENCE || round == ROUNDS {
            break;
        }
        let next = trials.after(&tried, &trial);
        last_change_m = next.farthest(&tried);
        tried = next;
    }
    Ok(Search {
        converged: last_change_m <= SETTLED * best.first_m,
        correction: best.correction,
        iterations: best.milled,
        last_change_m,
    })
}

/// The best correction of the whole path so far.
struct Best {
    correction: Correction,
    /// Largest deviation times root mean square that it leaves, m². Where joints slip the largest alone is mostly chance: between
    /// late trials of the example's part it went to and fro by a fifth while the root mean square fell. Both choose the same trial there.
    product: f64,
    /// Largest deviation and root mean square, the least of each, m.
    least: [f64; 2],
    /// Largest deviation without correction, m.
    first_m: f64,
    /// Trials.
    milled: usize,
}

impl Best {
    fn of(correction: Correction) -> Self {
        Self {
            correction,
            product: f64::INFINITY,
            least: [f64::INFINITY; 2],
            first_m: f64::INFINITY,
            milled: 0,
        }
    }

    /// Takes a trial; whether it gains.
    fn with(&mut self, tried: &Correction, trial: &Trial) -> bool {
        let before = self.least;
        let size = Size::of(&trial.stations);
        if self.milled == 0 {
            self.first_m = size.max_m;
        }
        let product = size.max_m * size.rms_m;
        if product < self.product {
            (self.product, self.correction) = (product, tried.clone());
        }
        self.least = [self.least[0].min(size.max_m), self.least[1].min(size.rms_m)];
        self.milled += 1;
        let mut pairs = self.least.iter().zip(before);
        pairs.any(|(now, before)| *now < (1.0 - GAIN) * before)
    }
}

/// The part milled with a correction.
struct Milling<'a> {
    task: &'a Task<'a>,
    /// The model, the cut resolved less finely.
    quick: Setup,
    /// How robot and cut answer a command, where they are coupled in time.
    answers: Option<Answers>,
}

impl<'a> Milling<'a> {
    fn of(task: &'a Task<'a>) -> Outcome<Self> {
        let coupled = task.support == Support::Coupled;
        let answers = coupled.then(|| Answers::of(task.setup, &task.plan.cell.chain));
        Ok(Self {
            task,
            quick: task.setup.coarser(COARSER),
            answers: answers.transpose()?,
        })
    }

    fn with(&self, tried: &Correction) -> Outcome<Trial> {
        let way = (self.task.way_of)(tried)?;
        let job = Setup {
            way: way.clone(),
            ..self.quick.clone()
        };
        let (milled, _) = job.run(self.task.support, |_| {})?;
        let stations = remaining(&milled, &self.task.plan.path);
        Ok(Trial {
            update: self.update(&stations, &way),
            stations,
        })
    }

    /// What is to be taken away at ascending arc lengths.
    fn update(&self, stations: &[Station], way: &Way) -> Vec<(f64, V3)> {
        let Some(answers) = &self.answers else {
            return near(stations).iter().map(|l| (l.s_m, l.left)).collect();
        };
        let left = before_and_in(stations);
        let begin = way.span()[0];
        let times = (0..samples(way)).map(|i| begin + STEP_S * i as f64);
        let wanted: Vec<V3> = times.clone().map(|t| at(&left, t)).collect();
        let drawn = &self.task.setup.way;
        let mut drawn_at = Times::of(drawn);
        let mut update: Vec<(f64, V3)> = Vec::new();
        for (time, told) in times.zip(answers.command(&wanted)) {
            let s = way.at(time).s_m;
            if update.last().is_none_or(|last| s > last.0) {
                let normal = normal_part(told, drawn.feed(drawn_at.at(s)));
                update.push((s, scale(CAREFUL, normal)));
            }
        }
        update
    }
}

/// Linear between stations, nothing outside.
fn at(left: &[Left], time_s: f64) -> V3 {
    let after = left.partition_point(|l| l.time_s < time_s);
    let (Some(a), Some(b)) = (
        after.checked_sub(1).and_then(|i| left.get(i)),
        left.get(after),
    ) else {
        return [0.0; 3];
    };
    let share = (time_s - a.time_s) / (b.time_s - a.time_s);
    add(a.left, scale(share, sub(b.left, a.left)))
}
