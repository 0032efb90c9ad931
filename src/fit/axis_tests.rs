//! What the axis tests of a campaign found: the fits that `ident stiffness` left on disk.

use super::parameter::Identified;
use super::store::{SCHEMA, StoredFit};
use crate::ground::files;
use crate::ground::problem::Outcome;
use std::path::{Path, PathBuf};

/// One axis test with its stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisTest {
    /// Drive or bearing, as `A6` or `A6-tilt`.
    pub site: String,
    /// The fit on disk.
    pub path: PathBuf,
    /// SHA-256 of the fit.
    pub sha256: String,
    /// The measurement that was fitted, and its SHA-256.
    pub input: (String, String),
    /// Stiffness, N·m/rad, with its standard error.
    pub stiffness: (f64, f64),
    /// 95 % interval of the stiffness, N·m/rad.
    pub ci95: [f64; 2],
    /// Backlash, rad, if the test fixed it.
    pub backlash: Option<(f64, [f64; 2])>,
}

impl AxisTest {
    /// `axis6.csv 9335545e6d21`: the measurement and the start of its hash.
    pub fn provenance(&self) -> String {
        let short: String = self.input.1.chars().take(12).collect();
        format!("{} {short}", self.input.0)
    }
}

/// The axis tests in a folder of fits, one per site, in the order of the file names. Of several fits
/// of one site the one named like its measurement counts, then the one with the smallest interval.
///
/// # Errors
/// A fit that cannot be read.
pub fn read(folder: &Path) -> Outcome<Vec<AxisTest>> {
    let mut found: Vec<AxisTest> = Vec::new();
    for path in fits(folder) {
        let Some(test) = one(&path)? else { continue };
        match found.iter_mut().find(|other| other.site == test.site) {
            Some(other) if better(&test, other) => *other = test,
            Some(_) => {}
            None => found.push(test),
        }
    }
    Ok(found)
}

fn fits(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    paths.sort();
    paths
}

fn better(a: &AxisTest, b: &AxisTest) -> bool {
    let own_name = |test: &AxisTest| test.path.file_stem() == Path::new(&test.input.0).file_stem();
    let width = |test: &AxisTest| test.stiffness.1 / test.stiffness.0;
    match (own_name(a), own_name(b)) {
        (true, false) => true,
        (false, true) => false,
        _ => width(a) < width(b),
    }
}

/// The axis test in a file; `None` for a file of another kind, or without a stiffness.
fn one(path: &Path) -> Outcome<Option<AxisTest>> {
    let bytes = files::read_bytes(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let table = text.parse::<toml::Table>().unwrap_or_default();
    if table.get("schema").and_then(toml::Value::as_str) != Some(SCHEMA) {
        return Ok(None);
    }
    let fit = StoredFit::read(path)?;
    let Some((value, stderr, ci95)) = fixed(&fit.parameters, "stiffness") else {
        return Ok(None);
    };
    let backlash = fixed(&fit.parameters, "backlash").or_else(|| fixed(&fit.parameters, "gap"));
    Ok((value > 0.0 && stderr > 0.0).then(|| AxisTest {
        site: fit.site.clone(),
        path: path.to_path_buf(),
        sha256: files::sha256(&bytes),
        input: (fit.input.clone(), fit.input_sha256.clone()),
        stiffness: (value, stderr),
        ci95,
        backlash: backlash.map(|(value, _, ci95)| (value, ci95)),
    }))
}

fn fixed(parameters: &[Identified], name: &str) -> Option<(f64, f64, [f64; 2])> {
    let found = parameters.iter().find(|p| p.name == name)?;
    Some((found.value?, found.stderr?, found.ci95?))
}
