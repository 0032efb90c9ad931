//! Hammer tests: what a linear, passive, reciprocal structure with well mounted sensors would show.

use super::hammer_frf::{HammerFrf, InputFrf};
use super::hammer_variance::variance;
use crate::signal::frf::{Estimator, HitSpectra};
use crate::signal::jackknife::t95;
use rustfft::num_complex::Complex64;

/// Relative difference of `Hij` and `Hji` that is worth a remark.
const RECIPROCITY: f64 = 0.25;
/// ... and that is this many times what the scatter of the hits makes of it.
const CLEAR: f64 = 2.0;
/// Relative change of the FRF from soft to hard hits that is worth a remark.
const LINEARITY: f64 = 0.05;
/// Remarks on sensor signs, reciprocity and linearity from 1 Hz up to `band_hz`.
pub fn remarks(frf: &HammerFrf, band_hz: f64) -> Vec<String> {
    let inside = |k: &usize| (1.0..=band_hz).contains(&frf.frequency_hz[*k]);
    let lines: Vec<usize> = (1..frf.frequency_hz.len()).filter(inside).collect();
    let mut remarks: Vec<String> = Vec::new();
    remarks.extend(silent(frf));
    for (i, input) in frf.inputs.iter().enumerate() {
        remarks.extend(upside_down(frf, input, &lines));
        remarks.extend(nonlinear(input, &lines));
        let later = frf.inputs[i + 1..].iter();
        remarks.extend(later.filter_map(|other| not_reciprocal(frf, input, other, &lines)));
    }
    remarks
}

/// A channel that never moves.
fn silent(frf: &HammerFrf) -> Option<String> {
    let moves = |o: usize| {
        let lines = frf.inputs.iter().flat_map(|input| &input.sums.lines[o]);
        lines.into_iter().any(|line| line.xx > 0.0)
    };
    let names = frf.outputs.iter().enumerate();
    let dead: Vec<String> = names
        .filter(|(o, _)| !moves(*o))
        .map(|(_, name)| format!("a{name}"))
        .collect();
    (!dead.is_empty()).then(|| {
        format!(
            "{}: nothing but zeros: dead, unplugged or not exported; leave the column out, or measure again",
            dead.join(", ")
        )
    })
}

/// A passive structure takes up power: the imaginary part of its driving-point accelerance is
/// positive, summed over the band. Negative: the sensor's sign is wrong.
fn upside_down(frf: &HammerFrf, input: &InputFrf, lines: &[usize]) -> Option<String> {
    let output = frf.outputs.iter().position(|name| *name == input.input)?;
    let cross = |k: &usize| input.sums.lines[output][*k].fx;
    let power: f64 = lines.iter().map(|k| cross(k).im).sum();
    let size: f64 = lines.iter().map(|k| cross(k).norm()).sum();
    let each = |hit: &HitSpectra| {
        let own = lines.iter();
        let own = own.map(|k| (hit.force[*k].conj() * hit.responses[output][*k]).im);
        own.sum::<f64>()
    };
    let each: Vec<f64> = input.hits.iter().map(each).collect();
    let clear = match each.len() {
        0 | 1 => true,
        n => mean(&each) + t95(n as f64 - 1.0) * stderr(&each) < 0.0,
    };
    (power < -0.1 * size && clear).then(|| {
        format!(
            "a{0}: the driving point gives out power (Im < 0): the sensor is mounted upside down, or the force has the wrong sign; change the sign of a{0} in the file",
            input.input
        )
    })
}

fn not_reciprocal(frf: &HammerFrf, a: &InputFrf, b: &InputFrf, lines: &[usize]) -> Option<String> {
    let output = |name: &str| frf.outputs.iter().position(|output| output == name);
    let (at_b, at_a) = (output(&b.input)?, output(&a.input)?);
    let forward = a.frf(at_b, Estimator::H1);
    let backward = b.frf(at_a, Estimator::H1);
    let apart = distance(&forward, &backward, lines);
    let noise =
        variance(a, at_b, lines).iter().sum::<f64>() + variance(b, at_a, lines).iter().sum::<f64>();
    let size: f64 = lines
        .iter()
        .map(|k| forward[*k].norm_sqr() + backward[*k].norm_sqr())
        .sum();
    let noise = (2.0 * noise / size).sqrt();
    (apart > RECIPROCITY && apart > CLEAR * noise).then(|| {
        format!(
            "H_{0}{1} and H_{1}{0} differ by {2:.0} %: a hit or a sensor beside its axis makes that, soon where these are small, and so do play and friction; hit the same point along the sensor's axes",
            a.input,
            b.input,
            100.0 * apart
        )
    })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Standard error of the mean.
fn stderr(values: &[f64]) -> f64 {
    let (n, mean) = (values.len() as f64, mean(values));
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (squares / (n * (n - 1.0))).sqrt()
}

/// Regresses the size of each hit's FRF on the logarithm of its force (Student's t at 95 %).
fn nonlinear(input: &InputFrf, lines: &[usize]) -> Option<String> {
    let levels: Vec<f64> = input
        .hits
        .iter()
        .map(|hit| level(hit, lines).ln())
        .collect();
    let highest = levels.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let range = highest - levels.iter().copied().fold(f64::INFINITY, f64::min);
    let sizes: Vec<f64> = input
        .hits
        .iter()
        .map(|hit| size(input, hit, lines))
        .collect();
    let (slope, stderr) = slope(&levels, &sizes)?;
    let change = slope * range;
    let clear = slope.abs() > t95(levels.len() as f64 - 2.0) * stderr;
    (range > 0.25 && clear && change.abs() > LINEARITY).then(|| {
        format!(
            "direction {}: the FRF changes by {:+.0} % from the softest to the hardest hit ({:.1} times the force): not linear (play, friction)",
            input.input,
            100.0 * change,
            range.exp()
        )
    })
}

fn level(hit: &HitSpectra, lines: &[usize]) -> f64 {
    let power = lines.iter().map(|k| hit.force[*k].norm_sqr());
    power.sum::<f64>().sqrt()
}

/// Size of the FRF of one hit against that of all: `Re⟨H, Hₖ⟩/⟨H, H⟩` over all outputs.
fn size(input: &InputFrf, hit: &HitSpectra, lines: &[usize]) -> f64 {
    let (mut cross, mut auto) = (0.0, 0.0);
    for (sums, response) in input.sums.lines.iter().zip(&hit.responses) {
        for k in lines {
            let all = sums[*k].h1();
            cross += (all.conj() * response[*k] / hit.force[*k]).re;
            auto += all.norm_sqr();
        }
    }
    cross / auto
}

/// Slope of `y` over `x` with its standard error; none below four points.
fn slope(x: &[f64], y: &[f64]) -> Option<(f64, f64)> {
    let n = x.len() as f64;
    if x.len() < 4 {
        return None;
    }
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let spread: f64 = x.iter().map(|x| (x - mx).powi(2)).sum();
    let cross: f64 = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
    let slope = cross / spread;
    let rest = x
        .iter()
        .zip(y)
        .map(|(x, y)| (y - my - slope * (x - mx)).powi(2));
    let variance = rest.sum::<f64>() / (n - 2.0);
    slope
        .is_finite()
        .then(|| (slope, (variance / spread).sqrt()))
}

/// `‖a − b‖` over the root mean square of both norms.
fn distance(a: &[Complex64], b: &[Complex64], lines: &[usize]) -> f64 {
    let apart: f64 = lines.iter().map(|k| (a[*k] - b[*k]).norm_sqr()).sum();
    let size: f64 = lines
        .iter()
        .map(|k| a[*k].norm_sqr() + b[*k].norm_sqr())
        .sum();
    if size > 0.0 {
        (2.0 * apart / size).sqrt()
    } else {
        0.0
    }
}
