//! Hammer tests: modes of the structure.

use super::hammer_frf::{HammerFrf, InputFrf};
use super::hammer_given::ScatterFrom;
use super::hammer_variance::variance;
use crate::signal::frf::{CrossSpectra, Estimator, Line};
use crate::signal::jackknife;
use crate::signal::modal_model::Channels;
use crate::signal::modes::{LeftOut, Mode, identify};
use crate::signal::stabilisation::{Point, chart};
use rustfft::num_complex::Complex64;

/// End of the lines against that of the band: heavily damped modes above the band reach into it, and
/// are told from those inside only where they are seen whole.
const MARGIN: f64 = 2.5;
/// Up to this share of the band every line counts, beyond it every other one.
const DENSE: f64 = 1.3;
/// Below this an accelerometer sees drift, Hz.
const LOWEST_HZ: f64 = 1.0;
/// Share of the sampling rate below which no filter against aliasing is seen.
const UNFILTERED: f64 = 0.35;
/// Highest weight, N/(m/s²): a dead channel has no scatter.
const MOST: f64 = 1e60;
/// Beyond the band, lines end where the power of the force falls below this share of its highest.
const EXCITED: f64 = 0.003;

/// The modes up to `to_hz`, with 95 % intervals by jackknife over hits.
pub fn modes(frf: &HammerFrf, to_hz: f64) -> Vec<Mode> {
    let lines = lines(frf, to_hz);
    identify(&channels(frf, &lines), &left_out(frf, &lines), to_hz)
}

/// The records as they were, before any window of ours.
fn inputs(frf: &HammerFrf) -> &[InputFrf] {
    frf.for_modes.as_deref().unwrap_or(&frf.inputs)
}

/// Rate of the window that is in the records, 1/s.
fn rate(frf: &HammerFrf) -> f64 {
    match frf.for_modes {
        Some(_) => frf.recorded_rate,
        None => frf.rate,
    }
}

fn left_out(frf: &HammerFrf, lines: &[usize]) -> LeftOut {
    let of = |input: &InputFrf| {
        let output = |o| jackknife::left_out(&input.sums, &input.hits, o, Estimator::H1, lines);
        (0..frf.outputs.len()).map(output).collect()
    };
    match frf.scatter_from {
        ScatterFrom::Hits => inputs(frf).iter().map(of).collect(),
        _ => LeftOut::new(),
    }
}

/// H1 per output at `lines`.
fn all(sums: &CrossSpectra, lines: &[usize]) -> Vec<Vec<Complex64>> {
    let h1 = |output: &Vec<Line>| lines.iter().map(|k| output[*k].h1()).collect();
    sums.lines.iter().map(h1).collect()
}

/// The stabilisation chart from which the modes up to `to_hz` were chosen.
pub fn stabilisation(frf: &HammerFrf, to_hz: f64) -> Vec<Point> {
    let lines = lines(frf, to_hz);
    let channels = channels(frf, &lines);
    match channels.lines() < 8 {
        true => Vec::new(),
        false => chart(&channels),
    }
}

/// The lines of `frf` that carry the modes up to `to_hz`.
pub fn lines(frf: &HammerFrf, to_hz: f64) -> Vec<usize> {
    let top = (MARGIN * to_hz).min(to_hz.max(UNFILTERED / frf.interval_s));
    let inside = |k: &usize| {
        let f = frf.frequency_hz[*k];
        let kept = f <= DENSE * to_hz || k.is_multiple_of(2);
        *k > 0 && f >= LOWEST_HZ && f <= top && kept
    };
    let lines = (0..frf.frequency_hz.len()).filter(inside);
    let forces: Vec<Vec<f64>> = inputs(frf).iter().map(force).collect();
    let strongest = |force: &Vec<f64>| force.iter().skip(1).fold(0.0, |a: f64, b| a.max(*b));
    let most: Vec<f64> = forces.iter().map(strongest).collect();
    let excited = |k: &usize| {
        let weak = |(force, most): (&Vec<f64>, &f64)| force[*k] < EXCITED * most;
        frf.frequency_hz[*k] <= to_hz || !forces.iter().zip(&most).any(weak)
    };
    lines.take_while(excited).collect()
}

/// What the modes are fitted to.
pub fn channels(frf: &HammerFrf, lines: &[usize]) -> Channels {
    Channels {
        frequency_hz: lines.iter().map(|k| frf.frequency_hz[*k]).collect(),
        rate: rate(frf),
        decay_s: frf.length_s - frf.impulse_s,
        interval_s: frf.interval_s,
        shape: (inputs(frf).len(), frf.outputs.len()),
        driven: driven(frf),
        pulse_s2: inputs(frf)
            .iter()
            .map(|input| pulse_s2(frf, input, lines))
            .collect(),
        frf: inputs(frf)
            .iter()
            .flat_map(|input| all(&input.sums, lines))
            .collect(),
        weight: weights(frf, lines),
    }
}

/// Which output measures along each direction of the force, if each has its own.
fn driven(frf: &HammerFrf) -> Option<Vec<usize>> {
    let place = |input: &InputFrf| frf.outputs.iter().position(|o| *o == input.input);
    let places: Vec<usize> = inputs(frf).iter().map(place).collect::<Option<_>>()?;
    (places.len() == frf.outputs.len()).then_some(places)
}

/// Power of the force per line.
fn force(input: &InputFrf) -> Vec<f64> {
    let lines = input.sums.lines.first();
    lines.map_or(Vec::new(), |lines| {
        lines.iter().map(|line| line.ff).collect()
    })
}

/// Mean square duration about the middle: `|F(ω)|² ≈ |F(0)|²·e^{−ω²·d}`, from the lines.
fn pulse_s2(frf: &HammerFrf, input: &InputFrf, lines: &[usize]) -> f64 {
    let Some(output) = input.sums.lines.first() else {
        return 0.0;
    };
    let point = |k: &usize| {
        let w = std::f64::consts::TAU * frf.frequency_hz[*k];
        (w * w, output[*k].ff.ln())
    };
    let points: Vec<(f64, f64)> = lines.iter().map(point).collect();
    let n = points.len().max(1) as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |s, p| (s.0 + p.0 / n, s.1 + p.1 / n));
    let (up, over) = points.iter().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - x) * (p.1 - y), s.1 + (p.0 - x).powi(2))
    });
    let duration = -up / over;
    if duration.is_finite() {
        duration.max(0.0)
    } else {
        0.0
    }
}

/// One over the standard deviation, from the scatter of the hits.
fn weights(frf: &HammerFrf, lines: &[usize]) -> Vec<Vec<f64>> {
    let pairs = inputs(frf)
        .iter()
        .flat_map(|input| (0..frf.outputs.len()).map(move |o| (input, o)));
    pairs
        .map(|(input, output)| weight(input, output, lines))
        .collect()
}

fn weight(input: &InputFrf, output: usize, lines: &[usize]) -> Vec<f64> {
    let variance = variance(input, output, lines);
    variance
        .iter()
        .map(|v| v.sqrt().recip().min(MOST))
        .collect()
}
