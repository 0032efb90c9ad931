//! Orders of what repeats over an angle: peaks of a residual's spectrum over it, the strongest first.

use super::channels::{Channels, largest, range};
use super::projection::left;
use crate::ground::stats::rms;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Bins of an angle's range, and of its spectrum.
pub(super) const BINS: usize = 4096;
const PADDED: usize = 8 * BINS;
/// Periods that must lie in the range of the motion.
const FEWEST_PERIODS: f64 = 2.5;
/// Peaks followed per angle.
const PEAKS: usize = 2;

/// Highest order that is sought: one sample per period at top speed. Speeds vary, so that orders beyond
/// half the sampling rate are not mistaken for others. Of averaged rows one and a half, which show
/// two fifths of a ripple; one shows none.
fn highest(data: &Channels, angle: &[f64]) -> f64 {
    let steps: Vec<f64> = angle.windows(2).map(|w| w[1] - w[0]).collect();
    let rows = if data.block > 1 { 1.5 } else { 1.0 };
    TAU / (rows * largest(&steps)).max(f64::MIN_POSITIVE)
}

/// Orders (rad per rad) of the largest peaks of the spectrum over the angle, each beside those before: side lobes are none.
pub(super) fn orders(data: &Channels, angle: &[f64], residual: &[f64], rows: &[usize]) -> Vec<f64> {
    let mut rest = residual.to_vec();
    let one = |_| {
        let order = refined(
            (data, angle),
            &rest,
            rows,
            peak((data, angle), &rest, rows)?,
        );
        rest = left(&wave(data, angle, order), &rest);
        Some(order)
    };
    (0..PEAKS).map_while(one).collect()
}

/// Order of the largest peak.
fn peak((data, angle): (&Channels, &[f64]), residual: &[f64], rows: &[usize]) -> Option<f64> {
    let (low, high) = range(angle);
    let width = (high - low) / BINS as f64;
    if width <= 0.0 || rows.len() < 64 {
        return None;
    }
    let power = spectrum(angle, residual, rows, low, width);
    let order = |k: usize| TAU * k as f64 / (PADDED as f64 * width);
    let first = (FEWEST_PERIODS * PADDED as f64 / BINS as f64) as usize;
    let highest = highest(data, angle);
    let last = (1..PADDED / 2)
        .take_while(|k| order(*k) < highest)
        .last()
        .unwrap_or(0);
    let tops = (first..last).filter(|k| power[*k] > power[k - 1] && power[*k] >= power[k + 1]);
    tops.max_by(|a, b| power[*a].total_cmp(&power[*b]))
        .map(order)
}

/// The order near a peak that fits the rows best: rows dwell unevenly over the angle, and shift peaks.
fn refined(
    (data, angle): (&Channels, &[f64]),
    residual: &[f64],
    rows: &[usize],
    order: f64,
) -> f64 {
    let taken = |values: &[f64]| rows.iter().map(|i| values[*i]).collect::<Vec<f64>>();
    let reading = taken(residual);
    let waves = |order: f64| {
        wave(data, angle, order)
            .iter()
            .map(|w| taken(w))
            .collect::<Vec<_>>()
    };
    let misfit = |order: f64| rms(&left(&waves(order), &reading));
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

/// Sine and cosine of an angle, as large as rows show them.
pub(super) fn wave(data: &Channels, angle: &[f64], order: f64) -> Vec<Vec<f64>> {
    let kept = kept(data, angle, order);
    let one = |f: fn(f64) -> f64| {
        let each = angle.iter().zip(&kept);
        each.map(|(q, kept)| kept * f(order * q)).collect()
    };
    vec![one(f64::sin), one(f64::cos)]
}

/// What the mean over the readings of a row keeps of a wave: the less, the faster its periods pass.
fn kept(data: &Channels, angle: &[f64], order: f64) -> Vec<f64> {
    let (n, readings) = (angle.len(), data.block as f64);
    let of = |i: usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(n - 1));
        let half = 0.5 * order * (angle[b] - angle[a]) / ((b - a) as f64 * readings);
        match half.sin().abs() > 1e-9 {
            true => (readings * half).sin() / (readings * half.sin()),
            false => 1.0,
        }
    };
    (0..n).map(of).collect()
}

/// Least difference of two orders that a range of an angle tells apart.
pub(super) fn resolution(angle: &[f64]) -> f64 {
    let (low, high) = range(angle);
    TAU / (high - low).max(f64::MIN_POSITIVE)
}
