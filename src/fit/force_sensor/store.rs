//! The model of a sensor on disk: `fits/<campaign>/<stem>.toml`, kind `force-sensor-model`.

use super::Account;
use super::model::Model;
use super::remainder::{CONVENTION, TERMS};
use super::statics::{N, PARAMETERS};
use crate::fit::parameter::Identified;
use crate::fit::stored_text::{stored, stored_text};
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
        let remedy = "give a model that `ident sensor` wrote, or a file of kind force-sensor";
        let model: Self = stored(path, bytes, ("a model of a force sensor", remedy))?;
        match model.kind == KIND {
            true => Ok(model),
            false => {
                Err(Problem::new(format!("is of kind `{}`", model.kind), remedy).in_text(path))
            }
        }
    }

    /// Force per axis that the model leaves in any orientation, standard deviation, N: from how well weight
    /// and offsets are known.
    pub fn rest_n(&self) -> f64 {
        let named = |p: &&Identified| p.name == "weight" || p.name.starts_with("offset_f");
        let own = self.parameters.iter().filter(named);
        let squares: f64 = own.filter_map(|p| p.stderr).map(|s| s * s).sum();
        // the weight and the three offsets, over three axes
        (squares / 3.0).sqrt()
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
