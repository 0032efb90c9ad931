//! Errors periodic in the angle of an encoder: their orders, and whose they can be.
//!
//! An encoder closes on itself: its errors repeat with whole turns of its own shaft, and are as large
//! in slow as in fast motion. Meshing teeth make orders of their own, whose size changes with speed.

use super::channels::{Channels, largest};
use super::columns::{Atom, Kind, periodic, range};
use super::unseen::amplitudes;
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
/// Ratio of fast to slow speeds that allows the comparison.
const CONTRAST: f64 = 2.5;

/// The periodic candidates that a residual suggests.
pub fn ripples(data: &Channels, residual: &[f64], ratio: Option<f64>) -> Vec<Atom> {
    let rows = moving(data);
    let mut found: Vec<Atom> = Vec::new();
    for (angle, per_turn) in [(&data.link, None), (&data.motor, ratio)] {
        for order in peaks(angle, residual, &rows) {
            if taken(&found, order, angle) {
                continue;
            }
            let order = refined(angle, residual, &rows, order);
            let own = whose(data, residual, angle, order, &rows, per_turn.or(ratio));
            found.push(periodic(own, angle, order, BINS / 8));
        }
    }
    found
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

fn taken(found: &[Atom], order: f64, angle: &[f64]) -> bool {
    found
        .iter()
        .any(|a| (a.shape - order).abs() < resolution(angle))
}

/// Highest order that is sought: one sample per period at top speed. Speeds vary, so that orders beyond
/// half the sampling rate are not mistaken for others.
fn highest(angle: &[f64]) -> f64 {
    let steps: Vec<f64> = angle.windows(2).map(|w| w[1] - w[0]).collect();
    TAU / largest(&steps).max(f64::MIN_POSITIVE)
}

/// Orders (rad per rad) of the largest peaks of the spectrum over the angle.
fn peaks(angle: &[f64], residual: &[f64], rows: &[usize]) -> Vec<f64> {
    let (low, high) = range(angle);
    let width = (high - low) / BINS as f64;
    if width <= 0.0 || rows.len() < 64 {
        return Vec::new();
    }
    let power = spectrum(angle, residual, rows, low, width);
    let order = |k: usize| TAU * k as f64 / (PADDED as f64 * width);
    let first = (FEWEST_PERIODS * PADDED as f64 / BINS as f64) as usize;
    let last = (1..PADDED / 2)
        .take_while(|k| order(*k) < highest(angle))
        .last()
        .unwrap_or(0);
    let mut tops: Vec<usize> = (first..last)
        .filter(|k| power[*k] > power[k - 1] && power[*k] >= power[k + 1])
        .collect();
    tops.sort_by(|a, b| power[*b].total_cmp(&power[*a]));
    let mut kept: Vec<usize> = Vec::new();
    for k in tops {
        let apart = |other: &usize| k.abs_diff(*other) > PADDED / BINS;
        if kept.len() < PEAKS && kept.iter().all(apart) {
            kept.push(k);
        }
    }
    kept.into_iter().map(order).collect()
}

/// The order near a peak that fits the rows best: rows dwell unevenly over the angle, and shift peaks.
fn refined(angle: &[f64], residual: &[f64], rows: &[usize], order: f64) -> f64 {
    let misfit = |order: f64| {
        let wave = periodic(Kind::Ripple, angle, order, 1).columns;
        let columns: Vec<&[f64]> = wave.iter().map(Vec::as_slice).collect();
        let a = amplitudes(&columns, residual, rows);
        let left = |i: &usize| (residual[*i] - a[0] * wave[0][*i] - a[1] * wave[1][*i]).powi(2);
        rows.iter().map(left).sum::<f64>()
    };
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

/// Whether an order is an encoder's own, or only in step with the joint.
fn whose(
    data: &Channels,
    residual: &[f64],
    angle: &[f64],
    order: f64,
    rows: &[usize],
    ratio: Option<f64>,
) -> Kind {
    let near = 0.5 * resolution(angle);
    let of_motor = ratio.is_some_and(|r| {
        let turns = (order / r).round();
        (1.0..=FEW_PER_MOTOR_TURN).contains(&turns) && (order - turns * r).abs() < near
    });
    let few = order <= FEW_PER_TURN + near;
    let [slow, fast, contrast] = sizes(data, residual, angle, order, rows);
    let even = slow < STEADY * fast && fast < STEADY * slow;
    // slow and fast motion must both have been seen, unless the order speaks for itself
    let seen = contrast > CONTRAST;
    let steady = match seen {
        true => even,
        false => of_motor,
    };
    match few || steady {
        true => Kind::Ripple,
        false => Kind::Mesh,
    }
}

/// Sizes in the slow and in the fast third of the moving rows, and the ratio of their speeds.
fn sizes(data: &Channels, residual: &[f64], angle: &[f64], order: f64, rows: &[usize]) -> [f64; 3] {
    let mut by_speed = rows.to_vec();
    by_speed.sort_by(|a, b| data.speed[*a].abs().total_cmp(&data.speed[*b].abs()));
    let third = by_speed.len() / 3;
    let (slow, fast) = (&by_speed[..third], &by_speed[by_speed.len() - third..]);
    let size = |of: &[usize]| {
        let sum: Complex64 = of
            .iter()
            .map(|i| residual[*i] * Complex64::from_polar(1.0, -order * angle[*i]))
            .sum();
        2.0 * sum.norm() / of.len().max(1) as f64
    };
    let speed =
        |of: &[usize]| of.iter().map(|i| data.speed[*i].abs()).sum::<f64>() / of.len() as f64;
    [size(slow), size(fast), speed(fast) / speed(slow)]
}
