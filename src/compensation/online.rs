//! Correction while cutting (source 002): a force sensor, filters, a compliance model and a robot that
//! follows; with pilot forces from the simulation, hybrid.
//!
//! The controller hears the force of the cut that it changes. Both are brought together by relaxation:
//! mill, compute what the controller would have done about these forces, mill again, until the correction
//! no longer changes; what acts is 100 ms late, so that this arrives after a few rounds.

use super::correction::Correction;
use super::method::{Search, Task, with};
use crate::ground::problem::Outcome;
use crate::ground::random::Random;
use crate::ground::spatial::{V3, add, norm, scale, sub};
use crate::process::run::Outcome as Milled;
use crate::process::way::normal_part;
use std::collections::VecDeque;

/// Cycle of the correction, s (source 002, section 2.2).
const CYCLE_S: f64 = 4e-3;
/// Time constant of the low pass on the force, s.
const LOW_PASS_S: f64 = 16e-3;
/// Cycles of the moving average: 64 ms.
const AVERAGED: usize = 16;
/// Cycles from a force to the drives: one of the correction, three of the robot's controller.
const DEAD: usize = 4;
/// Time constant of the drives, s. With dead time and filters the reaction takes 16 + 32 + 16 + 60 =
/// 124 ms, of the 100 to 150 ms of source 002, section 2.3.
const DRIVES_S: f64 = 60e-3;
/// Cycle of the robot's controller, within which an estimate acts (source 002, section 2.3), s.
const INTERPOLATED_S: f64 = 12e-3;
/// Noise of the force sensor per cycle, N.
const NOISE_N: f64 = 1.0;
/// Difference of estimated and measured force above which the estimate is trusted, N: adjustable, and 150 in the cuts of source 002; where
/// the whole force of a cut is hardly more, this share of it: two standard deviations of coefficients that are known to a tenth. Of nine jobs
/// by a stranger five keep 0.16 to 0.27 of the deviation and four 0.48 to 0.88, with 150 N alone six of them 0.62 to 0.83; with 0.3 these six were the
/// same.
const THRESHOLD_N: f64 = 150.0;
const THRESHOLD_SHARE: f64 = 0.2;
/// Time of the fade from one to the other, s.
const FADE_S: f64 = 80e-3;
/// Most rounds of the relaxation.
const ROUNDS: usize = 8;
/// Change of the correction, against its size, at which it has arrived.
const ARRIVED: f64 = 0.01;

/// What the sensor reports beside the force of the cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Noise per cycle and axis, standard deviation, N.
    pub noise_n: f64,
    /// What the model of weight, offset and hoses leaves, standard deviation per axis, N.
    pub rest_n: f64,
}

impl Default for Sensor {
    fn default() -> Self {
        Self {
            noise_n: NOISE_N,
            rest_n: 0.0,
        }
    }
}

/// Measured forces alone.
///
/// # Errors
/// As the runs.
pub fn online(task: &Task, none: Correction) -> Outcome<Search> {
    relaxed(task, none, None)
}

/// Measured forces, and the estimated ones where they differ too much.
///
/// # Errors
/// As the runs.
pub fn hybrid(task: &Task, none: Correction) -> Outcome<Search> {
    let (estimated, _) = task.setup.run(task.support, |_| {})?;
    relaxed(task, none, Some(&Pilot::of(estimated)))
}

/// The simulated forces, and how much measured ones may differ from them, N.
struct Pilot {
    estimated: Milled,
    threshold_n: f64,
}

impl Pilot {
    fn of(estimated: Milled) -> Self {
        let largest = estimated.course.iter().map(|cut| norm(cut.force));
        let share = THRESHOLD_SHARE * largest.fold(0.0, f64::max);
        Self {
            threshold_n: share.min(THRESHOLD_N),
            estimated,
        }
    }

    /// Whether the estimate differs from the measured force now, or will before a fade is over: the program is
    /// known, and the fade has to be done when the force turns.
    fn turns(&self, time: f64, measured: V3) -> bool {
        let cycles = ((DEAD as f64 * CYCLE_S + FADE_S) / CYCLE_S).round() as usize;
        let estimate = |i: usize| force(&self.estimated, time + CYCLE_S * i as f64);
        (0..=cycles).any(|i| norm(sub(estimate(i), measured)) > self.threshold_n)
    }

    /// The estimate that the drives must be told now to have followed it when it acts: ahead by the dead time,
    /// and with what their lag of first order takes away.
    fn ahead(&self, time: f64) -> V3 {
        let acts = time + DEAD as f64 * CYCLE_S;
        let at = |i: f64| force(&self.estimated, acts + i * INTERPOLATED_S);
        let [before, after] = [-1.0, 1.0].map(at);
        let slope = scale(0.5 / INTERPOLATED_S, sub(after, before));
        add(scale(0.5, add(before, after)), scale(DRIVES_S, slope))
    }
}

fn relaxed(task: &Task, none: Correction, pilot: Option<&Pilot>) -> Outcome<Search> {
    let mut correction = none;
    let (mut change, mut rounds) = (f64::INFINITY, 0);
    while rounds < ROUNDS {
        rounds += 1;
        let job = with(task.truth, task.plan, &correction)?;
        let (milled, _) = job.run(task.support, |_| {})?;
        let next = controlled(task, &milled, pilot)?;
        change = next.farthest(&correction);
        let size = next.largest().0;
        correction = next;
        if change <= ARRIVED * size {
            break;
        }
    }
    Ok(Search {
        converged: change <= ARRIVED * correction.largest().0,
        correction,
        iterations: rounds,
        last_change_m: change,
    })
}

/// The correction as the robot executes it while these forces act.
fn controlled(task: &Task, milled: &Milled, pilot: Option<&Pilot>) -> Outcome<Correction> {
    let way = &task.setup.way;
    let [begin, end] = way.span();
    let mut random = Random::new(1);
    let mut normal = |spread: f64| [(); 3].map(|()| spread * random.normal());
    let rest = normal(task.sensor.rest_n);
    let mut filter = Filter::default();
    let mut trust = 0.0_f64;
    let mut springs = task.setup.springs()?;
    let mut waiting: VecDeque<V3> = vec![[0.0; 3]; DEAD].into();
    let mut at = [0.0; 3];
    let mut executed: Vec<(f64, V3)> = Vec::new();
    let count = ((end - begin) / CYCLE_S).ceil() as usize + 1;
    for i in 0..count {
        let time = begin + CYCLE_S * i as f64;
        let moment = way.at(time);
        let read = add(add(force(milled, time), rest), normal(task.sensor.noise_n));
        let measured = filter.next(read);
        let used = match pilot {
            None => measured,
            Some(pilot) => {
                let step = CYCLE_S / FADE_S;
                let turns = pilot.turns(time, measured);
                trust = (trust + if turns { step } else { -step }).clamp(0.0, 1.0);
                add(
                    scale(1.0 - trust, measured),
                    scale(trust, pilot.ahead(time)),
                )
            }
        };
        let bent = sub(
            springs.bent(&moment, used)?,
            springs.bent(&moment, [0.0; 3])?,
        );
        let wanted = normal_part(scale(-1.0, bent), way.feed(time));
        waiting.push_back(wanted);
        let told = waiting.pop_front().unwrap_or_default();
        at = add(at, scale(1.0 - (-CYCLE_S / DRIVES_S).exp(), sub(told, at)));
        if executed.last().is_none_or(|last| moment.s_m > last.0) {
            executed.push((moment.s_m, scale(-1.0, at)));
        }
    }
    let mut correction = Correction::none(task.plan.path.length);
    correction.take(&executed);
    Ok(correction)
}

/// Low pass of first order, then a moving average.
#[derive(Default)]
struct Filter {
    low: V3,
    window: VecDeque<V3>,
}

impl Filter {
    fn next(&mut self, read: V3) -> V3 {
        let share = 1.0 - (-CYCLE_S / LOW_PASS_S).exp();
        self.low = add(self.low, scale(share, sub(read, self.low)));
        self.window.push_back(self.low);
        if self.window.len() > AVERAGED {
            self.window.pop_front();
        }
        let sum = self.window.iter().fold([0.0; 3], |s, v| add(s, *v));
        scale(1.0 / self.window.len() as f64, sum)
    }
}

/// Force of the cut at a time, N, workpiece frame.
fn force(milled: &Milled, time_s: f64) -> V3 {
    milled.force_at(time_s)
}
