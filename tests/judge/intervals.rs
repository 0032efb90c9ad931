//! Intervals of the verbs that identify, against files whose truth is known.

use super::{Held, number};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Truth of one number: parameter's name, site where it matters, value in SI units.
pub type Known = (String, Option<String>, f64);

/// Files with their truth; the first is given to the verb.
pub type Draw = fn(u64) -> (Vec<(String, String)>, Vec<Known>);

/// Runs `ident VERB FILE --json --dry-run` on files of many seeds and counts the intervals that hold the truth.
pub fn held(verb: &str, draw: Draw, files: u64) -> Held {
    let base = number("IDENT_BLIND_SEED", 1) * 100_000;
    let count = number("IDENT_JUDGE_CASES", files);
    let mut all = Held::default();
    for seed in base..base + count {
        let (files, truth) = draw(seed);
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in &files {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        let told = told(verb, folder.path(), &files[0].0);
        let Some(parameters) = told["parameters"].as_array() else {
            println!("# {verb} {seed}: no parameters: {told}");
            continue;
        };
        for (name, site, value) in &truth {
            one(&mut all, parameters, name, site.as_deref(), *value, seed);
        }
    }
    all
}

/// What `ident VERB FILE --json --dry-run` says; what it says on standard error where that is no JSON.
pub fn told(verb: &str, folder: &Path, file: &str) -> Value {
    let run = Command::new(env!("CARGO_BIN_EXE_ident"))
        .args([verb, file, "--json", "--dry-run"])
        .current_dir(folder)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    serde_json::from_str(&said)
        .unwrap_or_else(|_| Value::String(String::from_utf8_lossy(&run.stderr).to_string()))
}

fn one(
    all: &mut Held,
    parameters: &[Value],
    name: &str,
    site: Option<&str>,
    truth: f64,
    seed: u64,
) {
    let fits = |p: &&Value| p["name"] == name && site.is_none_or(|s| p["site"] == s);
    let Some(found) = parameters.iter().find(fits) else {
        return;
    };
    if let (Some(low), Some(high)) = (found["ci95"][0].as_f64(), found["ci95"][1].as_f64()) {
        all.add(name, low, high, truth);
        if !(low..=high).contains(&truth) && std::env::var("IDENT_DEBUG").is_ok() {
            let half = 0.5 * (high - low);
            let off = (truth - 0.5 * (low + high)) / half;
            println!(
                "# {seed} {name} {} truth {truth:.6e} in [{low:.6e}, {high:.6e}] {} off {off:.2} half widths",
                site.unwrap_or(""),
                found["unit"]
            );
        }
    }
}
