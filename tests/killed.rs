//! `ident run` killed at any moment leaves every old result whole or a whole new one in its place, and
//! nothing that the next run stumbles over.

use crate::common::few_or_all;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A campaign that is short enough to be run often.
const FILES: [&str; 3] = ["axis6.csv", "axis6-tilt.csv", "workspace.csv"];
/// How many moments to kill at, evenly over a run.
fn kills() -> u32 {
    few_or_all(2, 16) as u32
}

type Results = BTreeMap<PathBuf, Vec<u8>>;

fn measurements(bench: &Path) -> PathBuf {
    bench.join("measurements/kr210")
}

/// The campaign in a folder of its own; `shorter` by the last row of each file, so that every result differs.
fn measured(bench: &Path, shorter: bool) {
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210");
    std::fs::create_dir_all(measurements(bench)).unwrap();
    for name in FILES {
        let text = std::fs::read_to_string(from.join(name)).unwrap();
        let end = match shorter {
            true => text.trim_end().rfind('\n').unwrap() + 1,
            false => text.len(),
        };
        std::fs::write(measurements(bench).join(name), &text[..end]).unwrap();
    }
}

fn start(bench: &Path, words: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    command
        .current_dir(bench)
        .args(words)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

fn finish(bench: &Path, words: &[&str]) {
    let status = start(bench, words).wait().unwrap();
    assert!(status.code().is_some_and(|code| code < 2), "{words:?}");
}

/// Everything under `fits/` and `reports/`, without what an interrupted write left beside it.
fn results(bench: &Path) -> Results {
    let mut found = Results::new();
    for folder in ["fits/kr210", "reports/kr210"] {
        for entry in std::fs::read_dir(bench.join(folder)).into_iter().flatten() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().to_string();
            if !is_left_over(&name) {
                found.insert(Path::new(folder).join(&name), std::fs::read(&path).unwrap());
            }
        }
    }
    found
}

fn is_left_over(name: &str) -> bool {
    name.starts_with(".ident-") && name.ends_with(".tmp")
}

/// What each step of a whole run leaves, in the order of the steps: results that later steps write again
/// are whole in between too.
fn after_each_step(bench: &Path) -> Vec<Results> {
    let axes = [
        "measurements/kr210/axis6.csv",
        "measurements/kr210/axis6-tilt.csv",
    ];
    let steps: [&[&str]; 3] = [
        &[&["stiffness"][..], &axes].concat(),
        &["validate", "measurements/kr210/workspace.csv"],
        &["run", "measurements/kr210"],
    ];
    let step = |words: &&[&str]| {
        finish(bench, words);
        results(bench)
    };
    steps.iter().map(step).collect()
}

#[test]
fn killed_at_any_moment_results_are_whole() {
    let (old, new) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    measured(old.path(), false);
    finish(old.path(), &["run", "measurements/kr210"]);
    let before = results(old.path());
    measured(new.path(), true);
    let after = after_each_step(new.path());
    let last = after.last().unwrap();
    assert!(before.len() > 15 && before.keys().eq(last.keys()));
    let differ = before.iter().filter(|(path, bytes)| last[*path] != **bytes);
    assert!(differ.count() > 10);
    let bench = old.path();
    measured(bench, true);
    let began = Instant::now();
    finish(bench, &["run", "measurements/kr210"]);
    let whole = began.elapsed();
    assert!(
        results(bench) == *last,
        "not the same results over old ones"
    );
    for kill in 0..kills() {
        restore(bench, &before);
        let mut child = start(bench, &["run", "measurements/kr210"]);
        std::thread::sleep(whole * kill / kills() + Duration::from_millis(3));
        child.kill().unwrap();
        child.wait().unwrap();
        for (path, bytes) in results(bench) {
            let known = after.iter().any(|step| step.get(&path) == Some(&bytes));
            let whole = known || before.get(&path) == Some(&bytes);
            assert!(
                whole,
                "kill {kill}: {} is neither old nor new",
                path.display()
            );
        }
        assert!(before.keys().all(|path| bench.join(path).is_file()));
    }
    finish(bench, &["run", "measurements/kr210"]);
    assert!(results(bench) == *last, "the next run stumbled");
}

/// Puts the old results back; what killed runs left beside them stays.
fn restore(bench: &Path, results: &Results) {
    for (path, bytes) in results {
        std::fs::write(bench.join(path), bytes).unwrap();
    }
}
