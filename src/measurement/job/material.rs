//! `[material]`: the cutting force coefficients, in the job or in a file of their own.

use super::{beside, text_of};
use crate::ground::files::{read_bytes, sha256};
use crate::ground::problem::Outcome;
use crate::measurement::keys::{Document, Keys};
use std::path::{Path, PathBuf};

/// Coefficients of the cutting force, `dF = (K_c h + K_e) da`, tangential, radial, axial.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its name.
    pub name: String,
    /// `Ktc, Krc, Kac`, N/m².
    pub cutting: [f64; 3],
    /// `Kte, Kre, Kae`, N/m.
    pub edge: [f64; 3],
    /// Relative standard deviation of each coefficient; `None`: not stated.
    pub rel_std: Option<f64>,
    /// 95 % intervals of `Ktc, Krc, Kac` (N/m²) and `Kte, Kre, Kae` (N/m) where the file states them.
    pub ci95: [Option<[f64; 2]>; 6],
}

/// The six coefficients with their intervals, and the factor to SI.
const COEFFICIENTS: [(&str, &str, f64); 6] = [
    ("Ktc_N_mm2", "Ktc_ci95_N_mm2", 1e6),
    ("Krc_N_mm2", "Krc_ci95_N_mm2", 1e6),
    ("Kac_N_mm2", "Kac_ci95_N_mm2", 1e6),
    ("Kte_N_mm", "Kte_ci95_N_mm", 1e3),
    ("Kre_N_mm", "Kre_ci95_N_mm", 1e3),
    ("Kae_N_mm", "Kae_ci95_N_mm", 1e3),
];

/// Most that any coefficient may be, N/mm² and N/mm: the hardest that are cut have some ten thousand.
const HARDEST: f64 = 1e6;
const HARD: &str = "write it in N/mm² (edge: N/mm): steel has some 2000 and 30";

/// What else a material may say; free, and for people, but for `name` and `rel_std`.
const WORDS: &[&str] = &[
    "kind",
    "name",
    "rel_std",
    "source",
    "synthetic",
    "notes",
    "inputs",
    "version",
    "schema",
    "runout_um",
    "runout_angle_deg",
    "parameters",
    "covariance",
    "fit",
];

impl Material {
    /// `[material]` of a job, or the file that `material = "..."` names, looked up beside the job
    /// `path` and added to `inputs`.
    ///
    /// # Errors
    /// An unknown, missing or impossible key, with its file and line.
    pub fn of(
        job: &Keys<'_>,
        path: &Path,
        inputs: &mut Vec<(PathBuf, String)>,
    ) -> Outcome<Option<Self>> {
        if !job.has("material") {
            return Ok(None);
        }
        let Ok(Some(name)) = job.name("material") else {
            let keys = job.table("material", &known())?;
            return keys.map(|keys| Self::of_keys(&keys)).transpose();
        };
        let file = beside(path, name);
        let bytes = read_bytes(&file)?;
        inputs.push((file.clone(), sha256(&bytes)));
        let material = Self::of_bytes(&bytes).map_err(|problem| problem.in_file(&file));
        material.map(Some)
    }

    /// A material file: the keys of `[material]`, outside of all tables.
    ///
    /// # Errors
    /// An unknown, missing or impossible key, with its line.
    pub fn of_bytes(bytes: &[u8]) -> Outcome<Self> {
        let document = Document::parse(text_of(bytes)?)?;
        Self::of_keys(&document.keys(&known())?)
    }

    fn of_keys(keys: &Keys<'_>) -> Outcome<Self> {
        let mut values = [0.0; 6];
        let mut ci95 = [None; 6];
        for (i, (key, interval, factor)) in COEFFICIENTS.iter().enumerate() {
            let value = keys.judged(key, |k| k.abs() <= HARDEST, "no material's", HARD)?;
            let example = format!("{key} = ...; 0.0 where it does not act");
            values[i] = factor * value.ok_or_else(|| keys.missing(key, &example))?;
            ci95[i] = keys
                .array::<2>(interval)?
                .map(|ends| ends.map(|x| x * factor));
        }
        let [ktc, krc, kac, kte, kre, kae] = values;
        Ok(Self {
            name: keys.text("name")?.unwrap_or("material").to_string(),
            cutting: [ktc, krc, kac],
            edge: [kte, kre, kae],
            rel_std: rel_std(keys)?,
            ci95,
        })
    }
}

fn known() -> Vec<&'static str> {
    let coefficients = COEFFICIENTS.iter().flat_map(|(key, ci95, _)| [*key, *ci95]);
    coefficients.chain(WORDS.iter().copied()).collect()
}

fn rel_std(keys: &Keys<'_>) -> Outcome<Option<f64>> {
    let right = |x: f64| (0.0..1.0).contains(&x);
    let remedy = "write it as a fraction: 0.1 for 10 %";
    keys.judged("rel_std", right, "not between 0 and 1", remedy)
}
