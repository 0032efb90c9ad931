//! Several tests of one robot together, on the command line: what one cannot tell another may.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Stiffness of the tilting bearing of A3 in the robot that made the example, N·m/rad.
const TRUE_STIFFNESS: f64 = 1.54e6;

fn ident(arguments: &[&str], folder: &Path) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    let output = command.args(arguments).current_dir(folder).output();
    String::from_utf8(output.unwrap().stdout).unwrap()
}

/// A robot file with the dampings of the robot that was struck in the example: those of the file are assumed, and two to four times
/// too small, which is another question than that of these tests.
fn damped(robot: &str) -> String {
    let truth = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210/truth.toml");
    let truth: toml::Table = std::fs::read_to_string(truth).unwrap().parse().unwrap();
    let dampings = truth["hammer"]["damping_Nms_rad"].as_table().unwrap();
    let mut joint = String::new();
    let line = |line: &str| {
        if let Some(name) = line.strip_prefix("name = \"A") {
            joint = format!("A{}", name.trim_end_matches('"'));
        }
        let site = match line.split(" = ").next() {
            Some("drive") => joint.clone(),
            Some("tilt") => format!("{joint}-tilt"),
            _ => return line.to_string(),
        };
        let (before, rest) = line.split_once("damping_Nms_rad = ").unwrap();
        let (_, after) = rest.split_once(',').unwrap();
        format!(
            "{before}damping_Nms_rad = {:?},{after}",
            dampings[&site].as_float().unwrap()
        )
    };
    robot.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// The example's points and hits, with a model whose A3 bearing is 1.6 times as stiff as the robot's.
fn campaign(files: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("measurements/mill");
    std::fs::create_dir_all(&own).unwrap();
    let robot = ident(&["robot", "convert", "kr210"], folder.path());
    let stiff = robot.replace("1540000.0", "2464000.0");
    assert_ne!(robot, stiff);
    let stiff = damped(&stiff);
    std::fs::write(own.join("model.toml"), stiff).unwrap();
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210");
    for file in files {
        let text = std::fs::read_to_string(example.join(file)).unwrap();
        let text = text.replace("robot = \"kr210\"", "robot = \"model.toml\"");
        std::fs::write(own.join(file), text).unwrap();
    }
    folder
}

fn diagnosed(folder: &Path) -> Value {
    let said = ident(&["diagnose", "measurements/mill", "--json"], folder);
    serde_json::from_str(&said).unwrap()
}

fn names(answer: &Value, effect: &str, site: &str) -> bool {
    let causes = answer["causes"].as_array().unwrap();
    causes
        .iter()
        .any(|c| c["effect"] == effect && c["site"] == site)
}

/// Whether something is left that cannot be told from a cause at `site`.
fn in_a_group(answer: &Value, site: &str) -> bool {
    let groups = answer["cannot_separate"].as_array().unwrap();
    let sites = groups.iter().flat_map(|g| g["sites"].as_array().unwrap());
    sites.into_iter().any(|s| s == site)
}

#[test]
fn points_alone_leave_a_group_and_hits_settle_it() {
    let alone = campaign(&["workspace.csv"]);
    let answer = diagnosed(alone.path());
    assert_eq!(answer["verdict"], "cannot-tell", "{answer:#}");
    assert_eq!(answer["joint"], Value::Null);
    assert!(!names(&answer, "tilt_stiffness", "A3-tilt"));
    assert!(in_a_group(&answer, "A3-tilt"), "{answer:#}");

    let both = campaign(&["workspace.csv", "hammer.csv"]);
    let answer = diagnosed(both.path());
    assert_eq!(answer["verdict"], "explained", "{answer:#}");
    assert_eq!(answer["cannot_separate"].as_array().unwrap().len(), 0);
    let settled = answer["causes"].as_array().unwrap().iter();
    let mut settled = settled.filter(|c| c["file"].as_str().unwrap().ends_with("workspace.csv"));
    let settled = settled.next().unwrap();
    assert_eq!(settled["site"], "A3-tilt");
    assert!(settled["probability"].as_f64().unwrap() > 0.95);
    let first = &answer["joint"][0];
    assert!(
        first["alone"]["workspace"].as_f64().unwrap() < 0.9,
        "{first}"
    );
    holds_what_all_say(&answer, both.path());
}

/// The extended robots: labelled as simulated, and the joint one near the truth.
fn holds_what_all_say(answer: &Value, folder: &Path) {
    for name in ["hammer-extended.toml", "extended-robot.toml"] {
        let text = std::fs::read_to_string(folder.join("fits/mill").join(name)).unwrap();
        assert!(text.starts_with("# synthetic: "), "{name}");
    }
    let path = answer["model"].as_str().unwrap();
    let shown = ident(&["robot", "show", path, "--json"], folder);
    let shown: Value = serde_json::from_str(&shown).unwrap();
    let springs = shown["springs"].as_array().unwrap().iter();
    let mut own = springs.filter(|s| s["site"] == "A3-tilt");
    let stiffness = own.next().unwrap()["stiffness"]["value"].as_f64();
    let stiffness = stiffness.unwrap();
    assert!(
        (stiffness / TRUE_STIFFNESS - 1.0).abs() < 0.05,
        "{stiffness}"
    );
}
