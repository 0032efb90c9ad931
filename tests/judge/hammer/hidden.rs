//! What is hidden in a file: causes of the contract by laws of this file, and what nobody in the library does.

use super::super::algebra::{V3, scaled};
use super::dynamics::{Law, World};
use super::records::askew;
use super::robot::{Body, Hinge, Robot, Spread};
use std::f64::consts::TAU;

/// The causes of the contract.
pub const EFFECTS: [&str; 12] = [
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "base_compliance",
    "link_compliance",
    "added_mass",
    "joint_damping",
    "accelerometer_misalignment",
    "accelerometer_gain",
    "time_skew",
    "exponential_window",
    "double_hit",
];

/// What no cause of the contract does.
pub const OUTSIDE: [&str; 6] = [
    "absorber",
    "cubic spring",
    "play",
    "hits beside the aim",
    "knocking cable",
    "rubber",
];

/// Something hidden: how it changes the world, from small to large.
pub struct Hidden {
    pub effect: &'static str,
    pub site: Option<String>,
    pub law: String,
    pub kind: Kind,
}

/// The law of a hidden cause.
pub enum Kind {
    /// Springs times a factor per unit of size: hinges, sign.
    Springs(Vec<usize>, f64),
    /// Hinges that nobody told of; stiffness at size one.
    Hinges(Vec<Hinge>),
    /// A body; kg at size one.
    Mass(Body),
    /// Oil times 1 + size, or over it.
    Oil(Vec<usize>, bool),
    /// Turn of the sensor, rad at size one.
    Turn(V3),
    /// Gain of some axes at size one.
    Gain([f64; 3]),
    /// Delay at size one, s.
    Late(f64),
    /// Decay of a window, 1/s at size one.
    Window(f64),
    /// Second pulses: direction, number, share, s.
    Second(Vec<(usize, usize, f64, f64)>),
    /// Direction, kg, Hz, damping ratio at size one.
    Absorber(V3, f64, f64, f64),
    /// Hinge; moment beside Hooke's at this angle is `size` times Hooke's.
    Cubic(usize, f64),
    /// Hinge; half width at size one, rad.
    Play(usize, f64),
    /// Scatter of places at size one, m.
    Wander(f64),
    /// Share of impulse at size one.
    Knock(f64),
    /// Hinge, time constant; share of its stiffness at size one.
    Rubber(usize, f64),
}

impl Hidden {
    /// Does it to a world.
    pub fn apply(&self, world: &mut World, size: f64) {
        let hinges = &mut world.robot.hinges;
        match &self.kind {
            Kind::Springs(members, sign) => members
                .iter()
                .for_each(|i| hinges[*i].k *= (sign * size).exp()),
            Kind::Hinges(all) => hinges.extend(all.iter().cloned().map(|mut h| {
                h.k /= size;
                h.d /= size;
                h
            })),
            Kind::Mass(body) => {
                let mut own = body.clone();
                own.mass *= size;
                own.inertia = own.inertia.map(|i| i * size);
                world.robot.bodies.push(own);
            }
            Kind::Oil(members, more) => {
                let factor = if *more {
                    1.0 + size
                } else {
                    1.0 / (1.0 + size)
                };
                members.iter().for_each(|i| hinges[*i].d *= factor);
            }
            Kind::Turn(turn) => {
                let own = askew(scaled(*turn, size));
                let before = world.sensor;
                world.sensor = std::array::from_fn(|i| {
                    std::array::from_fn(|j| (0..3).map(|k| own[i][k] * before[k][j]).sum())
                });
            }
            Kind::Gain(axes) => {
                for (row, gain) in world.sensor.iter_mut().zip(axes) {
                    row.iter_mut().for_each(|x| *x *= (gain * size).exp());
                }
            }
            Kind::Late(delay) => world.delay += delay * size,
            Kind::Window(decay) => world.decay += decay * size,
            Kind::Second(all) => world.second.extend(all.iter().copied()),
            Kind::Absorber(dir, mass, f, zeta) => {
                let (mass, w) = (mass * size, TAU * f);
                world.absorber = Some((*dir, mass, mass * w * w, 2.0 * zeta * mass * w));
            }
            Kind::Cubic(i, angle) => {
                let k3 = hinges[*i].k * size / angle.powi(2);
                world.bent = Some((*i, Law::Cubic(k3)));
            }
            Kind::Play(i, half) => world.bent = Some((*i, Law::Gap(half * size, hinges[*i].k))),
            Kind::Wander(scatter) => world.wander = scatter * size,
            Kind::Knock(share) => world.knock = share * size,
            Kind::Rubber(i, slow) => world.rubber = Some((*i, hinges[*i].k * size, *slow)),
        }
    }

    /// By how many stated standard deviations it leaves what the file says, where the file says anything.
    pub fn beyond(&self, size: f64, spread: &Spread, told: &Robot) -> f64 {
        match &self.kind {
            Kind::Mass(more) => carried(more, size, spread, told),
            Kind::Springs(..) => size / spread.stiffness,
            Kind::Oil(..) => (1.0 + size).ln() / spread.damping,
            Kind::Gain(axes) => {
                axes.iter().fold(0.0, |m: f64, a| m.max(a.abs())) * size / spread.gain
            }
            _ => f64::INFINITY,
        }
    }

    /// Whether its size changes nothing that is seen.
    pub fn fixed(&self) -> bool {
        matches!(self.kind, Kind::Second(_))
    }

    /// Whether only records tell what it does.
    pub fn stepped(&self) -> bool {
        matches!(
            self.kind,
            Kind::Cubic(..) | Kind::Play(..) | Kind::Wander(_) | Kind::Knock(_)
        )
    }
}

/// What the body that carries a mass must depart from its file, in stated standard deviations, to do the same.
fn carried(more: &Body, size: f64, spread: &Spread, told: &Robot) -> f64 {
    let own = told.bodies.iter().rfind(|b| b.link == more.link).unwrap();
    let (m, whole) = (size * more.mass, own.mass);
    let r: V3 = std::array::from_fn(|i| more.com[i] - own.com[i]);
    let mut sum = (m / (whole * spread.mass)).powi(2);
    for x in r {
        sum += (m * x / ((whole + m) * spread.com)).powi(2);
    }
    let square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    for (i, x) in r.iter().enumerate() {
        let turned = m * whole / (whole + m) * (square - x * x) + size * more.inertia[i];
        sum += (turned / (own.inertia[i] * spread.inertia)).powi(2);
    }
    sum.sqrt()
}
