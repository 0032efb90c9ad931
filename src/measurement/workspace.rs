//! A workspace on disk: `measurements/<campaign>/`, `fits/<campaign>/`, `reports/<campaign>/`.

mod chosen;

use super::foreign::binary::FORMATS;
use super::foreign::sidecar;
use super::hammer_uff::is_universal;
use super::leading::kind_of;
use crate::ground::nearest::nearest;
use crate::ground::problem::{Outcome, Problem};
pub use chosen::{only_of_kind, resolve};
use std::path::{Path, PathBuf};

/// Where a measurement belongs, and where its results go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Folder that holds `measurements/`, `fits/`, `reports/`.
    pub root: PathBuf,
    /// Name of the campaign; empty for a file outside `measurements/`.
    pub campaign: String,
}

/// Names of results that no measurement may take.
const RESERVED: &[&str] = &["robot", "extended-robot"];
/// Endings of files that hold measurements.
const MEASURED: &[&str] = &[
    "csv", "txt", "dat", "uff", "unv", "xlsx", "npy", "mat", "tdms",
];
/// Folder for what is made from a job: `reports/<campaign>/<folder of the job>/` for a job under
/// `measurements/<campaign>/`, else `reports/` in the folder that `ident` runs in; a job that is not
/// called `job.toml` has a folder of its own name in it.
pub fn job_results(job: &Path) -> PathBuf {
    let folder = job.parent().unwrap_or(Path::new(""));
    let found = folder.ancestors().find_map(|measurements| {
        let named = measurements
            .file_name()
            .is_some_and(|n| n == "measurements");
        let root = measurements.parent().filter(|_| named)?;
        let inside = folder.strip_prefix(measurements).ok()?;
        Some(root.join("reports").join(inside))
    });
    let stem = job.file_stem().unwrap_or_default();
    match found {
        Some(folder) if stem == "job" => folder,
        Some(folder) => folder.join(stem),
        None => Path::new("reports").join(stem),
    }
}

impl Place {
    /// The place of a measurement file: its campaign if it lies under `measurements/`, else the
    /// folder `ident` runs in.
    pub fn of(file: &Path) -> Self {
        Self::in_campaign(file).unwrap_or(Self {
            root: PathBuf::new(),
            campaign: String::new(),
        })
    }

    fn in_campaign(file: &Path) -> Option<Self> {
        let folder = file.parent()?;
        let measurements = folder.parent()?;
        (measurements.file_name()? == "measurements").then_some(())?;
        Some(Self {
            root: measurements.parent()?.to_path_buf(),
            campaign: folder.file_name()?.to_string_lossy().to_string(),
        })
    }

    /// The campaign `name` of the workspace `ident` runs in; without a name the only one there.
    pub fn campaign(name: Option<&str>) -> Outcome<Self> {
        let folders = || {
            let entries = std::fs::read_dir("measurements")
                .into_iter()
                .flatten()
                .flatten();
            let folders = entries.filter(|entry| entry.path().is_dir());
            let mut names: Vec<String> = folders
                .map(|e| e.file_name().to_string_lossy().to_string())
                .collect();
            names.sort();
            names
        };
        let known = folders();
        let chosen = match name {
            Some(name) => known.iter().find(|known| *known == name),
            None if known.len() == 1 => known.first(),
            None => None,
        };
        chosen
            .map(|campaign| Self {
                root: PathBuf::new(),
                campaign: campaign.clone(),
            })
            .ok_or_else(|| {
                let what = match (name, known.is_empty()) {
                    (_, true) => "there is no folder measurements/<campaign> here".to_string(),
                    (Some(name), _) => format!("measurements/ has no campaign `{name}`"),
                    (None, _) => format!("measurements/ has {} campaigns", known.len()),
                };
                let remedy = match known.is_empty() {
                    true => {
                        "name a measurement file, or run in the folder that holds measurements/"
                            .into()
                    }
                    false => format!("choose one with --campaign: {}", known.join(", ")),
                };
                Problem::new(what, remedy)
            })
    }

    /// Folder of the measurements.
    pub fn measurements(&self) -> PathBuf {
        self.root.join("measurements").join(&self.campaign)
    }

    /// The tables of the campaign that say, or of which it is said beside them, that they are of `kind`, by
    /// name.
    pub fn files_of(&self, kind: &str) -> Outcome<Vec<PathBuf>> {
        let entries = std::fs::read_dir(self.measurements())
            .into_iter()
            .flatten()
            .flatten();
        let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
        files.retain(|path| is_table(path));
        files.sort();
        let mut found = Vec::new();
        for path in files {
            let said = kind_of(&path).map_err(|problem| problem.in_file(&path))?;
            if said.as_deref() == Some(kind) {
                found.push(path);
            }
        }
        Ok(found)
    }

    /// Folder of the fits.
    pub fn fits(&self) -> PathBuf {
        self.root.join("fits").join(&self.campaign)
    }

    /// Refuses a measurement whose results would carry the name of another result: the identified robot,
    /// or the extended model of another measurement.
    ///
    /// # Errors
    /// Such a name, with what it would overwrite.
    pub fn nameable(path: &Path) -> Outcome<()> {
        let stem = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .to_string();
        let over = match stem.strip_suffix("-extended") {
            Some(_) => Some("the extended model of another measurement"),
            None if RESERVED.contains(&stem.as_str()) => Some("the robot of the campaign"),
            None => None,
        };
        match over {
            None => Ok(()),
            Some(over) => Err(Problem::new(
                format!("its fit would overwrite {over}"),
                "rename the measurement",
            )
            .in_file(path)),
        }
    }

    /// The CSV files of the campaign that none of these kinds takes, and why.
    pub fn passed_over(&self, kinds: &[&str]) -> Vec<(PathBuf, String)> {
        let entries = std::fs::read_dir(self.measurements())
            .into_iter()
            .flatten()
            .flatten();
        let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
        files.retain(|path| {
            path.is_file()
                && path
                    .extension()
                    .is_some_and(|e| MEASURED.iter().any(|m| e.eq_ignore_ascii_case(m)))
        });
        files.sort();
        let why = |path: &PathBuf| match kind_of(path) {
            Ok(Some(kind)) if kinds.contains(&kind.as_str()) => None,
            Ok(Some(kind)) => Some(match nearest(&kind, kinds) {
                Some(near) => {
                    format!("is of kind `{kind}`, which no step takes; perhaps `{near}` is meant")
                }
                None => format!("is of kind `{kind}`, which no step takes"),
            }),
            Ok(None) => Some("does not say its kind".into()),
            Err(problem) => Some(problem.what),
        };
        files
            .into_iter()
            .filter_map(|path| Some((path.clone(), why(&path)?)))
            .collect()
    }

    /// Folder of the reports.
    pub fn reports(&self) -> PathBuf {
        self.root.join("reports").join(&self.campaign)
    }
}

/// The folder of the measurements of a campaign below `root`: the one named, else the only one.
///
/// # Errors
/// No such campaign, none at all, or several to choose from.
pub fn campaign(root: &Path, named: Option<&str>) -> Outcome<PathBuf> {
    let all = folders(&root.join("measurements"));
    let names: Vec<String> = all
        .iter()
        .filter_map(|p| Some(p.file_name()?.to_string_lossy().into()))
        .collect();
    let found = match named {
        Some(name) => names.iter().position(|n| n == name),
        None => (all.len() == 1).then_some(0),
    };
    found.map(|i| all[i].clone()).ok_or_else(|| {
        let what = match (named, names.is_empty()) {
            (_, true) => "no campaign lies under measurements/ here".to_string(),
            (Some(name), _) => format!("no campaign `{name}` lies under measurements/"),
            (None, _) => format!("{} campaigns lie under measurements/", names.len()),
        };
        let remedy = match names.is_empty() {
            true => {
                "run it where measurements/<campaign>/ is, or give the measurement file".to_string()
            }
            false => format!("add --campaign with one of: {}", names.join(", ")),
        };
        Problem::new(what, remedy)
    })
}

/// The identified robot of a campaign below `root`: the one named, else the only one there is.
///
/// # Errors
/// None, or several to choose from.
pub fn identified_robot(root: &Path, named: Option<&str>) -> Outcome<PathBuf> {
    let mut all = folders(&root.join("fits"));
    all.retain(|folder| named.is_none_or(|name| folder.ends_with(name)));
    let mut found: Vec<PathBuf> = all
        .into_iter()
        .map(|folder| folder.join("robot.toml"))
        .collect();
    found.retain(|path| path.is_file());
    match found.len() {
        1 => Ok(found.remove(0)),
        0 => Err(Problem::new(
            "no robot is given, and no identified one (fits/<campaign>/robot.toml) lies here",
            "add --robot with a built-in name (kr210, kr300) or a robot file, or let `ident validate` identify one",
        )),
        n => Err(Problem::new(
            format!("no robot is given, and {n} identified ones lie here"),
            format!("add --campaign, or --robot with one of: {}", list(&found)),
        )),
    }
}

fn folders(under: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(under).into_iter().flatten().flatten();
    let mut found: Vec<PathBuf> = entries.map(|e| e.path()).filter(|p| p.is_dir()).collect();
    found.sort();
    found
}

/// Whether a file may be a table of measurements: CSV, a format of other programs, or any text that a
/// sidecar tells about.
fn is_table(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let ending = ending.to_lowercase();
    let formats = FORMATS.iter().flat_map(|format| format.endings);
    match ending.as_str() {
        "csv" => true,
        "txt" | "dat" => sidecar::place(path).is_file(),
        _ if is_universal(path) => sidecar::place(path).is_file(),
        ending => formats.copied().any(|known| known == ending),
    }
}

fn list(paths: &[PathBuf]) -> String {
    paths
        .iter()
        .map(|p| p.display().to_string())
        .collect::<Vec<_>>()
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_campaign_file_knows_its_places() {
        let place = Place::of(Path::new("w/measurements/kr210/axis6.csv"));
        assert_eq!(place.fits(), Path::new("w/fits/kr210"));
        assert_eq!(Place::of(Path::new("axis6.csv")).fits(), Path::new("fits/"));
    }
}
