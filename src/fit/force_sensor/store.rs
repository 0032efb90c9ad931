//! The model of a sensor on disk: `fits/<campaign>/<stem>.toml`, kind `force-sensor-model`.

use super::Account;
use super::model::Model;
use super::remainder::{CONVENTION, TERMS};
use super::statics::{N, PARAMETERS};
use crate::fit::parameter::Identified;
use crate::fit::stored_text::stored_text;
use crate::ground::files::read_bytes;
use crate::ground::problem::{Outcome, Problem};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Its kind.
pub const KIND: &str = "force-sensor-model";

/// The file.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StoredSensor {
    /// Always [`KIND`].
    pub kind: String,
    /// Version of `ident` that wrote it.
    pub version: String,
    /// Files it rests on, name and hash.
    pub inputs: Vec<String>,
    /// Fitted to simulated measurements.
    pub synthetic: bool,
    /// Values in the order of the parameters, SI, assumed ones included: what [`Model`] computes with.
    pub values: Vec<f64>,
    /// How the polynomial is meant.
    pub polynomial_convention: String,
    /// Coefficients per term (ww, wx, wy, wz, xx, xy, xz, yy, yz, zz), six channels: N, then N·m.
    pub polynomial: Vec<Vec<f64>>,
    /// The parameters with their intervals.
    pub parameters: Vec<Identified>,
}

impl StoredSensor {
    /// What is stored of an account.
    pub fn of(account: &Account, inputs: Vec<String>, synthetic: bool) -> Self {
        Self {
            kind: KIND.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            inputs,
            synthetic,
            values: account.model.p.to_vec(),
            polynomial_convention: CONVENTION.into(),
            polynomial: account
                .model
                .polynomial
                .iter()
                .map(|row| row.to_vec())
                .collect(),
            parameters: account.parameters.clone(),
        }
    }

    /// As TOML.
    ///
    /// # Errors
    /// It cannot be written as TOML.
    pub fn text(&self) -> Outcome<String> {
        stored_text(self, self.synthetic)
    }

    /// Reads it back.
    ///
    /// # Errors
    /// No such file, or not such a model.
    pub fn read(path: &Path) -> Outcome<Self> {
        let bytes = read_bytes(path)?;
        let refuse = |what: String| {
            Problem::new(
                what,
                "give a model that `ident sensor` wrote, or a file of kind force-sensor",
            )
            .in_file(path)
        };
        let text = String::from_utf8(bytes).map_err(|_| refuse("is not UTF-8 text".into()))?;
        let stored: Self = toml::from_str(&text)
            .map_err(|e| refuse(format!("is no model of a force sensor ({})", e.message())))?;
        match stored.kind == KIND {
            true => Ok(stored),
            false => Err(refuse(format!("is of kind `{}`", stored.kind))),
        }
    }

    /// The model that it holds.
    ///
    /// # Errors
    /// Lists of the wrong length.
    pub fn model(&self) -> Outcome<Model> {
        let wrong = || {
            Problem::new(
                format!(
                    "holds {} values and {} terms instead of {N} and {}",
                    self.values.len(),
                    self.polynomial.len(),
                    TERMS.len()
                ),
                "let `ident sensor` write it again",
            )
        };
        let p = <[f64; N]>::try_from(self.values.clone()).map_err(|_| wrong())?;
        let rows = self
            .polynomial
            .iter()
            .map(|row| <[f64; 6]>::try_from(row.clone()).ok());
        let rows: Option<Vec<[f64; 6]>> = rows.collect();
        let polynomial = rows
            .and_then(|rows| rows.try_into().ok())
            .ok_or_else(wrong)?;
        debug_assert_eq!(PARAMETERS.len(), N);
        Ok(Model { p, polynomial })
    }
}
