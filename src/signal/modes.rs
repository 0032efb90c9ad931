//! Modes in a band: poles by stabilisation, a structure of modes that pay, refined, with intervals.

use super::modal_fit::{Fit, Task};
pub use super::modal_intervals::LeftOut;
use super::modal_intervals::half_widths;
use super::modal_model::{Channels, damping, frequency};
use super::modal_search::search;
use super::stabilisation::{candidates, chart};
use rustfft::num_complex::Complex64;

/// Damping ratios of modes: below, a pole follows one line of noise; beyond, it is a slope.
const UNDAMPED: f64 = 1e-6;
const HEAVILY: f64 = 0.3;

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

/// The modes up to `to_hz` in `channels`; `left_out` are the FRFs of every direction with one of its
/// hits left out in turn.
pub fn identify(channels: &Channels, left_out: &LeftOut, to_hz: f64) -> Vec<Mode> {
    if channels.lines() < 8 {
        return Vec::new();
    }
    let found = candidates(&chart(channels));
    let task = Task::new(channels);
    let fit = search(&task, &found);
    let widths = half_widths(&task, &fit, left_out);
    let mut modes: Vec<Mode> = widths
        .into_iter()
        .enumerate()
        .map(|(r, half_width)| mode(&task, &fit, r, half_width))
        .collect();
    let is_mode = |d: f64| (UNDAMPED..HEAVILY).contains(&d);
    modes.retain(|mode| mode.frequency_hz <= to_hz && is_mode(mode.damping_ratio));
    modes.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    modes
}

fn mode(task: &Task, fit: &Fit, r: usize, half_width: [f64; 2]) -> Mode {
    let pole = fit.structure.poles[r];
    let channels = 0..task.target.len();
    Mode {
        pole,
        frequency_hz: frequency(pole),
        damping_ratio: damping(pole),
        half_width,
        residues: channels.map(|c| fit.structure.residue(r, c)).collect(),
    }
}
