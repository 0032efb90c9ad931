//! Masses, dampers and springs of the robot in time, coupled to every tooth: the default.
//!
//! But for the gaps and contacts of its joints ([`super::loose`]) the robot is linear about its programmed motion, anew wherever its pose has changed; weight and
//! programmed motion load it (source 000, eq. 2.1). Every step solves u = u₀ + H f and
//! f = F(u) together with the slope of the force, so that no stiffness of the cut makes it unstable.

use super::loose::{Loose, Ports};
use super::oscillator::Oscillator;
use super::pose::{Carrier, Held, one_less, solve3};
use super::structure::{Bout, Energy, Structure, Tick};
use super::way::Moment;
use crate::cutting::cutter::Cutter;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, add, dot, norm, rotate, scale, sub};
use crate::motion::modes::Modal;
use std::collections::VecDeque;
use std::f64::consts::TAU;

/// The robot in motion.
#[derive(Debug, Clone)]
pub struct Swinging {
    carrier: Carrier,
    held: Held,
    modal: Modal,
    fine: Oscillator,
    coarse: Oscillator,
    /// Gaps and contacts of the joints, and how they answer in the cut and beside it.
    loose: Loose,
    near: Ports,
    far: Ports,
    pose: Vec<f64>,
    /// Place of the tool when it was calibrated, m: the sag at the start.
    calibrated: V3,
    state: Vec<f64>,
    next: Vec<f64>,
    force: V3,
    /// Where the tool was after each step in the cut, the latest last.
    places: VecDeque<V3>,
    /// Steps of the spindle since the start.
    turned: f64,
    energy: Energy,
    at_first: f64,
    /// Power of the dampers in this state, W.
    lost: f64,
}

/// Joint motion beyond which the modes are computed anew, rad.
const SAME_POSE: f64 = 5e-3;
/// Step beside the stock, s.
const TRAVEL_S: f64 = 2e-3;

impl Swinging {
    /// At rest under its weight at the start of a motion; `steps` per revolution of the spindle.
    ///
    /// # Errors
    /// Nothing in the robot is elastic, a spring has no stiffness.
    pub fn new(
        mut carrier: Carrier,
        start: &Moment,
        spindle_rad_s: f64,
        steps: usize,
    ) -> Outcome<Self> {
        let held = carrier.held(&start.joints)?;
        let modal = held.modal()?;
        let fine = Oscillator::new(&modal, TAU / (spindle_rad_s * steps as f64));
        let coarse = Oscillator::new(&modal, TRAVEL_S);
        let loose = Loose::of(&carrier.chain, &held);
        let mut loads: Vec<f64> = held.weight.iter().map(|w| -w).collect();
        loose.held(&mut loads);
        let mut state = in_modes(&modal, &loads);
        state.resize(2 * modal.n, 0.0);
        Ok(Self {
            calibrated: fine.tool(&state),
            at_first: fine.stored(&state) + loose.stored(),
            lost: fine.damped(&state),
            near: loose.ports(&modal, &fine),
            far: loose.ports(&modal, &coarse),
            loose,
            next: state.clone(),
            state,
            pose: start.joints.clone(),
            force: [0.0; 3],
            places: VecDeque::new(),
            turned: 0.0,
            energy: Energy::default(),
            carrier,
            held,
            modal,
            fine,
            coarse,
        })
    }

    /// Carries the state to the modes of a new pose: the springs keep their bend.
    fn go(&mut self, moment: &Moment) -> Outcome<()> {
        if moment.is_at(&self.pose, SAME_POSE) {
            return Ok(());
        }
        let n = self.modal.n;
        let before = self.fine.stored(&self.state);
        let held = self.carrier.held(&moment.joints)?;
        let modal = held.modal()?;
        let (place, speed) = self.state.split_at(n);
        let state = [place, speed].map(|x| {
            let bent = self.bent(x);
            let loads = bent
                .iter()
                .enumerate()
                .map(|(i, b)| b * held.linear.stiffness[i * n + i]);
            in_modes(&modal, &loads.collect::<Vec<_>>())
        });
        self.state = state.concat();
        self.fine = Oscillator::new(&modal, self.fine.step_s());
        self.coarse = Oscillator::new(&modal, TRAVEL_S);
        self.near = self.loose.ports(&modal, &self.fine);
        self.far = self.loose.ports(&modal, &self.coarse);
        (self.held, self.modal) = (held, modal);
        self.pose.clone_from(&moment.joints);
        // the drives that turn the robot to its new pose do this work
        self.energy.work += self.fine.stored(&self.state) - before;
        self.lost = self.fine.damped(&self.state);
        Ok(())
    }

    /// Bend of every spring, rad.
    fn bent(&self, modes: &[f64]) -> Vec<f64> {
        let n = self.modal.n;
        let row = |i: usize| &self.modal.shape[i * n..(i + 1) * n];
        (0..n)
            .map(|i| row(i).iter().zip(modes).map(|(p, x)| p * x).sum())
            .collect()
    }

    /// Where the modes would rest under weight and programmed motion, its mean over the tick: what changes the speeds from its
    /// begin to its end, whatever the accelerations are in between.
    fn rest(&mut self, tick: &Tick) -> Vec<f64> {
        let (from, to) = (&tick.from, &tick.to);
        let each = |a: &[f64], b: &[f64], of: fn(f64, f64) -> f64| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| of(*a, *b)).collect()
        };
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let changed = each(&from.speeds, &to.speeds, |a, b| b - a).into_iter();
        let accelerations: Vec<f64> = changed.map(|change| change / tick.duration_s()).collect();
        let carried = self.carrier.carried(
            &each(&from.joints, &to.joints, mean),
            &each(&from.speeds, &to.speeds, mean),
            &accelerations,
        );
        in_modes(&self.modal, &carried.iter().map(|t| -t).collect::<Vec<_>>())
    }

    /// One step without force of the cut; the state is in `next`.
    fn carry(&mut self, rest: &[f64], coarse: bool) {
        let oscillator = if coarse { &self.coarse } else { &self.fine };
        oscillator.carry(&self.state, rest, &mut self.next);
    }

    /// Adds to `next` what gaps and contacts do over the step, the force of the cut being still to come.
    fn loosen(&mut self, coarse: bool, to_come: V3) {
        let ports = match coarse {
            true => &mut self.far,
            false => &mut self.near,
        };
        let torques = self.loose.torques(ports, &self.next, to_come);
        ports.push(&mut self.next, torques);
    }

    /// Books the energy of a step and takes it.
    fn take(&mut self, rest: &[f64], force: V3, coarse: bool) {
        let ports = if coarse { &self.far } else { &self.near };
        self.energy.damped += self.loose.take(ports, &self.next);
        let step_s = if coarse { TRAVEL_S } else { self.fine.step_s() };
        let fine = &self.fine;
        let moved = sub(fine.tool(&self.next), fine.tool(&self.state));
        let held: f64 = rest
            .iter()
            .zip(self.next.iter().zip(&self.state))
            .map(|(r, (a, b))| r * (a - b))
            .sum();
        self.energy.work += dot(force, moved) + held;
        let lost = fine.damped(&self.next);
        self.energy.damped += 0.5 * step_s * (self.lost + lost);
        self.lost = lost;
        std::mem::swap(&mut self.state, &mut self.next);
    }

    /// Before the first step in the cut the tool went along its programmed way.
    fn remember(&mut self, tick: &Tick, per_pitch: usize, memory: usize) {
        if !self.places.is_empty() {
            return;
        }
        let here = add(tick.from.tip, self.deviation());
        let step = scale(1.0 / per_pitch as f64, sub(tick.to.tip, tick.from.tip));
        let count = per_pitch * memory;
        self.places = (0..=count)
            .map(|k| sub(here, scale((count - k) as f64, step)))
            .collect();
    }
}

/// Φᵀ load: modes of unit stiffness under torques on the elastic coordinates.
fn in_modes(modal: &Modal, load: &[f64]) -> Vec<f64> {
    let n = modal.n;
    let mode = |j: usize| (0..n).map(|i| modal.shape[i * n + j] * load[i]).sum();
    (0..n).map(mode).collect()
}

impl Structure for Swinging {
    fn deviation(&self) -> V3 {
        sub(self.fine.tool(&self.state), self.calibrated)
    }

    fn cut(&mut self, cutter: &Cutter, tick: &Tick) -> Outcome<Bout> {
        self.go(&tick.to)?;
        let count = self.steps_per_tick(cutter);
        self.remember(tick, count, cutter.memory());
        let rest = self.rest(tick);
        let answer = self.fine.answer;
        let mut bout = Bout::default();
        for q in 0..count {
            let share = (q + 1) as f64 / count as f64;
            let told = add(tick.from.tip, scale(share, sub(tick.to.tip, tick.from.tip)));
            self.carry(&rest, false);
            self.loosen(false, self.force);
            let free = sub(self.fine.tool(&self.next), self.calibrated);
            let guess = add(free, rotate(&answer, self.force));
            let place = add(told, guess);
            let ways: [V3; 3] = std::array::from_fn(|m| {
                sub(place, self.places[self.places.len() - (m + 1) * count])
            });
            let load = cutter.load(self.turned + 0.5, &ways[..cutter.memory()]);
            // f = F + G (u − guess), u = free + H f
            let right = add(load.force, rotate(&load.slope, sub(free, guess)));
            self.force = solve3(&one_less(&load.slope, &answer), right)?;
            self.fine.push(&mut self.next, self.force);
            self.take(&rest, self.force, false);
            self.turned += 1.0;
            let deviation = self.deviation();
            self.places.pop_front();
            self.places.push_back(add(told, deviation));
            bout.peak = bout.peak.max(norm(self.force));
            bout.force = add(bout.force, scale(1.0 / count as f64, self.force));
            bout.deviation = add(bout.deviation, scale(1.0 / count as f64, deviation));
        }
        Ok(bout)
    }

    fn travel(&mut self, tick: &Tick) -> Outcome<Bout> {
        self.go(&tick.to)?;
        self.places.clear();
        self.force = [0.0; 3];
        let rest = self.rest(tick);
        let before = self.deviation();
        self.carry(&rest, true);
        self.loosen(true, [0.0; 3]);
        self.take(&rest, [0.0; 3], true);
        // noted for the middle of the step, as in the cut
        Ok(Bout {
            deviation: scale(0.5, add(before, self.deviation())),
            ..Bout::default()
        })
    }

    fn longest_travel_s(&self) -> f64 {
        TRAVEL_S
    }

    fn steps_per_tick(&self, cutter: &Cutter) -> usize {
        cutter.steps() / cutter.tool().teeth
    }

    fn energy(&self) -> Option<Energy> {
        Some(Energy {
            stored: self.fine.stored(&self.state) + self.loose.stored() - self.at_first,
            ..self.energy
        })
    }
}
