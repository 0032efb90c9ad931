//! What measuring cubes found, on disk: `fits/<campaign>/<stem>.toml`, taken up by later verbs as axis tests are.

use crate::fit::parameter::Identified;
use crate::fit::stored_text::stored_text;
use crate::ground::problem::Outcome;
use serde::{Deserialize, Serialize};

/// The schema written today.
pub const SCHEMA: &str = "ident-cubes/1";

/// A stored fit of measuring cubes.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StoredCubes {
    /// Always [`SCHEMA`].
    pub schema: String,
    /// What wrote it.
    pub version: String,
    /// True when a measurement was simulated.
    pub synthetic: bool,
    /// The robot that was started from.
    pub robot: String,
    /// The measurements.
    pub inputs: Vec<Input>,
    /// Stiffness of every site, with intervals.
    pub parameters: Vec<Identified>,
}

/// One measurement.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// File name.
    pub file: String,
    /// SHA-256.
    pub sha256: String,
}

impl StoredCubes {
    /// As TOML.
    ///
    /// # Errors
    /// It cannot be written as TOML.
    pub fn text(&self) -> Outcome<String> {
        stored_text(self, self.synthetic)
    }

    /// From the text of a fit; none where it is of another schema.
    pub fn of(text: &str) -> Option<Self> {
        let stored: Self = toml::from_str(text).ok()?;
        (stored.schema == SCHEMA).then_some(stored)
    }
}
