//! The FRFs of a hammer test as data of a tuning.

use super::frf_data::{Errors, Measured};
use crate::experiments::hammer_frf::{HammerFrf, InputFrf};
use crate::experiments::hammer_variance::variance;
use crate::signal::frf::Estimator;
use crate::signal::jackknife;
use rustfft::num_complex::Complex64;

/// The rows of the Jacobian by name.
const ROWS: [&str; 3] = ["x", "y", "z"];

/// Every measured pair along the base axes from `from_hz` to `to_hz`, with variance and window.
/// Records that end before the decay need an exponential window: the model is evaluated at `jω + σ`,
/// but knows no end of the record.
pub fn measured(frf: &HammerFrf, from_hz: f64, to_hz: f64) -> Vec<Measured> {
    let inside = |k: &usize| (from_hz..=to_hz).contains(&frf.frequency_hz[*k]);
    let lines: Vec<usize> = (1..frf.frequency_hz.len()).filter(inside).collect();
    let row = |name: &str| ROWS.iter().position(|row| *row == name);
    let mut all = Vec::new();
    for input in &frf.inputs {
        for (o, name) in frf.outputs.iter().enumerate() {
            if let (Some(from), Some(to)) = (row(&input.input), row(name)) {
                all.push(pair(frf, input, o, [from, to], &lines));
            }
        }
    }
    all
}

fn pair(
    frf: &HammerFrf,
    input: &InputFrf,
    channel: usize,
    [from, to]: [usize; 2],
    lines: &[usize],
) -> Measured {
    Measured {
        input: from,
        output: to,
        frequency_hz: lines.iter().map(|k| frf.frequency_hz[*k]).collect(),
        rate: frf.rate,
        length_s: frf.length_s,
        frf: lines
            .iter()
            .map(|k| input.sums.lines[channel][*k].h1())
            .collect(),
        variance: variance(input, channel, lines),
        errors: Errors {
            impulse_s: frf.impulse_s,
            shared: shared(frf, input, lines),
            left_out: left_out(input, channel, lines),
        },
    }
}

/// H1 with each of the hits left out; nothing where there is one.
fn left_out(input: &InputFrf, channel: usize, lines: &[usize]) -> Vec<Vec<Complex64>> {
    match input.hits.len() {
        0 | 1 => Vec::new(),
        _ => jackknife::left_out(&input.sums, &input.hits, channel, Estimator::H1, lines),
    }
}

/// Errors of the force by its noise within its window: one of every sample, one of the baseline.
fn shared(frf: &HammerFrf, input: &InputFrf, lines: &[usize]) -> Vec<Vec<Complex64>> {
    let (Some(noise), Some(output)) = (input.force_noise, input.sums.lines.first()) else {
        return Vec::new();
    };
    let over_force = |k: usize| 1.0 / output[k].ff.sqrt();
    let turn = |k: usize, sample: isize| {
        let time = sample as f64 * frf.interval_s;
        Complex64::cis(-std::f64::consts::TAU * frf.frequency_hz[k] * time)
    };
    let sample = |i: isize| -> Vec<Complex64> {
        let error = |k: &usize| turn(*k, i) * noise.std * over_force(*k);
        lines.iter().map(error).collect()
    };
    let all = |k: usize| {
        (noise.from..noise.to)
            .map(|i| turn(k, i))
            .sum::<Complex64>()
    };
    let offset = |k: &usize| all(*k) * noise.offset_std * over_force(*k);
    let samples = (noise.from..noise.to).map(sample);
    samples
        .chain(std::iter::once(lines.iter().map(offset).collect()))
        .collect()
}
