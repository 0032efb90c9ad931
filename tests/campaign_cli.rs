//! `ident diagnose` of a whole campaign: its document, and what it says beside the causes.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

fn bench(files: &[&str]) -> tempfile::TempDir {
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210");
    let bench = tempfile::tempdir().unwrap();
    let folder = bench.path().join("measurements/kr210");
    std::fs::create_dir_all(&folder).unwrap();
    for name in files {
        std::fs::copy(from.join(name), folder.join(name)).unwrap();
    }
    bench
}

fn ident(bench: &Path, words: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    let out = command.current_dir(bench).args(words).output().unwrap();
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.code().is_some_and(|code| code < 2), "{said}");
    String::from_utf8(out.stdout).unwrap()
}

fn campaign(bench: &Path) -> Value {
    let words = ["diagnose", "measurements/kr210", "--dry-run", "--json"];
    serde_json::from_str(&ident(bench, &words)).unwrap()
}

#[test]
fn the_document_plans_and_says_which_gaps_stay_closed() {
    let bench = bench(&["axis6.csv", "workspace.csv"]);
    let before = campaign(bench.path());
    assert_eq!(
        before["remarks"],
        serde_json::json!([]),
        "no axis test is fitted yet"
    );
    ident(bench.path(), &["stiffness", "measurements/kr210/axis6.csv"]);
    let said = campaign(bench.path());
    assert_eq!(said["kind"], "campaign");
    let remark = said["remarks"][0].as_str().unwrap();
    for words in [
        "A6 216 µrad",
        "are left closed",
        "workspace",
        "none of these tests shows",
    ] {
        assert!(remark.contains(words), "{remark}");
    }
    let experiments = said["experiments"].as_array().unwrap();
    assert_eq!(experiments.len(), 2);
    assert_eq!(experiments[1]["limits"][1]["site"], "A6");
    assert!(experiments[1]["limits"][1]["unnoticed_excess_of_compliance"].is_null());
    let next = said["next"].as_array().unwrap();
    let plan = ident(
        bench.path(),
        &[
            "diagnose",
            "measurements/kr210",
            "--next",
            "5",
            "--dry-run",
            "--json",
        ],
    );
    let plan: Value = serde_json::from_str(&plan).unwrap();
    assert_eq!((next.len(), &said["next"]), (5, &plan["next"]));
}

#[test]
fn without_a_robot_nothing_is_planned() {
    let bench = bench(&["axis6.csv"]);
    let path = bench.path().join("measurements/kr210/axis6.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    let kept: Vec<&str> = text
        .lines()
        .filter(|line| !line.starts_with("# robot"))
        .collect();
    std::fs::write(&path, kept.join("\n")).unwrap();
    let said = campaign(bench.path());
    assert!(said["next"].is_null() && said["remarks"] == serde_json::json!([]));
}

#[test]
fn several_workspace_tests_are_diagnosed_and_not_planned_for() {
    let bench = bench(&["workspace.csv"]);
    let folder = bench.path().join("measurements/kr210");
    std::fs::copy(folder.join("workspace.csv"), folder.join("again.csv")).unwrap();
    let said = campaign(bench.path());
    assert_eq!(said["experiments"].as_array().unwrap().len(), 2);
    let remark = said["remarks"][0].as_str().unwrap();
    assert!(remark.starts_with("No set-ups are planned:"), "{remark}");
    assert!(said["next"].is_null());
}
