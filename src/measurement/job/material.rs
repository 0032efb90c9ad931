//! `[material]`: the cutting force coefficients, in the job or in a file of their own.

use super::{beside, text_of};
use crate::ground::files::{read_bytes, sha256};
use crate::ground::problem::Outcome;
use crate::measurement::keys::{Document, Keys};
use std::path::{Path, PathBuf};

/// Coefficients of the cutting force, tangential, radial, axial.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its name.
    pub name: String,
    /// The force law that they belong to, by the name of its card: `linear_edge` where the file states none.
    pub law: &'static str,
    /// The coefficients of the law in the order of its card, SI.
    pub coefficients: [f64; 6],
    /// Relative standard deviation of each coefficient; `None`: not stated.
    pub rel_std: Option<f64>,
    /// Their 95 % intervals where the file states them, SI.
    pub ci95: [Option<[f64; 2]>; 6],
}

/// A coefficient, its interval, the factor to SI, and the least and the most that it may be.
type Key = (&'static str, &'static str, f64, [f64; 2]);

/// A force law as files name it, with its coefficients and where to look where one is impossible.
struct Form {
    law: &'static str,
    keys: [Key; 6],
    hard: &'static str,
}

/// Most that a coefficient may be, N/mm² and N/mm: the hardest that are cut have some ten thousand.
const HARDEST: f64 = 1e6;
/// Most that a force may fall with the chip: it would not fall with it altogether.
const STEEPEST: f64 = 0.99;
/// A force across the cut has either sign, and one of the edge that was fitted may come out so; that of the chip against the cut has one.
const EITHER: [f64; 2] = [-HARDEST, HARDEST];
const AGAINST: [f64; 2] = [0.0, HARDEST];
const FALLS: [f64; 2] = [-STEEPEST, STEEPEST];

const FORMS: [Form; 2] = [
    Form {
        law: "linear_edge",
        keys: [
            ("Ktc_N_mm2", "Ktc_ci95_N_mm2", 1e6, AGAINST),
            ("Krc_N_mm2", "Krc_ci95_N_mm2", 1e6, EITHER),
            ("Kac_N_mm2", "Kac_ci95_N_mm2", 1e6, EITHER),
            ("Kte_N_mm", "Kte_ci95_N_mm", 1e3, EITHER),
            ("Kre_N_mm", "Kre_ci95_N_mm", 1e3, EITHER),
            ("Kae_N_mm", "Kae_ci95_N_mm", 1e3, EITHER),
        ],
        hard: "write it in N/mm² (edge: N/mm): steel has some 2000 and 30; that against the cut is none below zero",
    },
    Form {
        law: "kienzle",
        keys: [
            ("kt11_N_mm2", "kt11_ci95_N_mm2", 1e6, AGAINST),
            ("kr11_N_mm2", "kr11_ci95_N_mm2", 1e6, EITHER),
            ("ka11_N_mm2", "ka11_ci95_N_mm2", 1e6, EITHER),
            ("mt", "mt_ci95", 1.0, FALLS),
            ("mr", "mr_ci95", 1.0, FALLS),
            ("ma", "ma_ci95", 1.0, FALLS),
        ],
        hard: "write k 1.1 in N/mm² (chips of 1 mm) and the fall m as a number below 1: steel has some 1700 and 0.25; kt11 is none below zero",
    },
];

/// What else a material may say; free, and for people, but for `name`, `law` and `rel_std`.
const WORDS: &[&str] = &[
    "kind",
    "name",
    "law",
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
        let form = form(keys)?;
        for (key, interval, ..) in others(form) {
            if let Some(key) = [key, interval].into_iter().find(|key| keys.has(key)) {
                let what = format!("is no coefficient of the law \"{}\"", form.law);
                let help = "remove it, or state the `law` that it belongs to";
                return Err(keys.problem(key, what, help));
            }
        }
        let mut coefficients = [0.0; 6];
        let mut ci95 = [None; 6];
        for (i, (key, interval, factor, [least, most])) in form.keys.iter().enumerate() {
            let may_be = |k: f64| (*least..=*most).contains(&k);
            let value = keys.judged(key, may_be, "no material's", form.hard)?;
            let remedy = || format!("add `{key} = ...`; 0.0 where it does not act");
            let value = value.ok_or_else(|| keys.problem(key, "is missing", remedy()))?;
            coefficients[i] = factor * value;
            ci95[i] = about(keys, interval, value)?.map(|ends| ends.map(|x| x * factor));
        }
        Ok(Self {
            name: keys.text("name")?.unwrap_or("material").to_string(),
            law: form.law,
            coefficients,
            rel_std: rel_std(keys)?,
            ci95,
        })
    }
}

/// A 95 % interval, which holds its value.
fn about(keys: &Keys<'_>, interval: &str, value: f64) -> Outcome<Option<[f64; 2]>> {
    let Some([low, high]) = keys.array::<2>(interval)? else {
        return Ok(None);
    };
    let rounding = 1e-9 * value.abs();
    match low - rounding <= value && value <= high + rounding {
        true => Ok(Some([low, high])),
        false => Err(keys.problem(
            interval,
            format!("runs from {low} to {high} and does not hold {value}"),
            "write the lower end first, then the upper one, about the value",
        )),
    }
}

/// The law that is stated; that with an edge where none is.
fn form(keys: &Keys<'_>) -> Outcome<&'static Form> {
    let stated = keys.text("law")?.unwrap_or(FORMS[0].law);
    let own = FORMS.iter().find(|form| form.law == stated);
    own.ok_or_else(|| {
        let known = FORMS.each_ref().map(|form| form.law).join("\" or \"");
        keys.problem("law", "is no known force law", format!("write \"{known}\""))
    })
}

/// Keys of the other laws.
fn others(form: &Form) -> impl Iterator<Item = Key> {
    let others = FORMS.iter().filter(|other| other.law != form.law);
    others.flat_map(|other| other.keys)
}

fn known() -> Vec<&'static str> {
    let keys = FORMS.iter().flat_map(|form| &form.keys);
    let coefficients = keys.flat_map(|(key, ci95, ..)| [*key, *ci95]);
    coefficients.chain(WORDS.iter().copied()).collect()
}

fn rel_std(keys: &Keys<'_>) -> Outcome<Option<f64>> {
    let right = |x: f64| (0.0..1.0).contains(&x);
    let remedy = "write it as a fraction: 0.1 for 10 %";
    keys.judged("rel_std", right, "not between 0 and 1", remedy)
}
