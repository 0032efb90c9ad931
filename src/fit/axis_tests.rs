//! What the axis tests of a campaign found: the fits that `ident stiffness` left on disk.

use super::parameter::{Identified, Z95};
use super::store::{SCHEMA, StoredFit};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::leading::front_of;
use crate::measurement::load_cycle::{LEVER_REL_STD, lever_spread};
use crate::robot::joint_effect::JointEffect;
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
    /// Stiffness, N·m/rad, with its standard error: of the fit and of the levers.
    pub stiffness: (f64, f64),
    /// 95 % interval of the stiffness, N·m/rad, for the same reasons.
    pub ci95: [f64; 2],
    /// Backlash, rad, if the test fixed it.
    pub backlash: Option<(f64, [f64; 2])>,
    /// What the test found that a joint carries through time: hysteresis, friction.
    pub effects: Vec<JointEffect>,
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
/// `measurements` holds the files that were fitted: they state how well their levers are known.
///
/// # Errors
/// A fit that cannot be read.
pub fn read(folder: &Path, measurements: &Path) -> Outcome<Vec<AxisTest>> {
    let mut found: Vec<AxisTest> = Vec::new();
    for path in fits(folder) {
        let Some(test) = one(&path, measurements)? else {
            continue;
        };
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
fn one(path: &Path, measurements: &Path) -> Outcome<Option<AxisTest>> {
    let bytes = files::read_bytes(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let table = text.parse::<toml::Table>().unwrap_or_default();
    if table.get("schema").and_then(toml::Value::as_str) != Some(SCHEMA) {
        return Ok(None);
    }
    let fit = StoredFit::read(path)?;
    let Some(fitted) = fixed(&fit.parameters, "stiffness") else {
        return Ok(None);
    };
    let known = fit.parameters.iter().any(|p| p.name == "stiffness" && p.parts.is_some());
    let (value, stderr, ci95) = match known {
        true => fitted,
        false => widened(fitted, levers(&measurements.join(&fit.input))),
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
        effects: carried(&fit),
    }))
}

/// The effects of a fit that a joint can carry. Their loop is what the test fixed, even where it leaves
/// open which of their parameters shapes it.
fn carried(fit: &StoredFit) -> Vec<JointEffect> {
    let own = fit.model.iter();
    let own = own.filter_map(|e| JointEffect::new(&e.effect, e.p.clone()).ok());
    own.collect()
}

/// Relative standard deviation by the levers of a measurement; the usual one if it is not there.
fn levers(measurement: &Path) -> f64 {
    let front = front_of(measurement).ok();
    let stated = front.and_then(|front| lever_spread(&front).ok());
    stated.unwrap_or(LEVER_REL_STD * std::f64::consts::SQRT_2)
}

/// A value with standard error and interval, with an independent relative error added.
fn widened((value, stderr, [low, high]): Fixed, relative: f64) -> Fixed {
    let more = value * relative;
    let half = |own: f64| own.hypot(Z95 * more);
    let ci95 = [value - half(value - low), value + half(high - value)];
    (value, stderr.hypot(more), ci95)
}

/// Value, standard error and 95 % interval.
type Fixed = (f64, f64, [f64; 2]);

fn fixed(parameters: &[Identified], name: &str) -> Option<Fixed> {
    let found = parameters.iter().find(|p| p.name == name)?;
    Some((found.value?, found.stderr?, found.ci95?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levers_widen_what_the_fit_says() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("axis6.csv");
        let spread = |facts: &str| {
            let head = "# kind = \"load-cycle\"\n# lever_rel_std = 0.03\n";
            std::fs::write(&path, format!("{head}{facts}time_s,force_N\n")).unwrap();
            levers(&path)
        };
        let both = spread("# load_lever_m = 0.6\n# sensor_lever_m = 0.5\n");
        assert!((both - 0.03 * 2.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(spread("# sensor_lever_m = 0.5\n"), 0.03);
        assert_eq!(spread(""), 0.0);
        assert!(levers(&folder.path().join("gone.csv")) > LEVER_REL_STD);
        let (value, stderr, ci95) = widened((2e5, 3e3, [1.9e5, 2.1e5]), 0.02);
        assert_eq!((value, stderr), (2e5, 5e3));
        assert!(ci95[0] < 1.9e5 && (ci95[0] + ci95[1] - 4e5).abs() < 1e-6);
    }
}
