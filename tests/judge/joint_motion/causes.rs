//! What each cause does to the two angles and the torque of a joint, by laws of this file.

use super::super::pick;
use super::{Joint, span};
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// The causes of the contract.
pub const EFFECTS: [&str; 8] = [
    "time_skew",
    "backlash",
    "hysteresis",
    "coulomb_friction",
    "viscous_friction",
    "stiffness",
    "encoder_ripple",
    "sensor_offset",
];

/// What no cause of the contract does.
pub const OUTSIDE: [&str; 4] = [
    "stiffening",
    "warming zero",
    "neighbour bends the housing",
    "relaxation",
];

/// What a cause does: more angle of the link (rad), more torque of the motor (N·m), and how that shows in the
/// difference of the angles beside the torque (rad).
pub struct Shown {
    pub link: Vec<f64>,
    pub torque: Vec<f64>,
    pub seen: Vec<f64>,
    pub law: String,
    /// Delay of the link encoder, s.
    pub delay: f64,
}

impl Shown {
    fn link(link: Vec<f64>, law: &str) -> Self {
        Self {
            torque: vec![0.0; link.len()],
            seen: link.clone(),
            link,
            law: law.into(),
            delay: 0.0,
        }
    }

    fn torque(torque: Vec<f64>, stiffness: f64, law: &str) -> Self {
        Self {
            link: vec![0.0; torque.len()],
            seen: torque.iter().map(|t| t / stiffness).collect(),
            torque,
            law: law.into(),
            delay: 0.0,
        }
    }
}

/// The link read at other instants than the motor.
pub fn skew(joint: &Joint, delay: f64) -> Shown {
    let p = &joint.programme;
    let cycle = p.time[1] - p.time[0];
    let true_link: Vec<f64> = p
        .angle
        .iter()
        .zip(&joint.torque)
        .map(|(a, t)| a - t / joint.stiffness)
        .collect();
    let last = true_link.len() - 1;
    let at = |i: usize| {
        let x = (i as f64 - delay / cycle).clamp(0.0, last as f64);
        let k = (x.floor() as usize).clamp(1, last - 2);
        cubic(&true_link[k - 1..k + 3], x - k as f64) - true_link[i]
    };
    Shown {
        delay,
        ..Shown::link((0..=last).map(at).collect(), "delay")
    }
}

/// Lagrange through four neighbours, the second of which is at zero.
fn cubic(y: &[f64], x: f64) -> f64 {
    -y[0] * x * (x - 1.0) * (x - 2.0) / 6.0 + y[1] * (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0
        - y[2] * (x + 1.0) * x * (x - 2.0) / 2.0
        + y[3] * (x + 1.0) * x * (x - 1.0) / 6.0
}

/// Dry friction that first bends (Dahl 1968): held while nothing moves.
fn dahl(angle: &[f64], reach: f64, round: f64) -> Vec<f64> {
    let (mut z, mut before) = (0.0_f64, angle[0]);
    let mut step = |a: &f64| {
        let d = (a - before) / reach;
        before = *a;
        let sign = d.signum();
        z = sign - (sign - z) * (-d.abs()).exp();
        z.signum() * z.abs().powf(round)
    };
    angle.iter().map(&mut step).collect()
}

/// Plays of growing width in parallel (Prandtl 1928): a loop that closes after every turn of the load.
fn plays(torque: &[f64], widths: &[f64], weights: &[f64]) -> Vec<f64> {
    let mut stands = vec![torque[0]; widths.len()];
    let mut step = |t: &f64| {
        let mut all = 0.0;
        for ((s, r), w) in stands.iter_mut().zip(widths).zip(weights) {
            *s = s.clamp(t - r, t + r);
            all += w * (*s - t);
        }
        all
    };
    torque.iter().map(&mut step).collect()
}

/// A cause of a size that the best test sees well, by one of its laws.
pub fn shown(name: &'static str, joint: &mut Joint, random: &mut Random) -> Shown {
    let (p, spread) = (&joint.programme, joint.spread());
    let size = spread * random.log_uniform(1.5, 25.0);
    let sign = *pick(random, &[1.0, -1.0]);
    let (k, range) = (joint.stiffness, span(&joint.torque));
    let scaled = |v: Vec<f64>, to: f64| -> Vec<f64> {
        let most = v.iter().fold(1e-12, |m: f64, x| m.max(x.abs()));
        v.iter().map(|x| x * to / most).collect()
    };
    match name {
        "time_skew" => {
            let fast = p.speed.iter().fold(1e-9, |m: f64, v| m.max(v.abs()));
            skew(joint, sign * f64::min(size / fast, 0.006))
        }
        "backlash" => {
            let soft = range * random.uniform(0.002, 0.03);
            let side = joint
                .torque
                .iter()
                .map(|t| -size * (t / soft).atan() / (TAU / 4.0));
            Shown::link(side.collect(), "gap with soft flanks")
        }
        "hysteresis" => match random.below(2) {
            0 => {
                let lag = dahl(&joint.torque, range * random.uniform(0.08, 0.3), 1.0);
                Shown::link(scaled(lag, size), "Dahl over torque")
            }
            _ => {
                let widths: Vec<f64> = (1..=6).map(|i| range * 0.06 * f64::from(i)).collect();
                let lag = plays(&joint.torque, &widths, &[1.0; 6]);
                Shown::link(scaled(lag, -size), "plays over torque")
            }
        },
        "coulomb_friction" => {
            let (reach, round) = (random.log_uniform(2e-4, 4e-3), random.uniform(0.8, 1.2));
            let mut dry = dahl(&p.angle, reach, round);
            let stribeck = random.uniform(0.0, 0.2);
            dry.iter_mut()
                .zip(&p.speed)
                .for_each(|(d, v)| *d *= 1.0 + stribeck * (-(v / 0.05).powi(2)).exp());
            Shown::torque(scaled(dry, size * k), k, "Dahl and Stribeck")
        }
        "viscous_friction" => {
            let power = random.uniform(0.9, 1.05);
            let drag = p.speed.iter().map(|v| v.signum() * v.abs().powf(power));
            Shown::torque(scaled(drag.collect(), size * k), k, "oil")
        }
        "stiffness" => {
            let factor = *pick(random, &[0.5, 0.6, 0.7, 1.5, 1.8]);
            if let Some((stated, known)) = &mut joint.stated {
                (*stated, *known) = (k * factor, known.min(0.08));
            }
            let off: Vec<f64> = joint
                .torque
                .iter()
                .map(|t| t / (k * factor) - t / k)
                .collect();
            Shown {
                link: vec![0.0; off.len()],
                torque: vec![0.0; off.len()],
                seen: off,
                law: format!("{factor} of the true one stated"),
                delay: 0.0,
            }
        }
        "encoder_ripple" => {
            let order = *pick(random, &[16.0, 40.0, 64.0, joint.ratio, 2.0 * joint.ratio]);
            let (phase, second) = (random.uniform(0.0, TAU), random.uniform(0.0, 0.1));
            let wave = |a: &f64| (order * a + phase).sin() + second * (2.0 * order * a).sin();
            Shown::link(
                p.angle.iter().map(|a| size * wave(a)).collect(),
                &format!("{order} a turn"),
            )
        }
        "sensor_offset" => {
            let at = (random.uniform(0.2, 0.8) * p.time.len() as f64) as usize;
            let jump = (0..p.time.len()).map(|i| sign * size * f64::from(u8::from(i >= at)));
            Shown::link(jump.collect(), "jump")
        }
        other => outside(other, joint, size * sign, random),
    }
}

fn outside(name: &'static str, joint: &Joint, size: f64, random: &mut Random) -> Shown {
    let p = &joint.programme;
    let most = joint.torque.iter().fold(1e-9, |m: f64, t| m.max(t.abs()));
    let seconds = p.time[p.time.len() - 1];
    let link: Vec<f64> = match name {
        "stiffening" => joint
            .torque
            .iter()
            .map(|t| 2.0 * size * (t / most).powi(3))
            .collect(),
        "warming zero" => {
            let slow = random.uniform(0.2, 0.8) * seconds;
            p.time
                .iter()
                .map(|t| size * (1.0 - (-t / slow).exp()))
                .collect()
        }
        "neighbour bends the housing" => {
            let (w, v) = (random.uniform(0.6, 1.7), random.uniform(0.0, TAU));
            p.time
                .iter()
                .map(|t| size * (w * t + v + 0.3 * (0.7 * t).sin()).sin())
                .collect()
        }
        _ => {
            let slow = random.uniform(0.15, 0.8);
            let (mut lag, cycle) = (joint.torque[0], p.time[1]);
            let mut step = |t: &f64| {
                lag += (t - lag) * cycle / slow;
                -2.0 * size.abs() * lag / most
            };
            joint.torque.iter().map(&mut step).collect()
        }
    };
    Shown::link(link, name)
}

/// What each cause of the contract is nearest to, as columns.
pub fn rivals(joint: &Joint) -> Vec<(&'static str, Vec<Vec<f64>>)> {
    let p = &joint.programme;
    let range = span(&joint.torque);
    let rate: Vec<f64> = p.speed.clone();
    let mut all = vec![
        ("time_skew", vec![rate.clone()]),
        ("viscous_friction", vec![rate]),
        ("stiffness", vec![joint.torque.clone()]),
    ];
    for soft in [0.004, 0.015] {
        let side = joint.torque.iter().map(|t| (t / (soft * range)).atan());
        all.push(("backlash", vec![side.collect()]));
    }
    for reach in [0.1, 0.25] {
        all.push((
            "hysteresis",
            vec![
                dahl(&joint.torque, reach * range, 1.0),
                joint.torque.clone(),
            ],
        ));
    }
    for reach in [4e-4, 2e-3] {
        all.push(("coulomb_friction", vec![dahl(&p.angle, reach, 1.0)]));
    }
    for k in 1..20 {
        let from = k * p.time.len() / 20;
        let step = (0..p.time.len()).map(|i| f64::from(u8::from(i >= from)));
        all.push(("sensor_offset", vec![step.collect()]));
    }
    all
}

/// A gear takes energy in every turn of the load and gives none. The first loops of this file gave some: their link was
/// ahead of the torque.
#[test]
fn a_loop_takes_energy() {
    let mut random = Random::new(1);
    for _ in 0..20 {
        let mut joint = Joint::draw(&mut random, 2, 8.0, 0.004);
        let rows = joint.torque.len();
        let turns = |i: usize| TAU * 5.0 * i as f64 / (rows - 1) as f64;
        joint.torque = (0..rows).map(|i| 1000.0 * turns(i).sin()).collect();
        let link = shown("hysteresis", &mut joint, &mut random).link;
        let work =
            |i: usize| 0.5 * (joint.torque[i] + joint.torque[i - 1]) * (link[i] - link[i - 1]);
        // the link falls behind the motor by less than the spring says: torque times twist, the other way round
        let lost = -(rows / 5..rows).map(work).sum::<f64>();
        assert!(lost > 0.0, "{lost}");
    }
}
