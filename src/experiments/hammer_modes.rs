//! Hammer tests: modes of the structure.

use super::hammer_frf::{HammerFrf, InputFrf};
use super::hammer_variance::variance;
use crate::signal::frf::{CrossSpectra, Estimator};
use crate::signal::jackknife::leave_one_out;
use crate::signal::modal_model::Channels;
use crate::signal::modes::{Mode, identify};
use crate::signal::stabilisation::{Point, chart};
use rustfft::num_complex::Complex64;

/// The lines beyond the band that are fitted too, so that modes at its end are seen whole.
const MARGIN: f64 = 1.3;
/// Below this an accelerometer sees drift, Hz.
const LOWEST_HZ: f64 = 1.0;
/// The modes up to `to_hz`, with 95 % intervals by jackknife over hits.
pub fn modes(frf: &HammerFrf, to_hz: f64) -> Vec<Mode> {
    let lines = lines(frf, to_hz);
    let sums: Vec<&CrossSpectra> = frf.inputs.iter().map(|input| &input.sums).collect();
    let weight = weights(frf, &lines);
    let channels = channels(frf, &sums, &lines, &weight);
    let left_out: Vec<Vec<CrossSpectra>> =
        frf.inputs.iter().map(|i| leave_one_out(&i.hits)).collect();
    let replicates = left_out.iter().map(Vec::len).min().unwrap_or(0);
    let replicates = if replicates < 2 { 0 } else { replicates };
    let left_out: Vec<Channels> = (0..replicates)
        .map(|k| {
            let sums: Vec<&CrossSpectra> = left_out.iter().map(|all| &all[k]).collect();
            self::channels(frf, &sums, &lines, &weight)
        })
        .collect();
    identify(&channels, &left_out, to_hz)
}

/// The stabilisation chart from which the modes up to `to_hz` were chosen.
pub fn stabilisation(frf: &HammerFrf, to_hz: f64) -> Vec<Point> {
    let lines = lines(frf, to_hz);
    let sums: Vec<&CrossSpectra> = frf.inputs.iter().map(|input| &input.sums).collect();
    let channels = channels(frf, &sums, &lines, &weights(frf, &lines));
    match channels.lines() < 8 {
        true => Vec::new(),
        false => chart(&channels),
    }
}

fn lines(frf: &HammerFrf, to_hz: f64) -> Vec<usize> {
    let inside = |k: &usize| {
        let f = frf.frequency_hz[*k];
        *k > 0 && f >= LOWEST_HZ && f <= MARGIN * to_hz
    };
    (0..frf.frequency_hz.len()).filter(inside).collect()
}

fn channels(
    frf: &HammerFrf,
    sums: &[&CrossSpectra],
    lines: &[usize],
    weight: &[Vec<f64>],
) -> Channels {
    let channel = |sums: &CrossSpectra, output: usize| -> Vec<Complex64> {
        lines
            .iter()
            .map(|k| sums.lines[output][*k].estimate(Estimator::H1))
            .collect()
    };
    let outputs = frf.outputs.len();
    let pairs = sums
        .iter()
        .flat_map(|sums| (0..outputs).map(|o| channel(sums, o)));
    Channels {
        frequency_hz: lines.iter().map(|k| frf.frequency_hz[*k]).collect(),
        rate: frf.rate,
        decay_s: frf.length_s - frf.impulse_s,
        interval_s: frf.interval_s,
        shape: (sums.len(), outputs),
        frf: pairs.collect(),
        weight: weight.to_vec(),
    }
}

/// One over the standard deviation, from the scatter of the hits.
fn weights(frf: &HammerFrf, lines: &[usize]) -> Vec<Vec<f64>> {
    let pairs = frf
        .inputs
        .iter()
        .flat_map(|input| (0..frf.outputs.len()).map(move |o| (input, o)));
    pairs
        .map(|(input, output)| weight(input, output, lines))
        .collect()
}

fn weight(input: &InputFrf, output: usize, lines: &[usize]) -> Vec<f64> {
    let variance = variance(input, output, lines);
    variance.iter().map(|v| v.sqrt().recip()).collect()
}
