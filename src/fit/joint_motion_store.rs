//! `fits/<campaign>/*-extended.toml` of a joint motion: what was found, with provenance, loaded back.

use super::parameter::Identified;
use super::stored_text::{stored, stored_text};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The schema written today.
pub const SCHEMA: &str = "ident-joint-motion/1";

/// What a motion said of its joints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredMotion {
    /// Format of this file.
    pub schema: String,
    /// What wrote it.
    pub version: String,
    /// The measurement.
    pub input: String,
    /// Its SHA-256.
    pub input_sha256: String,
    /// True when the measurement was simulated.
    pub synthetic: bool,
    /// The robot that the measurement names.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub robot: Option<String>,
    /// The verdict.
    pub verdict: String,
    /// Causes that were named.
    pub causes: Vec<StoredCause>,
    /// Delays and stiffnesses, SI.
    pub parameters: Vec<Identified>,
}

/// A cause that was named.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredCause {
    /// Its name.
    pub effect: String,
    /// Where.
    pub site: String,
    /// Its parameters.
    pub parameters: Vec<StoredValue>,
}

/// A parameter of a cause.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredValue {
    /// Its name.
    pub name: String,
    /// Value, SI.
    pub value: f64,
    /// Its unit.
    pub unit: String,
}

impl StoredMotion {
    /// Its text.
    ///
    /// # Errors
    /// It cannot be written as TOML.
    pub fn text(&self) -> Outcome<String> {
        stored_text(self, self.synthetic)
    }

    /// Reads it back.
    ///
    /// # Errors
    /// It is no such fit.
    pub fn read(path: &Path) -> Outcome<Self> {
        let bytes = files::read_bytes(path)?;
        let remedy = "give a fit of a joint motion that `ident diagnose` wrote";
        let fit: Self = stored(path, bytes, ("a fit of a joint motion", remedy))?;
        match fit.schema == SCHEMA {
            true => Ok(fit),
            false => {
                let what = format!("has the schema `{}`, not `{SCHEMA}`", fit.schema);
                Err(Problem::new(what, remedy).in_text(path))
            }
        }
    }
}
