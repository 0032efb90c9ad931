//! Modes of the tool as a hammer test at its tip found them: what the robot's model does not hold
//! (tool, holder, spindle bearings), in the form in which chatter needs them.

use crate::cutting::stability::TipMode;
use crate::experiments::hammer_frf::{HammerFrf, Settings, estimate};
use crate::experiments::hammer_modes::modes;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::hammer::HammerRecord;
use crate::measurement::hammer_uff;
use crate::signal::modes::Mode;
use std::path::Path;

/// What was found at the tip.
#[derive(Debug, Clone)]
pub struct MeasuredTip {
    /// The modes, directions as in the file.
    pub modes: Vec<TipMode>,
    /// SHA-256 of the file.
    pub sha256: String,
    /// What the reader should know.
    pub remarks: Vec<String>,
}

/// Share of the sampling rate up to which modes are looked for, if the hits excite as much; else half of that,
/// and so on, so many times.
const BAND: f64 = 0.4;
const HALVINGS: i32 = 8;

impl MeasuredTip {
    /// Reads hits on the tip, or FRFs there (universal file), forces and accelerations along x, y, z.
    ///
    /// # Errors
    /// A file without FRFs, several points, no driven direction, no mode.
    pub fn read(path: &Path) -> Outcome<Self> {
        let record = hammer_uff::read_any(path)?;
        let of = || -> Outcome<Self> {
            let (frf, band_hz) = excited(&record)?;
            let places = Places::of(&frf)?;
            let last = frf.frequency_hz.last().copied().unwrap_or(0.0);
            let found = modes(&frf, last.min(band_hz));
            let tips: Vec<TipMode> = found.iter().filter_map(|m| places.tip(m)).collect();
            if tips.is_empty() {
                let remedy = "give hits at the tip with accelerations along the hit, or leave --tool-frf out";
                return Err(Problem::new("shows no mode of the tool", remedy));
            }
            let mut remarks = frf.remarks.clone();
            remarks.extend(beside(&tips, found.len() - tips.len(), last.min(band_hz)));
            Ok(Self {
                modes: tips,
                sha256: record.sha256.clone(),
                remarks,
            })
        };
        of().map_err(|problem| problem.in_file(path))
    }
}

/// The FRFs in the widest band that the hits excite, and its end, Hz.
fn excited(record: &HammerRecord) -> Outcome<(HammerFrf, f64)> {
    let of = |halvings: i32| {
        let band_hz = BAND / record.interval_s * 0.5_f64.powi(halvings);
        let settings = Settings {
            band_hz,
            modes: true,
            ..Settings::default()
        };
        estimate(record, &settings).map(|frf| (frf, band_hz))
    };
    let mut found = of(0);
    for halvings in 1..=HALVINGS {
        if found.is_ok() {
            break;
        }
        found = of(halvings);
    }
    found
}

fn beside(tips: &[TipMode], left_out: usize, band_hz: f64) -> Vec<String> {
    let mut said = vec![format!(
        "{} modes of the measured tool up to {band_hz:.0} Hz are added; its x, y and z are taken as those of the cut (x along the feed), and what swings faster as stiff.",
        tips.len()
    )];
    if left_out > 0 {
        said.push(format!(
            "{left_out} measured modes are left out: where they are hit they do not answer as a mass on a spring can."
        ));
    }
    said
}

/// Axes of the inputs, and of the outputs.
struct Places {
    inputs: Vec<usize>,
    outputs: Vec<usize>,
}

impl Places {
    fn of(frf: &HammerFrf) -> Outcome<Self> {
        let axis = |name: &String| ["x", "y", "z"].iter().position(|a| a == name);
        let all = |names: Vec<&String>| names.into_iter().map(axis).collect::<Option<Vec<_>>>();
        let inputs = all(frf.inputs.iter().map(|i| &i.input).collect());
        let outputs = all(frf.outputs.iter().collect());
        inputs
            .zip(outputs)
            .map(|(inputs, outputs)| Self { inputs, outputs })
            .ok_or_else(|| {
                let what =
                    "holds FRFs of more than one point, or along other directions than x, y, z";
                Problem::new(what, "give a file with the FRFs of the tip alone")
            })
    }

    /// A mode scaled to unit stiffness. Its displacement over force is A/(s² + 2ζωs + ω²), so that the residue
    /// of the acceleration is R = p² A/(p − p*); A = φφᵀ, read from the input that drives it most.
    fn tip(&self, mode: &Mode) -> Option<TipMode> {
        let p = mode.pole;
        let outputs = self.outputs.len();
        let mass = |input: usize, output: usize| {
            (mode.residues[input * outputs + output] * (p - p.conj()) / (p * p)).re
        };
        let own = |input: usize| {
            let output = self.outputs.iter().position(|o| *o == self.inputs[input])?;
            Some((input, mass(input, output))).filter(|found| found.1 > 0.0)
        };
        let driven = (0..self.inputs.len()).filter_map(own);
        let (input, square) = driven.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let omega = p.norm();
        let mut direction = [0.0; 3];
        for (output, axis) in self.outputs.iter().enumerate() {
            direction[*axis] = mass(input, output) / square.sqrt() / omega;
        }
        Some(TipMode {
            direction,
            omega,
            damping_ratio: mode.damping_ratio,
            stiffness: 1.0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustfft::num_complex::Complex64;

    #[test]
    fn residues_give_the_mode_that_made_them() {
        let (omega, ratio, stiffness) = (5793.0, 0.011, 1.34e6_f64);
        let p = Complex64::new(-ratio * omega, omega * (1.0_f64 - ratio * ratio).sqrt());
        let unit = [0.6, -0.8];
        let mass = stiffness / omega.powi(2);
        let residue = |i: usize, o: usize| p * p * (unit[i] * unit[o] / mass) / (p - p.conj());
        let mode = Mode {
            pole: p,
            frequency_hz: omega / std::f64::consts::TAU,
            damping_ratio: ratio,
            half_width: [0.0; 2],
            residues: vec![residue(0, 0), residue(0, 1), residue(1, 0), residue(1, 1)],
        };
        let places = Places {
            inputs: vec![0, 1],
            outputs: vec![0, 1],
        };
        let tip = places.tip(&mode).unwrap();
        // the sign of a mode is free
        for (k, direction) in unit.iter().enumerate() {
            let expected = -direction / stiffness.sqrt();
            assert!((tip.direction[k] / expected - 1.0).abs() < 1e-9, "{tip:?}");
        }
        assert!((tip.omega / omega - 1.0).abs() < 1e-9);
    }
}
