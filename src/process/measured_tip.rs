//! Modes of the tool as a hammer test at its tip found them: what the robot's model does not hold
//! (tool, holder, spindle bearings), in the form in which chatter needs them.

use crate::cutting::stability::TipMode;
use crate::experiments::hammer_frf::{HammerFrf, Settings, estimate};
use crate::experiments::hammer_modes::modes;
use crate::ground::problem::{Outcome, Problem};
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

/// Share of the sampling rate up to which modes are looked for.
const BAND: f64 = 0.4;

impl MeasuredTip {
    /// Reads hits on the tip, or FRFs there (universal file), forces and accelerations along x, y, z.
    ///
    /// # Errors
    /// A file without FRFs, several points, no driven direction, no mode.
    pub fn read(path: &Path) -> Outcome<Self> {
        let record = hammer_uff::read_any(path)?;
        let settings = Settings {
            band_hz: BAND / record.interval_s,
            modes: true,
            ..Settings::default()
        };
        let of = || -> Outcome<Self> {
            let frf = estimate(&record, &settings)?;
            let places = Places::of(&frf)?;
            let last = frf.frequency_hz.last().copied().unwrap_or(0.0);
            let found = modes(&frf, last.min(settings.band_hz));
            let tips: Vec<TipMode> = found.iter().filter_map(|m| places.tip(m)).collect();
            if tips.is_empty() {
                let remedy = "give hits at the tip with accelerations along the hit, or leave --tool-frf out";
                return Err(Problem::new("shows no mode of the tool", remedy));
            }
            let mut remarks = frf.remarks.clone();
            remarks.extend(beside(&tips, found.len() - tips.len()));
            Ok(Self {
                modes: tips,
                sha256: record.sha256.clone(),
                remarks,
            })
        };
        of().map_err(|problem| problem.in_file(path))
    }
}

fn beside(tips: &[TipMode], left_out: usize) -> Vec<String> {
    let mut said = vec![format!(
        "{} modes of the measured tool are added; its x, y and z are taken as those of the cut (x along the feed), and what swings beyond the measured band as stiff.",
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
