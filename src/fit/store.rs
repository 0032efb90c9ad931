//! Fits on disk: `fits/<campaign>/<file>.toml`, with provenance, loaded back by later verbs.

use super::parameter::Identified;
use super::stored_text::{stored, stored_text};
use crate::effects::{Composite, Scene};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::load_cycle::LoadCycle;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A stored fit of one joint.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StoredFit {
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
    /// Place in the robot.
    pub site: String,
    /// The model: effects and their parameters, SI, as fitted.
    pub model: Vec<StoredEffect>,
    /// Scales against which relative laws are defined.
    pub scale: StoredScale,
    /// What was identified, with intervals.
    pub parameters: Vec<Identified>,
}

/// One effect of a stored model.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StoredEffect {
    /// Its name.
    pub effect: String,
    /// Its parameters, SI, in the order of its card.
    pub p: Vec<f64>,
    /// Their names.
    pub names: Vec<String>,
}

/// Natural scales of the record that was fitted, SI.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct StoredScale {
    /// Largest load.
    pub load: f64,
    /// Elastic deflection at that load.
    pub deflection: f64,
    /// Duration of a cycle, s.
    pub period_s: f64,
    /// Duration of the record, s.
    pub duration_s: f64,
}

/// The schema written today.
pub const SCHEMA: &str = "ident-fit/1";

/// The effects of a model with their parameters.
pub fn stored_effects(model: &Composite, p: &[f64]) -> Vec<StoredEffect> {
    let mut rest = p;
    model
        .effects()
        .iter()
        .map(|effect| {
            let card = effect.card();
            let (own, after) = rest.split_at(card.parameters.len());
            rest = after;
            StoredEffect {
                effect: card.name.into(),
                p: own.to_vec(),
                names: card.parameters.iter().map(|q| q.name.to_string()).collect(),
            }
        })
        .collect()
}

/// Scales of an observation.
pub fn stored_scale(scene: &crate::effects::Scene) -> StoredScale {
    StoredScale {
        load: scene.load_scale,
        deflection: scene.deflection_scale,
        period_s: scene.period,
        duration_s: scene.duration,
    }
}

impl StoredFit {
    /// The fit of a file by a model with these parameters (SI); nothing is said of intervals.
    pub fn of(file: &LoadCycle, model: &Composite, p: &[f64], scene: &Scene) -> Self {
        let name = files::name(&file.path);
        Self {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            input: name,
            input_sha256: file.sha256.clone(),
            synthetic: file.facts.synthetic,
            site: file.site(),
            model: stored_effects(model, p),
            scale: stored_scale(scene),
            parameters: Vec::new(),
        }
    }

    /// The model and its parameters.
    pub fn model(&self) -> Outcome<(Composite, Vec<f64>)> {
        let names: Vec<&str> = self.model.iter().map(|e| e.effect.as_str()).collect();
        let model = Composite::named(&names)?;
        let mut p = Vec::new();
        for effect in model.effects() {
            let card = effect.card();
            let stored = self.model.iter().find(|e| e.effect == card.name);
            let own = stored.map(|e| e.p.clone()).unwrap_or_default();
            if own.len() != card.parameters.len() || own.iter().any(|v| !v.is_finite()) {
                return Err(Problem::new(
                    format!(
                        "effect `{}` needs {} finite parameters",
                        card.name,
                        card.parameters.len()
                    ),
                    "let `ident stiffness` or `ident diagnose` write this file again",
                )
                .at_line(1));
            }
            p.extend(own);
        }
        Ok((model, p))
    }

    /// Its text.
    pub fn text(&self) -> Outcome<String> {
        stored_text(self, self.synthetic)
    }

    /// Reads it back.
    pub fn read(path: &Path) -> Outcome<Self> {
        let bytes = files::read_bytes(path)?;
        let remedy = "give a file that `ident stiffness` or `ident diagnose` wrote under fits/";
        let fit: Self = stored(path, bytes, ("a fit", remedy))?;
        if fit.schema != SCHEMA {
            return Err(Problem::new(
                format!(
                    "has the schema `{}`, this version reads `{SCHEMA}`",
                    fit.schema
                ),
                "let this version fit the measurement again",
            )
            .at_line(1)
            .in_file(path));
        }
        Ok(fit)
    }
}
