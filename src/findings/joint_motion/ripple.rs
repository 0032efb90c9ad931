//! Errors periodic in the angle of an encoder, and whose they can be.
//!
//! An encoder closes on itself: its errors repeat with whole turns of its own shaft, and are as large
//! in slow as in fast motion. Meshing teeth make orders of their own, whose size changes with speed.

use super::channels::Channels;
use super::orders::{BINS, orders, resolution, wave};
use super::projection::{left, partial};
use crate::ground::stats::{length, rms};

/// Speed, as a share of the largest, below which rows do not count.
const MOVING: f64 = 0.04;
/// Highest order per turn of the link that is taken for a link encoder's without further proof.
const FEW_PER_TURN: f64 = 64.0;
/// Highest order per turn of the motor that is taken for a motor encoder's.
const FEW_PER_MOTOR_TURN: f64 = 8.0;
/// Ratio of the sizes in slow and in fast motion within which a ripple is steady.
const STEADY: f64 = 1.2;
/// Ratio of fast to slow speeds that allows the comparison, and the largest standard error of either size as a share of the
/// larger one. The second is a choice: beside it two standard errors are less than half of a size. No other number was tried.
const CONTRAST: f64 = 2.5;
const KNOWN: f64 = 0.15;
/// Standard errors within which sizes are one (95 %), where the order is an encoder's own.
const ALIKE: f64 = 2.0;

/// Share of the twist's rms beside torque below which a ripple is none to speak of, and below which one of teeth is that
/// all gears have.
const SMALL: f64 = 0.02;
const SMALL_OF_TEETH: f64 = 0.3;
/// Share of what is left beside delay, friction and gap that a ripple must be: an encoder's own by its order, and
/// one that is an encoder's only because it is steady, as that of some teeth is (two fifths of the variance).
const OF_REST: f64 = 0.3;
const OF_REST_IF_STEADY: f64 = 0.65;

/// A period that a residual suggests.
#[derive(Debug, Clone)]
pub struct Wave {
    /// Periods per radian of its angle.
    pub order: f64,
    /// Whether it can be an encoder's own.
    pub of_encoder: bool,
    /// Whether it is too small to count beside what the torque leaves of the twist.
    pub is_small: bool,
    /// Sine and cosine.
    pub columns: Vec<Vec<f64>>,
}

impl Wave {
    /// Whether a motion cannot tell its order from that of another.
    pub fn is_near(&self, other: &Self, data: &Channels) -> bool {
        let apart = (self.order - other.order).abs();
        apart < resolution(&data.link).max(resolution(&data.motor))
    }
}

/// How many periods of an angle are tried.
pub const TRIED: f64 = (BINS / 8) as f64;

/// The periods of either angle that a residual suggests, the strongest of each first.
pub fn waves(data: &Channels, residual: &[f64], ratio: Option<f64>) -> Vec<Wave> {
    let rows = moving(data);
    let base = [vec![1.0; data.rows()], data.torque.clone()];
    let (twist, rest) = (rms(&left(&base, &data.twist)), rms(residual));
    let mut found: Vec<Wave> = Vec::new();
    for angle in [&data.link, &data.motor] {
        for order in orders(data, angle, residual, &rows) {
            let near = |w: &Wave| (w.order - order).abs() < resolution(angle);
            if found.iter().any(near) {
                continue;
            }
            let whose = whose(data, angle, order, &rows, ratio);
            found.push(Wave {
                of_encoder: whose != Whose::Teeth,
                is_small: size(&wave(data, angle, order), residual) < whose.least(twist, rest),
                columns: wave(data, angle, order),
                order,
            });
        }
    }
    found
}

/// Rms of what a wave takes of a residual.
fn size(wave: &[Vec<f64>], residual: &[f64]) -> f64 {
    let less = rms(&left(wave, residual)).powi(2);
    (rms(residual).powi(2) - less).max(0.0).sqrt()
}

fn moving(data: &Channels) -> Vec<usize> {
    let still = MOVING * data.top_speed();
    (0..data.rows())
        .filter(|i| data.speed[*i].abs() > still)
        .collect()
}

/// Who makes a ripple.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Whose {
    /// An encoder, by its order.
    Encoder,
    /// An encoder, because it is as large in slow as in fast motion.
    Steady,
    /// Meshing teeth.
    Teeth,
}

impl Whose {
    /// How large it must be to count.
    fn least(self, twist: f64, rest: f64) -> f64 {
        match self {
            Self::Encoder => (SMALL * twist).max(OF_REST * rest),
            Self::Steady => (SMALL * twist).max(OF_REST_IF_STEADY * rest),
            Self::Teeth => SMALL_OF_TEETH * twist,
        }
    }
}

/// Whether an order is an encoder's own, or only in step with the joint.
fn whose(data: &Channels, angle: &[f64], order: f64, rows: &[usize], ratio: Option<f64>) -> Whose {
    let near = 0.5 * resolution(angle);
    let of_motor = ratio.is_some_and(|r| {
        let turns = (order / r).round();
        (1.0..=FEW_PER_MOTOR_TURN).contains(&turns) && (order - turns * r).abs() < near
    });
    let few = order <= FEW_PER_TURN + near;
    let ([slow, fast], errors, contrast) = sizes(data, angle, order, rows);
    let even = slow < STEADY * fast && fast < STEADY * slow;
    let alike = even || (slow - fast).abs() < ALIKE * length(&errors);
    // slow and fast motion must both have been seen, unless the order speaks for itself
    let is_known = |error: &f64| *error < KNOWN * slow.max(fast);
    let seen = contrast > CONTRAST && errors.iter().all(is_known);
    match (few, of_motor, seen) {
        (true, ..) | (_, true, false) => Whose::Encoder,
        (_, true, true) if alike => Whose::Encoder,
        (_, false, true) if even => Whose::Steady,
        _ => Whose::Teeth,
    }
}

/// Sizes in the slow and in the fast third of the moving rows with their standard errors, and the ratio of their speeds.
fn sizes(data: &Channels, angle: &[f64], order: f64, rows: &[usize]) -> ([f64; 2], [f64; 2], f64) {
    let mut by_speed = rows.to_vec();
    by_speed.sort_by(|a, b| data.speed[*a].abs().total_cmp(&data.speed[*b].abs()));
    let third = by_speed.len() / 3;
    let thirds = [&by_speed[..third], &by_speed[by_speed.len() - third..]];
    let [slow, fast] = thirds.map(|of| size_in(of, data, angle, order));
    let speed =
        |of: &[usize]| of.iter().map(|i| data.speed[*i].abs()).sum::<f64>() / of.len() as f64;
    let contrast = speed(thirds[1]) / speed(thirds[0]);
    ([slow[0], fast[0]], [slow[1], fast[1]], contrast)
}

/// Size of a wave of the twist in some rows beside a level, slopes over angle and speed, and the torque's part there; and its
/// standard error.
fn size_in(rows: &[usize], data: &Channels, angle: &[f64], order: f64) -> [f64; 2] {
    let taken = |values: &[f64]| rows.iter().map(|i| values[*i]).collect::<Vec<f64>>();
    let reading = taken(&data.twist);
    let mut base = [angle, &data.torque, &data.speed].map(taken).to_vec();
    base.push(vec![1.0; rows.len()]);
    let waves = wave(data, angle, order);
    let [sine, cosine] = [0, 1].map(|k| taken(&waves[k]));
    let beside = |other: &Vec<f64>| [base.as_slice(), std::slice::from_ref(other)].concat();
    let parts = [
        partial(&beside(&cosine), &sine, &reading),
        partial(&beside(&sine), &cosine, &reading),
    ];
    let noise = rms(&left(&[beside(&cosine), vec![sine]].concat(), &reading));
    let variance = parts.map(|p| 0.5 * noise * noise / p.square);
    [
        length(&parts.map(|p| p.slope)),
        variance.iter().sum::<f64>().sqrt(),
    ]
}

#[cfg(test)]
mod tests {
    use super::{Channels, partial, wave};
    use crate::measurement::joint_motion::JointRecord;
    use std::f64::consts::TAU;

    /// At constant speed, three readings to a row and three rows to a period: a row shows five sixths of a ripple.
    #[test]
    fn averaged_rows_show_a_fast_ripple_as_it_is() {
        let rows = 9000;
        let time: Vec<f64> = (0..rows).map(|i| f64::from(i) * 0.004).collect();
        let motor: Vec<f64> = time.iter().map(|t| 0.5 * t).collect();
        let order = TAU / (0.5 * 9.0 * 0.004);
        let link = motor.iter().map(|q| q + 4e-5 * (order * q).sin());
        let still = vec![0.0; motor.len()];
        let record = JointRecord::bare([time, motor.clone(), link.collect(), still]);
        let data = Channels::of(&record);
        assert_eq!(data.block, 3);
        let [sine, cosine] = [0, 1].map(|k| wave(&data, &data.motor, order)[k].clone());
        let size = partial(&[cosine], &sine, &data.twist).slope;
        assert!((size / 4e-5 - 1.0).abs() < 1e-3, "{size}");
    }
}
