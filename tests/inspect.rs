//! `ident inspect` on every kind of the example campaign: said is what the file holds.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn example(name: &str) -> PathBuf {
    let campaign = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210");
    campaign.join(name)
}

fn inspect(path: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    command
        .arg("inspect")
        .arg(path)
        .args(more)
        .output()
        .unwrap()
}

fn document(path: &Path) -> Value {
    let output = inspect(path, &["--json"]);
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(
        (&document["schema"], &document["verb"]),
        (&Value::from("ident/1"), &Value::from("inspect"))
    );
    document
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).to_string() + &String::from_utf8_lossy(&output.stderr)
}

/// The example with some lines taken out or changed.
fn changed(name: &str, edit: impl Fn(&str) -> Option<String>) -> (tempfile::TempDir, PathBuf) {
    let text = std::fs::read_to_string(example(name)).unwrap();
    let lines: Vec<String> = text.lines().filter_map(edit).collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, lines.join("\n") + "\n").unwrap();
    (folder, path)
}

#[test]
fn a_workspace_file() {
    let path = example("workspace.csv");
    let answer = document(&path);
    let text = std::fs::read_to_string(&path).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).count() - 1;
    assert_eq!(answer["kind"], "workspace");
    assert_eq!(answer["rows"], rows);
    let points = answer["points"].as_array().unwrap();
    assert_eq!(points.len(), 9);
    assert_eq!(points[0]["joint_angles_deg"][0], 21.0375);
    let steps = |point: &Value| -> u64 {
        let directions = point["directions"].as_array().unwrap().iter();
        directions.map(|d| d["steps"].as_u64().unwrap()).sum()
    };
    let left_out = answer["rows_left_out"].as_u64().unwrap();
    assert_eq!(
        points.iter().map(steps).sum::<u64>() + left_out,
        rows as u64
    );
    assert_eq!(points[0]["directions"][0]["force_N"][1], 750.0);
    let told = said(&inspect(&path, &[]));
    assert!(told.contains("workspace of kr210") && told.contains("force along y: 9 points"));
    assert!(told.contains("synthetic"));
}

#[test]
fn what_is_odd_in_a_workspace_file() {
    let (_folder, path) = changed("workspace.csv", |line| {
        let cells: Vec<&str> = line.split(',').collect();
        match cells[..] {
            ["5", ..] => None,
            ["2", "x", cycle, force, _, dy, dz] => Some(format!("2,x,{cycle},{force},,{dy},{dz}")),
            _ => Some(line.to_string()),
        }
    });
    let output = inspect(&path, &[]);
    assert_eq!(output.status.code(), Some(1));
    let told = said(&output);
    assert!(
        told.contains("odd: joint angles but no steps: P5"),
        "{told}"
    );
    assert!(
        told.contains("no displacement along the force, so no stiffness: P2 x"),
        "{told}"
    );
    assert_eq!(document(&path)["odd"].as_array().unwrap().len(), 2);
}

#[test]
fn a_hammer_file() {
    let path = example("hammer.csv");
    let answer = document(&path);
    let text = std::fs::read_to_string(&path).unwrap();
    let hits: std::collections::BTreeSet<(&str, &str)> = text
        .lines()
        .skip_while(|line| line.starts_with('#'))
        .skip(1)
        .filter_map(|line| {
            let mut cells = line.split(',');
            Some((cells.next()?, cells.next()?))
        })
        .collect();
    let directions = answer["directions"].as_array().unwrap();
    let found: u64 = directions.iter().map(|d| d["hits"].as_u64().unwrap()).sum();
    assert_eq!(
        (answer["kind"].as_str(), found),
        (Some("hammer"), hits.len() as u64)
    );
    assert_eq!(answer["sampling_s"], 0.001);
    assert_eq!(answer["responses"], serde_json::json!(["x", "y", "z"]));
    assert_eq!(answer["joint_angles_deg"][1], -75.0);
    let told = said(&inspect(&path, &[]));
    assert!(told.contains("hammer test of kr210") && told.contains("sampled at 1000 Hz"));
}

#[test]
fn what_is_odd_in_a_hammer_file() {
    let (_folder, path) = changed("hammer.csv", |line| {
        let kept = !line.starts_with("# joint_angles") && !line.starts_with("z,")
            || line.starts_with("z,1,");
        kept.then(|| line.to_string())
    });
    let output = inspect(&path, &[]);
    let told = said(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(
        told.contains("fewer than 3 hits along z") && told.contains("no `joint_angles_deg`"),
        "{told}"
    );
}

#[test]
fn other_kinds_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("weather.csv");
    std::fs::write(&path, "# kind = \"weather\"\nrun,target_mm\n1,2\n").unwrap();
    let output = inspect(&path, &[]);
    let told = said(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(
        told.contains("`weather`") && told.contains("load-cycle, ") && told.contains("hammer"),
        "{told}"
    );
}

#[test]
fn a_universal_file_tells_its_data_sets() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frf.uff");
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    let made = command
        .arg("frf")
        .arg(example("hammer.csv"))
        .arg("--uff")
        .arg(&file)
        .output()
        .unwrap();
    assert!(file.exists(), "{}", said(&made));
    assert_eq!(inspect(&file, &[]).status.code(), Some(0));
    let sets = document(&file);
    assert_eq!(sets["kind"], "universal");
    let sets = sets["functions"].as_array().unwrap();
    let frfs = sets.iter().filter(|set| set["kind"] == "FRF");
    assert_eq!(frfs.count(), 9);
    assert!(sets.iter().all(|set| set["values"].as_u64() > Some(100)));
}

/// A half circle reaches farther than its ends.
#[test]
fn arcs_belong_to_the_extent_of_a_path() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arc.nc");
    std::fs::write(
        &path,
        "G21 G90 G17\nG1 X40 Y0 Z0 F1000\nG3 X40 Y40 I0 J20\nM30\n",
    )
    .unwrap();
    let found = document(&path)["extent_mm"][0][1].as_f64().unwrap();
    assert!((found - 60.0).abs() < 1e-6, "{found}");
}
