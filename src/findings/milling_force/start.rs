//! What must be known before anything can be compared: how fast the spindle really turned, where tooth 1
//! stood, and which tooth of one cut is which of another.

use crate::fit::cut_force::{Account, identify};
use crate::measurement::milling_force::{MillingForce, Record};
use std::f64::consts::TAU;

/// Largest relative error of a stated speed that is looked for.
const FARTHEST: f64 = 0.06;
/// Samples that are looked at.
const SAMPLES: usize = 2000;
/// Harmonics of the tooth passing.
const HARMONICS: usize = 3;
/// Smaller errors are found by the fit itself.
const NEAR: f64 = 1.5e-3;
/// By this factor the lines must stand higher than at the stated speed.
const HIGHER: f64 = 1.03;

/// A fit of everything at the speeds that the records show, and these speeds over the stated ones less one.
pub fn fitted(file: &MillingForce) -> (Account, Vec<f64>) {
    let mut turned = file.clone();
    let mut speeds = Vec::new();
    for (facts, record) in turned.facts.cuts.iter_mut().zip(&file.records) {
        let error = speed_error(record, facts.spindle_rad_s, file.facts.teeth);
        facts.spindle_rad_s *= 1.0 + error;
        speeds.push(error);
    }
    let account = identify(std::slice::from_ref(&turned));
    match level(&mut turned, &account) {
        true => (identify(&[turned]), speeds),
        false => (account, speeds),
    }
}

/// A trend of what is left that is this many times its standard deviation is the sensor's zero.
const TREND: f64 = 8.0;

/// Takes the straight trends of what a fit leaves from the records; true if there was any: the zero of a
/// sensor that wanders would else be taken for the teeth.
fn level(file: &mut MillingForce, account: &Account) -> bool {
    let mut any = false;
    for (record, fit) in file.records.iter_mut().zip(&account.cuts) {
        let time = &fit.data.scene.time;
        let first = record.time[fit.data.settling.min(record.time.len() - 1)];
        for k in 0..3 {
            let left: Vec<f64> = fit.left().map(|r| r[k]).collect();
            let (mean, slope, middle) = line(time, &left);
            let half = 0.5 * (time.last().unwrap_or(&0.0) - time[0]);
            let scatter = crate::ground::stats::rms(&left) / (left.len() as f64).sqrt();
            if mean.abs().max((slope * half).abs()) < TREND * scatter {
                continue;
            }
            any = true;
            for (t, f) in record.time.iter().zip(&mut record.force) {
                f[k] -= mean + slope * (t - first - middle);
            }
        }
    }
    any
}

/// Mean, slope and middle time of the straight line through numbers.
fn line(time: &[f64], values: &[f64]) -> (f64, f64, f64) {
    let count = time.len().max(1) as f64;
    let middle = time.iter().sum::<f64>() / count;
    let mean = values.iter().sum::<f64>() / count;
    let each = time.iter().zip(values);
    let cross: f64 = each.map(|(t, v)| (t - middle) * (v - mean)).sum();
    let square: f64 = time.iter().map(|t| (t - middle).powi(2)).sum();
    (mean, cross / square.max(f64::MIN_POSITIVE), middle)
}

/// Relative error of a stated speed, from the height of the lines of the tooth passing.
fn speed_error(record: &Record, stated: f64, teeth: usize) -> f64 {
    let count = record.time.len().min(SAMPLES);
    let length = record.time[count - 1] - record.time[0];
    let radians = stated * length * teeth as f64 * HARMONICS as f64;
    let step = (0.8 / radians.max(1.0)).min(0.01);
    let steps = (FARTHEST / step) as i64;
    let height = |error: f64| height(record, count, stated * (1.0 + error) * teeth as f64);
    let all = (-steps..=steps)
        .map(|i| i as f64 * step)
        .map(|e| (e, height(e)));
    let Some(best) = all.reduce(|a, b| if b.1 > a.1 { b } else { a }) else {
        return 0.0;
    };
    match best.0.abs() > NEAR.max(step) && best.1 > HIGHER * height(0.0) {
        true => finest(best.0, step, height),
        false => 0.0,
    }
}

/// Vertex of the parabola through the neighbours of the best.
fn finest(at: f64, step: f64, height: impl Fn(f64) -> f64) -> f64 {
    let [a, b, c] = [at - step, at, at + step].map(height);
    let bend = a - 2.0 * b + c;
    match bend < 0.0 {
        true => at + step * (0.5 * (a - c) / bend).clamp(-1.0, 1.0),
        false => at,
    }
}

fn height(record: &Record, count: usize, passing: f64) -> f64 {
    let mut sums = [[0.0; 4]; HARMONICS];
    let mean: [f64; 2] = std::array::from_fn(|k| {
        record.force[..count].iter().map(|f| f[k]).sum::<f64>() / count as f64
    });
    for (t, f) in record.time[..count].iter().zip(&record.force) {
        let angle = (passing * (t - record.time[0])).rem_euclid(TAU);
        for (m, sum) in sums.iter_mut().enumerate() {
            let (s, c) = ((m + 1) as f64 * angle).sin_cos();
            for k in 0..2 {
                sum[2 * k] += (f[k] - mean[k]) * c;
                sum[2 * k + 1] += (f[k] - mean[k]) * s;
            }
        }
    }
    sums.iter().flatten().map(|x| x * x).sum()
}
