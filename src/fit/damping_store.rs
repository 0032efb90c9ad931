//! `fits/<campaign>/damping.toml`: what hammer tests say about the dampings, with provenance.

use super::parameter::Identified;
use super::stored_text::stored_text;
use crate::ground::problem::Outcome;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The schema written today.
pub const SCHEMA: &str = "ident-damping/1";

/// The stored result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredDamping {
    /// Format of this file.
    pub schema: String,
    /// What wrote it.
    pub version: String,
    /// True when a measurement was simulated.
    pub synthetic: bool,
    /// Band that was tuned, Hz.
    #[serde(rename = "band_Hz")]
    pub band_hz: [f64; 2],
    /// Weighted sum of squares over the degrees of freedom.
    pub reduced_chi_square: f64,
    /// Measurements and robot.
    pub inputs: Vec<StoredInput>,
    /// FRAC per direction pair after tuning.
    pub frac: BTreeMap<String, f64>,
    /// What was identified, SI.
    pub parameters: Vec<Identified>,
    /// Products of powers that the data fix.
    pub fixed: Vec<StoredProduct>,
}

/// A file that went in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredInput {
    /// Name of the file or robot.
    pub file: String,
    /// Its SHA-256.
    pub sha256: String,
}

/// A product of powers of constants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredProduct {
    /// As in `A4^0.70 · A6^-0.70`.
    pub product: String,
    /// Its value over that of the robot before.
    pub times_before: f64,
    /// Its relative standard error.
    pub relative_stderr: f64,
}

impl StoredDamping {
    /// Its text.
    pub fn text(&self) -> Outcome<String> {
        stored_text(self, self.synthetic)
    }
}
