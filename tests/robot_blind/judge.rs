//! Asks the program what it makes of a case, as a user would.

use super::case::Case;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Instant;

/// An effect at a place.
pub type Named = (String, String);

/// What the program said.
#[derive(Clone, Default)]
pub struct Answer {
    /// Why there is no answer.
    pub failed: Option<String>,
    pub verdict: String,
    pub causes: Vec<Named>,
    pub groups: Vec<Vec<Named>>,
    pub seconds: f64,
}

/// Runs the program on one thread: the cases run beside each other.
pub fn ident(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ident"))
        .args(arguments)
        .env("RAYON_NUM_THREADS", "1")
        .current_dir(folder)
        .output()
        .unwrap()
}

/// The JSON document that the program prints; the error text if there is none.
pub fn document(arguments: &[&str], folder: &Path) -> Result<Value, String> {
    let output = ident(arguments, folder);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    match (output.status.code(), serde_json::from_slice(&output.stdout)) {
        (Some(0 | 1), Ok(value)) => Ok(value),
        (code, _) => Err(format!("exit {code:?}: {said}")),
    }
}

pub fn ask(case: &Case) -> Answer {
    let folder = tempfile::tempdir().unwrap();
    let file = case.write(folder.path());
    let typed = ["diagnose", file.to_str().unwrap(), "--dry-run", "--json"];
    let start = Instant::now();
    let said = document(&typed, folder.path());
    let seconds = start.elapsed().as_secs_f64();
    let answer = match said {
        Ok(value) => read(&value),
        Err(why) => Answer {
            failed: Some(why),
            ..Answer::default()
        },
    };
    Answer { seconds, ..answer }
}

fn word(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_string()
}

fn words(value: &Value) -> Vec<String> {
    value.as_array().into_iter().flatten().map(word).collect()
}

pub fn read(document: &Value) -> Answer {
    let list = |key: &str| document[key].as_array().cloned().unwrap_or_default();
    let causes = list("causes");
    let causes = causes
        .iter()
        .map(|c| (word(&c["effect"]), word(&c["site"])));
    Answer {
        failed: None,
        verdict: word(&document["verdict"]),
        causes: causes.collect(),
        groups: list("cannot_separate").iter().map(members).collect(),
        seconds: 0.0,
    }
}

/// Effects and sites side by side; a list of sites that is shorter holds for every effect.
fn members(group: &Value) -> Vec<Named> {
    let (effects, sites) = (words(&group["effects"]), words(&group["sites"]));
    if effects.len() == sites.len() {
        return effects.into_iter().zip(sites).collect();
    }
    let site = sites.first().cloned().unwrap_or_default();
    effects.into_iter().map(|e| (e, site.clone())).collect()
}
