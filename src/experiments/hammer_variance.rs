//! Hammer tests: variance of the FRFs, from the scatter of the hits.

use super::hammer_frf::InputFrf;
use crate::signal::frf::Estimator;
use crate::signal::jackknife::frf_variance;

/// Half width, lines, over which variances are averaged: few hits give rough ones.
const SMOOTHING: usize = 6;
/// Relative standard deviation taken for a single hit, which shows no scatter.
const SINGLE: f64 = 0.01;
/// Least relative standard deviation, of the value and of its root mean square in the band: no
/// calibration is better.
const FLOOR: f64 = 0.001;

/// Variance `var(Re) + var(Im)` of H1 of one output at `lines`, ((m/s²)/N)².
pub fn variance(input: &InputFrf, output: usize, lines: &[usize]) -> Vec<f64> {
    let power = |k: &usize| input.sums.lines[output][*k].h1().norm_sqr();
    let size: Vec<f64> = lines.iter().map(power).collect();
    let mean = size.iter().sum::<f64>() / size.len().max(1) as f64;
    let scatter: Vec<f64> = if input.hits.len() > 1 {
        let all = frf_variance(&input.sums, &input.hits, output, Estimator::H1);
        lines.iter().map(|k| all[*k]).collect()
    } else {
        size.iter().map(|s| SINGLE.powi(2) * s).collect()
    };
    let floor = |s: &f64| FLOOR.powi(2) * (s + mean) + f64::MIN_POSITIVE;
    let smooth = smoothed(&scatter);
    smooth
        .iter()
        .zip(&size)
        .map(|(v, s)| v + floor(s))
        .collect()
}

fn smoothed(values: &[f64]) -> Vec<f64> {
    let mean = |i: usize| {
        let range = i.saturating_sub(SMOOTHING)..(i + SMOOTHING + 1).min(values.len());
        values[range.clone()].iter().sum::<f64>() / range.len() as f64
    };
    (0..values.len()).map(mean).collect()
}
