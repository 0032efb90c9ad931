//! Errors periodic in the angle of an encoder: their orders, and whose they can be.
//!
//! An encoder closes on itself: its errors repeat with whole turns of its own shaft, and are as large
//! in slow as in fast motion. Meshing teeth make orders of their own, whose size changes with speed.

use super::channels::{Channels, largest, range};
use super::projection::{left, partial};
use crate::ground::stats::{length, rms};
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Bins of an angle's range, and of its spectrum.
const BINS: usize = 4096;
const PADDED: usize = 8 * BINS;
/// Periods that must lie in the range of the motion.
const FEWEST_PERIODS: f64 = 2.5;
/// Speed, as a share of the largest, below which rows do not count.
const MOVING: f64 = 0.04;
/// Peaks followed per angle.
const PEAKS: usize = 2;
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
        for order in orders(angle, residual, &rows) {
            let near = |w: &Wave| (w.order - order).abs() < resolution(angle);
            if found.iter().any(near) {
                continue;
            }
            let whose = whose(data, angle, order, &rows, ratio);
            found.push(Wave {
                of_encoder: whose != Whose::Teeth,
                is_small: size(&wave(angle, order), residual) < whose.least(twist, rest),
                columns: wave(angle, order),
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

fn wave(angle: &[f64], order: f64) -> Vec<Vec<f64>> {
    let one = |f: fn(f64) -> f64| angle.iter().map(|q| f(order * q)).collect();
    vec![one(f64::sin), one(f64::cos)]
}

fn moving(data: &Channels) -> Vec<usize> {
    let still = MOVING * data.top_speed();
    (0..data.rows())
        .filter(|i| data.speed[*i].abs() > still)
        .collect()
}

fn resolution(angle: &[f64]) -> f64 {
    let (low, high) = range(angle);
    TAU / (high - low).max(f64::MIN_POSITIVE)
}

/// Highest order that is sought: one sample per period at top speed. Speeds vary, so that orders beyond
/// half the sampling rate are not mistaken for others.
fn highest(angle: &[f64]) -> f64 {
    let steps: Vec<f64> = angle.windows(2).map(|w| w[1] - w[0]).collect();
    TAU / largest(&steps).max(f64::MIN_POSITIVE)
}

/// Orders (rad per rad) of the largest peaks of the spectrum over the angle, each beside those before: side lobes are none.
fn orders(angle: &[f64], residual: &[f64], rows: &[usize]) -> Vec<f64> {
    let mut rest = residual.to_vec();
    let one = |_| {
        let order = refined(angle, &rest, rows, peak(angle, &rest, rows)?);
        rest = left(&wave(angle, order), &rest);
        Some(order)
    };
    (0..PEAKS).map_while(one).collect()
}

/// Order of the largest peak.
fn peak(angle: &[f64], residual: &[f64], rows: &[usize]) -> Option<f64> {
    let (low, high) = range(angle);
    let width = (high - low) / BINS as f64;
    if width <= 0.0 || rows.len() < 64 {
        return None;
    }
    let power = spectrum(angle, residual, rows, low, width);
    let order = |k: usize| TAU * k as f64 / (PADDED as f64 * width);
    let first = (FEWEST_PERIODS * PADDED as f64 / BINS as f64) as usize;
    let last = (1..PADDED / 2)
        .take_while(|k| order(*k) < highest(angle))
        .last()
        .unwrap_or(0);
    let tops = (first..last).filter(|k| power[*k] > power[k - 1] && power[*k] >= power[k + 1]);
    tops.max_by(|a, b| power[*a].total_cmp(&power[*b]))
        .map(order)
}

/// The order near a peak that fits the rows best: rows dwell unevenly over the angle, and shift peaks.
fn refined(angle: &[f64], residual: &[f64], rows: &[usize], order: f64) -> f64 {
    let taken = |values: &[f64]| rows.iter().map(|i| values[*i]).collect::<Vec<f64>>();
    let (angles, reading) = (taken(angle), taken(residual));
    let misfit = |order: f64| rms(&left(&wave(&angles, order), &reading));
    let mut best = order;
    for width in [0.1, 0.02] {
        let step = width * resolution(angle);
        let around = (-5..=5).map(|k| best + f64::from(k) * step);
        let tried: Vec<(f64, f64)> = around.map(|o| (misfit(o), o)).collect();
        let least = tried.iter().min_by(|a, b| a.0.total_cmp(&b.0));
        best = least.map_or(best, |t| t.1);
    }
    best
}

fn spectrum(angle: &[f64], residual: &[f64], rows: &[usize], low: f64, width: f64) -> Vec<f64> {
    let mut bins = vec![Complex64::new(0.0, 0.0); PADDED];
    for i in rows {
        let bin = (((angle[*i] - low) / width) as usize).min(BINS - 1);
        bins[bin].re += residual[*i];
    }
    FftPlanner::new()
        .plan_fft_forward(PADDED)
        .process(&mut bins);
    bins.iter().map(|z| z.norm_sqr()).collect()
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
    let waves = wave(angle, order);
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
