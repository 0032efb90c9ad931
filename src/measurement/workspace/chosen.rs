//! The one file that is meant.

use super::{is_table, list};
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::leading::kind_of;
use std::path::{Path, PathBuf};

/// The only measurement of a kind in the folder of a campaign.
///
/// # Errors
/// None, or several: then one must be given.
pub fn only_of_kind(folder: &Path, kind: &str) -> Outcome<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = entries.map(|e| e.path());
    let mut found: Vec<PathBuf> = paths
        .filter(|p| is_table(p))
        .filter(|p| kind_of(p).ok().flatten().as_deref() == Some(kind))
        .collect();
    found.sort();
    match found.len() {
        1 => Ok(found.remove(0)),
        0 => Err(Problem::new(
            format!("holds no measurement of kind `{kind}`"),
            format!("put one there (`# kind = \"{kind}\"` in its front matter), or give the file"),
        )
        .in_file(folder)),
        n => Err(Problem::new(
            format!("holds {n} measurements of kind `{kind}`"),
            format!("give one of them: {}", list(&found)),
        )
        .in_file(folder)),
    }
}

/// The file meant by `name`: the path itself, or, when it is not there, the only file of that name
/// under `measurements/`. The second value tells what was found for a name that is not a path.
pub fn resolve(name: &Path) -> Outcome<(PathBuf, Option<String>)> {
    if name.exists() || name.components().count() > 1 {
        return Ok((name.to_path_buf(), None));
    }
    let mut found = files_named(name);
    found.sort();
    match found.len() {
        0 => Ok((name.to_path_buf(), None)),
        1 => {
            let said = format!(
                "{} is not here; taking {}",
                name.display(),
                found[0].display()
            );
            Ok((found.remove(0), Some(said)))
        }
        _ => Err(Problem::new(
            format!("the name stands for {} files", found.len()),
            format!("give the path of one: {}", list(&found)),
        )
        .in_file(name)),
    }
}

fn files_named(name: &Path) -> Vec<PathBuf> {
    let campaigns = std::fs::read_dir("measurements")
        .into_iter()
        .flatten()
        .flatten();
    campaigns
        .map(|c| c.path().join(name))
        .filter(|p| p.is_file())
        .collect()
}
