//! The torque of an elastic hinge over its deflection: spring, gap and dry contacts, integrated exactly
//! along a straight piece of path, whatever its length.
//!
//! Contacts in the load path hold deflection back, x = M/k − Σ wᵢ Sᵣᵢ(M). The inverse of such an operator
//! is one of its kind (Krejčí and Kuhnen 2001): M = k x + Σ kⱼ Sρⱼ(x), elastic sliders beside the spring,
//! whose torque never exceeds kⱼ ρⱼ. The gap lies in series and is crossed at M = 0.

mod slider;

use crate::robot::Spring;
use slider::{Slider, sliders};

/// The law of one elastic hinge.
#[derive(Debug, Clone, PartialEq)]
pub struct HingeLaw {
    stiffness: f64,
    half_gap: f64,
    sliders: Vec<Slider>,
    /// Slope while every slider sticks, N·m/rad: the greatest.
    steepest: f64,
}

/// What a hinge remembers of its past.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Memory {
    /// Deflection of the spring, rad: without the gap.
    pub bend: f64,
    /// Deflection of each slider, rad.
    pub stops: Vec<f64>,
    /// Torque of all together, N·m.
    pub torque: f64,
}

/// A piece of path.
#[derive(Clone, Copy)]
struct Way {
    /// How far the spring is bent, rad: the rest crosses the gap.
    travel: f64,
    /// Whether it ends inside the gap.
    floats: bool,
}

/// Torque over a piece of path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// Work over way: the mean torque, N·m.
    pub torque: f64,
    /// Its derivative by the end of the piece, N·m/rad; never negative.
    pub slope: f64,
}

impl HingeLaw {
    /// The law of a spring with its gap and its effects.
    pub fn of(spring: &Spring) -> Self {
        let sliders = sliders(spring.stiffness, spring.contacts());
        Self {
            stiffness: spring.stiffness,
            half_gap: 0.5 * spring.gap(),
            steepest: spring.stiffness + sliders.iter().map(|s| s.stiffness).sum::<f64>(),
            sliders,
        }
    }

    /// At the deflection `delta` (rad), the contacts without load as after a good shake.
    pub fn at_rest(&self, delta: f64) -> Memory {
        let bend = delta - delta.clamp(-self.half_gap, self.half_gap);
        Memory {
            bend,
            stops: vec![0.0; self.sliders.len()],
            torque: self.stiffness * bend,
        }
    }

    /// Where it rests under a torque (N·m) after a good shake, rad: a gap is closed, without torque in its middle.
    pub fn settled(&self, torque: f64) -> f64 {
        let side = if torque == 0.0 { 0.0 } else { torque.signum() };
        torque / self.stiffness + side * self.half_gap
    }

    /// Where it comes to rest from the deflection `from` (rad) under another torque, N·m.
    pub fn under(&self, memory: &Memory, from: f64, torque: f64) -> f64 {
        let change = torque - memory.torque;
        if change == 0.0 {
            return from;
        }
        let sign = change.signum();
        let travel = self.reach(memory, sign, sign * torque);
        let place = (from - memory.bend).clamp(-self.half_gap, self.half_gap);
        let crossed = match sign * torque > 0.0 {
            true => self.half_gap - sign * place,
            false => 0.0,
        };
        from + sign * (travel + crossed)
    }

    /// Energy in spring and sliders, J.
    pub fn stored(&self, memory: &Memory) -> f64 {
        let held = self.sliders.iter().zip(&memory.stops);
        let own = held.map(|(slider, stop)| 0.5 * slider.stiffness * stop * stop);
        0.5 * self.stiffness * memory.bend.powi(2) + own.sum::<f64>()
    }

    /// Mean torque between two deflections, rad. What it adds to the stored energy or loses to the
    /// contacts is exactly torque times way.
    pub fn mean(&self, memory: &Memory, from: f64, to: f64) -> Mean {
        self.mean_along(memory, (from, to), self.way(memory, from, to))
    }

    fn mean_along(&self, memory: &Memory, (from, to): (f64, f64), along: Way) -> Mean {
        let (way, sign) = ((to - from).abs(), (to - from).signum());
        let Way { travel, floats } = along;
        let spring = Mean {
            torque: self.stiffness * (memory.bend + 0.5 * sign * travel),
            slope: 0.5 * self.stiffness,
        };
        let held = self.sliders.iter().zip(&memory.stops);
        let bent = held.fold(spring, |sum, (slider, stop)| {
            let own = slider.mean(*stop, sign, travel);
            Mean {
                torque: sum.torque + own.torque,
                slope: sum.slope + own.slope,
            }
        });
        if travel == way {
            return bent;
        }
        let torque = bent.torque * (travel / way);
        let end = match floats {
            true => 0.0,
            false => self.pushed(memory, sign, travel).0,
        };
        Mean {
            torque,
            slope: ((end - sign * torque) / way).max(0.0),
        }
    }

    /// Moves on between two deflections, rad.
    pub fn advance(&self, memory: &mut Memory, from: f64, to: f64) {
        let travel = self.way(memory, from, to).travel;
        self.bend(memory, travel * (to - from).signum());
    }

    /// Moves on, and says the mean torque on the way, N·m.
    pub fn step(&self, memory: &mut Memory, from: f64, to: f64) -> f64 {
        let way = self.way(memory, from, to);
        let mean = self.mean_along(memory, (from, to), way).torque;
        self.bend(memory, way.travel * (to - from).signum());
        mean
    }

    fn bend(&self, memory: &mut Memory, moved: f64) {
        memory.bend += moved;
        memory.torque = self.stiffness * memory.bend;
        for (slider, stop) in self.sliders.iter().zip(&mut memory.stops) {
            *stop = (*stop + moved).clamp(-slider.reach, slider.reach);
            memory.torque += slider.stiffness * *stop;
        }
    }

    /// First the torque against the motion goes, then the gap is crossed, then the spring bends again.
    fn way(&self, memory: &Memory, from: f64, to: f64) -> Way {
        let (way, sign) = ((to - from).abs(), (to - from).signum());
        let place = (from - memory.bend).clamp(-self.half_gap, self.half_gap);
        let room = self.half_gap - sign * place;
        // most steps of a pressed hinge are too short to reach its gap, even if every slider stuck
        let too_short = sign * memory.torque + self.steepest * way < 0.0;
        if room <= 0.0 || too_short || self.pushed(memory, sign, way).0 < 0.0 {
            return Way {
                travel: way,
                floats: false,
            };
        }
        let relief = self.reach(memory, sign, 0.0).min(way);
        let beyond = way - relief - room;
        Way {
            travel: relief + beyond.max(0.0),
            floats: relief < way && beyond < 0.0,
        }
    }

    /// How far to bend in the direction `sign` until the torque along it is `wanted` (N·m; 0: what stood against
    /// it is gone), rad: Newton on a concave chain of straight pieces, which ends on the root.
    fn reach(&self, memory: &Memory, sign: f64, wanted: f64) -> f64 {
        let mut travel = 0.0;
        for _ in 0..=self.sliders.len() + 1 {
            let (along, slope) = self.pushed(memory, sign, travel);
            if along >= wanted {
                break;
            }
            travel += (wanted - along) / slope;
        }
        travel
    }

    /// Torque along `sign` after bending by `travel`, and its slope.
    fn pushed(&self, memory: &Memory, sign: f64, travel: f64) -> (f64, f64) {
        let spring = self.stiffness * (sign * memory.bend + travel);
        let held = self.sliders.iter().zip(&memory.stops);
        held.fold(
            (spring, self.stiffness),
            |(torque, slope), (slider, stop)| {
                let moved = sign * stop + travel;
                let sticks = f64::from(u8::from(moved < slider.reach));
                (
                    torque + slider.stiffness * moved.min(slider.reach),
                    slope + slider.stiffness * sticks,
                )
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Composite, Scene, named};
    use crate::ground::random::Random;
    use crate::robot::joint_effect::JointEffect;

    const STIFFNESS: f64 = 3.14e5;

    fn joint(gap: f64) -> Spring {
        Spring {
            backlash: vec![gap; usize::from(gap > 0.0)],
            effects: vec![
                JointEffect::new("hysteresis", vec![9.7e-5, 348.0, 1.09, -0.377]).unwrap(),
                JointEffect::new("coulomb_friction", vec![2e-5, 60.0]).unwrap(),
            ],
            ..Spring::new(STIFFNESS, 0.0)
        }
    }

    /// Deflections that a random history of loads leaves behind, by the laws of the effects.
    fn history(spring: &Spring, loads: &[f64]) -> Vec<f64> {
        let effects: Vec<_> = spring
            .effects
            .iter()
            .map(|e| named(&e.name).unwrap())
            .collect();
        let model = Composite::new(&effects);
        let time = (0..loads.len()).map(|i| i as f64).collect();
        let scene = Scene::new(time, loads.to_vec(), STIFFNESS, 1);
        let own = spring.effects.iter().flat_map(|e| e.values.clone());
        let p: Vec<f64> = [STIFFNESS].into_iter().chain(own).collect();
        model.predict(&p, &scene)
    }

    fn loads(seed: u64) -> Vec<f64> {
        let mut random = Random::new(seed);
        (0..200).map(|_| random.uniform(-500.0, 500.0)).collect()
    }

    /// A gap in series only adds its half.
    #[test]
    fn sliders_invert_the_laws_of_the_effects() {
        for (gap, seed) in [(0.0, 1), (2e-4, 2)] {
            let spring = joint(gap);
            let law = HingeLaw::of(&spring);
            let (mut memory, mut at) = (law.at_rest(0.0), 0.0);
            let loads = loads(seed);
            for (delta, load) in history(&spring, &loads).into_iter().zip(&loads) {
                let to = delta + 0.5 * gap * load.signum();
                law.advance(&mut memory, at, to);
                at = to;
                let found = memory.torque;
                assert!((found - load).abs() < 1e-9 * 500.0, "{found} {load}");
            }
        }
    }

    /// Work is what is stored plus what is lost; the loss is never negative; the slope is the
    /// derivative of the mean.
    #[test]
    fn work_is_stored_or_lost() {
        let mut random = Random::new(3);
        for gap in [0.0, 2e-4] {
            let law = HingeLaw::of(&joint(gap));
            let (mut memory, mut at, mut lost) = (law.at_rest(0.0), 0.0, 0.0);
            for _ in 0..2000 {
                let to = random.uniform(-2e-3, 2e-3);
                let (before, mean) = (law.stored(&memory), law.mean(&memory, at, to));
                let near = law.mean(&memory, at, to + 1e-9).torque;
                let error = (near - mean.torque) / 1e-9 - mean.slope;
                assert!(error.abs() < 1e-3 * STIFFNESS, "{error}");
                law.advance(&mut memory, at, to);
                let loss = mean.torque * (to - at) - (law.stored(&memory) - before);
                assert!(loss > -1e-15, "{loss}");
                (at, lost) = (to, lost + loss);
            }
            assert!(lost > 0.1);
        }
    }
}
