//! The torque of an elastic hinge over its deflection: spring, gap and dry contacts, integrated exactly
//! along a straight piece of path, whatever its length.
//!
//! Contacts in the load path hold deflection back, x = M/k − Σ wᵢ Sᵣᵢ(M). The inverse of such an operator
//! is one of its kind (Krejčí and Kuhnen 2001): M = k x + Σ kⱼ Sρⱼ(x), elastic sliders beside the spring,
//! whose torque never exceeds kⱼ ρⱼ. The gap lies in series and is crossed at M = 0.

mod slider;
#[cfg(test)]
mod tests;

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
    /// What lies ahead in the direction of falling and of rising deflection.
    ahead: [Ahead; 2],
}

/// A straight piece of the law.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Ahead {
    /// Its slope: spring and sliders that stick, N·m/rad.
    slope: f64,
    /// How far it goes until the first of them slips, rad.
    room: f64,
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
        let mut memory = Memory {
            bend,
            stops: vec![0.0; self.sliders.len()],
            ..Memory::default()
        };
        self.bend(&mut memory, 0.0);
        memory
    }

    /// The law in both directions were there no slider.
    fn spring_alone(&self) -> [Ahead; 2] {
        let room = f64::INFINITY;
        let slope = self.stiffness;
        [Ahead { slope, room }; 2]
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
        let ahead = memory.ahead(sign);
        if travel == way && travel <= ahead.room {
            return Mean {
                torque: memory.torque + 0.5 * sign * ahead.slope * travel,
                slope: 0.5 * ahead.slope,
            };
        }
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
        memory.ahead = self.spring_alone();
        for (slider, stop) in self.sliders.iter().zip(&mut memory.stops) {
            *stop = (*stop + moved).clamp(-slider.reach, slider.reach);
            memory.torque += slider.stiffness * *stop;
            let rooms = [slider.reach + *stop, slider.reach - *stop];
            for (ahead, room) in memory.ahead.iter_mut().zip(rooms) {
                let sticks = room > 0.0;
                ahead.slope += if sticks { slider.stiffness } else { 0.0 };
                ahead.room = ahead.room.min(if sticks { room } else { f64::INFINITY });
            }
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
        let ahead = memory.ahead(sign);
        if travel < ahead.room {
            return (sign * memory.torque + ahead.slope * travel, ahead.slope);
        }
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

impl Memory {
    fn ahead(&self, sign: f64) -> Ahead {
        self.ahead[usize::from(sign > 0.0)]
    }
}
