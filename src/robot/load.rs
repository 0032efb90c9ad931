//! From what the user typed to a robot: a built-in name, a TOML file or a URDF file.

use super::model::Robot;
use super::{builtin, file, urdf};
use crate::ground::files::{read_bytes, sha256};
use crate::ground::problem::{Outcome, Problem};
use std::path::{Path, PathBuf};

/// A robot with where it came from.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The robot.
    pub robot: Robot,
    /// `builtin:kr210`, or the path as it was found.
    pub path: String,
    /// SHA-256 of its text, 64 hex digits.
    pub sha256: String,
}

impl Loaded {
    /// Path and hash, as results list their inputs.
    pub fn input(&self) -> (String, String) {
        (self.path.clone(), self.sha256.clone())
    }
}

/// Loads the robot `name`: a built-in name, else a file. A relative path is looked up beside
/// `measurement` (the file that names the robot) first, then from the working directory.
///
/// # Errors
/// No such file or name, or whatever the reader refuses, with the file named.
pub fn load(name: &str, measurement: Option<&Path>) -> Outcome<Loaded> {
    if let Some(text) = builtin::text(name) {
        let robot = file::read(text)?;
        return Ok(Loaded {
            robot,
            path: format!("builtin:{name}"),
            sha256: sha256(text.as_bytes()),
        });
    }
    let path = find(name, measurement);
    let bytes = read_bytes(&path).map_err(|problem| no_such(name, problem, measurement))?;
    let robot = read(&bytes).map_err(|problem| problem.in_text(&path))?;
    Ok(Loaded {
        robot,
        path: path.display().to_string(),
        sha256: sha256(&bytes),
    })
}

fn find(name: &str, measurement: Option<&Path>) -> PathBuf {
    let plain = PathBuf::from(name);
    let beside = measurement
        .and_then(Path::parent)
        .map(|folder| folder.join(&plain));
    beside.filter(|path| path.exists()).unwrap_or(plain)
}

fn no_such(name: &str, problem: Problem, measurement: Option<&Path>) -> Problem {
    let known = builtin::names();
    let remedy = format!(
        "`{name}` is no built-in robot ({known}); {}",
        problem.remedy
    );
    match measurement {
        Some(file) => {
            Problem::new(format!("`{name}` {}", problem.what), remedy).at_key(file, "robot")
        }
        None => Problem { remedy, ..problem },
    }
}

/// Reads robot text: URDF if it starts with `<`, else TOML.
///
/// # Errors
/// Text that is not UTF-8, and whatever the reader refuses.
pub fn read(bytes: &[u8]) -> Outcome<Robot> {
    let text = std::str::from_utf8(bytes).map_err(|_| {
        Problem::new(
            "is not UTF-8 text",
            "a robot file is TOML or URDF, saved as UTF-8",
        )
    })?;
    let text = text.trim_start_matches('\u{feff}');
    match text.trim_start().starts_with('<') {
        true => urdf::read(text),
        false => file::read(text),
    }
}
