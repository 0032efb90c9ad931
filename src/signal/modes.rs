//! Modes in a band: poles by stabilisation, kept where they pay, refined, with intervals.

use super::jackknife::{t95, variance};
use super::modal_fit::{PoleFit, cost, linear_fits, refine};
use super::modal_model::{Channels, damping, frequency};
use super::stabilisation::{Candidate, candidates, chart};
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// A mode of the structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Pole, 1/s, corrected for the exponential window.
    pub pole: Complex64,
    /// Undamped natural frequency, Hz.
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Half widths of the 95 % intervals of frequency (Hz) and damping ratio; not a number with
    /// fewer than two hits per direction.
    pub half_width: [f64; 2],
    /// Residue of the accelerance per channel, `[input · outputs + output]`, (m/s²)/N·1/s.
    pub residues: Vec<Complex64>,
}

/// Steps of the refinement of poles.
const STEPS: usize = 25;

/// The modes up to `to_hz` in `channels`; `left_out` are the same FRFs with one hit of every
/// direction left out in turn.
pub fn identify(channels: &Channels, left_out: &[Channels], to_hz: f64) -> Vec<Mode> {
    if channels.lines() < 8 {
        return Vec::new();
    }
    let found = candidates(&chart(channels));
    let chosen = choose(channels, &found);
    let refined = prune(channels, refine(channels, &chosen, STEPS));
    let refined = missing(channels, beyond(channels, refined), &found);
    let again: Vec<Vec<Complex64>> = left_out
        .par_iter()
        .map(|part| refine(part, &refined.poles, 6).poles)
        .collect();
    modes(channels, &refined.poles, &again, to_hz)
}

/// Takes candidates in the order of how often they were seen, as long as they lower Schwarz's
/// information criterion.
fn choose(channels: &Channels, found: &[Candidate]) -> Vec<Complex64> {
    let most = found.first().map_or(0, |candidate| candidate.seen);
    let often = found
        .iter()
        .filter(|candidate| candidate.seen * 6 >= most && candidate.seen > 2);
    let mut chosen: Vec<Complex64> = Vec::new();
    let mut best = criterion(channels, cost(channels, &chosen), 0);
    for candidate in often.take(MOST) {
        chosen.push(candidate.pole);
        let now = criterion(channels, cost(channels, &chosen), chosen.len());
        if now < best {
            best = now;
        } else {
            chosen.pop();
        }
    }
    chosen
}

/// Most candidates tried.
const MOST: usize = 40;

/// `n·ln(cost/N) + k·ln n` (Schwarz 1978): each mode costs its pole and a residue per channel. An
/// exponential window correlates `x·coth x` lines, `x = σT`: only n of N values are independent.
fn criterion(channels: &Channels, cost: f64, modes: usize) -> f64 {
    let all = (2 * channels.lines() * channels.frf.len()) as f64;
    let x = (channels.rate * channels.decay_s).max(1e-6);
    let n = all * x.tanh() / x;
    let parameters = (modes * (2 + 2 * channels.frf.len())) as f64;
    n * (cost / all).max(1e-300).ln() + parameters * n.ln()
}

/// Drops modes that do not pay after the refinement.
fn prune(channels: &Channels, mut fit: PoleFit) -> PoleFit {
    loop {
        let n = fit.poles.len();
        let now = criterion(channels, fit.cost, n);
        let without = |i: usize| {
            let mut poles = fit.poles.clone();
            poles.remove(i);
            let cost = cost(channels, &poles);
            (criterion(channels, cost, n - 1), poles)
        };
        let best = (0..n).map(without).min_by(|a, b| a.0.total_cmp(&b.0));
        match best {
            Some((value, poles)) if value < now => fit = refine(channels, &poles, STEPS),
            _ => return fit,
        }
    }
}

/// Adds modes above the lines, as long as they pay: the series of the residual terms converges
/// slowly towards the nearest of them, and what is left biases the damping of weak modes.
fn beyond(channels: &Channels, mut fit: PoleFit) -> PoleFit {
    let top = std::f64::consts::TAU * channels.frequency_hz[channels.lines() - 1];
    for place in [1.2, 1.9] {
        let pole = Complex64::new(-0.02 * place * top, place * top);
        match with(channels, &fit, pole) {
            Some(more) => fit = more,
            None => break,
        }
    }
    fit
}

/// Adds candidates that were passed over, and poles where most is left unexplained, as long as they
/// pay once all poles are refined together: beside strong modes a weak one pays only then.
fn missing(channels: &Channels, mut fit: PoleFit, found: &[Candidate]) -> PoleFit {
    let far = |pole: &Complex64, fit: &PoleFit| {
        fit.poles
            .iter()
            .all(|p| (p - pole).norm() > 0.02 * pole.norm())
    };
    let left_over: Vec<Complex64> = found.iter().map(|candidate| candidate.pole).collect();
    let tries = left_over
        .into_iter()
        .filter(|pole| far(pole, &fit))
        .take(TRIES);
    for pole in tries.collect::<Vec<_>>() {
        if far(&pole, &fit) {
            fit = with(channels, &fit, pole).unwrap_or(fit);
        }
    }
    for _ in 0..TRIES {
        let place = worst_line(channels, &fit.poles);
        let more =
            place.and_then(|place| with(channels, &fit, Complex64::new(-0.03 * place, place)));
        match more {
            Some(more) => fit = more,
            None => break,
        }
    }
    fit
}

/// Most poles tried one by one.
const TRIES: usize = 4;

/// The fit with one more pole, if it pays.
fn with(channels: &Channels, fit: &PoleFit, pole: Complex64) -> Option<PoleFit> {
    let n = fit.poles.len();
    let poles: Vec<Complex64> = fit.poles.iter().copied().chain([pole]).collect();
    let more = refine(channels, &poles, STEPS / 2);
    let pays = criterion(channels, more.cost, n + 1) < criterion(channels, fit.cost, n);
    (pays && more.poles.iter().all(|p| damping(*p) < 0.5)).then_some(more)
}

/// Circular frequency, 1/s, of the line at which most is left, over three lines and all channels.
fn worst_line(channels: &Channels, poles: &[Complex64]) -> Option<f64> {
    let fits = linear_fits(channels, poles)?;
    let n = channels.lines();
    let left = |k: usize| -> f64 {
        let lines = k.saturating_sub(1)..(k + 2).min(n);
        let power = |k: usize| -> f64 {
            fits.iter()
                .map(|fit| fit.rest[k].powi(2) + fit.rest[n + k].powi(2))
                .sum()
        };
        lines.map(power).sum()
    };
    let worst = (0..n).max_by(|a, b| left(*a).total_cmp(&left(*b)))?;
    Some(std::f64::consts::TAU * channels.frequency_hz[worst])
}

fn modes(
    channels: &Channels,
    poles: &[Complex64],
    again: &[Vec<Complex64>],
    to_hz: f64,
) -> Vec<Mode> {
    let Some(fits) = linear_fits(channels, poles) else {
        return Vec::new();
    };
    let mode = |(r, pole): (usize, &Complex64)| {
        let half_width = |f: fn(Complex64) -> f64| {
            let values: Vec<f64> = again.iter().map(|poles| f(poles[r])).collect();
            variance(&values).sqrt() * t95(values.len() as f64 - 1.0)
        };
        let residue = |fit: &super::modal_model::LinearFit| {
            Complex64::new(fit.unknowns[2 * r], fit.unknowns[2 * r + 1])
        };
        Mode {
            pole: *pole,
            frequency_hz: frequency(*pole),
            damping_ratio: damping(*pole),
            half_width: [half_width(frequency), half_width(damping)],
            residues: fits.iter().map(residue).collect(),
        }
    };
    let mut modes: Vec<Mode> = poles.iter().enumerate().map(mode).collect();
    modes.retain(|mode| mode.frequency_hz <= to_hz && mode.damping_ratio < 0.3);
    modes.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    modes
}
