//! Diagnosis of workspace tests on the command line.

use ident::experiments::workspace::Deflection;
use ident::robot::model::ElasticAxis;
use ident::robot::{Robot, Spring};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn ident(arguments: &[&str], folder: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    command
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn document(output: &Output) -> Value {
    let said = String::from_utf8_lossy(&output.stderr);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {said}"))
}

/// A campaign that holds the example's workspace test, changed.
fn campaign(change: impl Fn(String) -> String) -> (tempfile::TempDir, PathBuf) {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210/workspace.csv");
    let text = std::fs::read_to_string(example).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("measurements/mill");
    std::fs::create_dir_all(&own).unwrap();
    let file = own.join("points.csv");
    std::fs::write(&file, change(text)).unwrap();
    (folder, file)
}

/// The built-in robot as a file, with every bearing rigid.
fn without_tilt(folder: &Path) {
    let output = ident(&["robot", "convert", "kr210"], folder);
    let text = String::from_utf8(output.stdout).unwrap();
    let rigid = |line: &&str| !line.starts_with("tilt = ");
    let text: Vec<&str> = text.lines().filter(rigid).collect();
    std::fs::write(folder.join("measurements/mill/bare.toml"), text.join("\n")).unwrap();
}

fn bare(text: String) -> String {
    text.replace("robot = \"kr210\"", "robot = \"bare.toml\"")
}

#[test]
fn a_model_with_its_tilts_is_sufficient() {
    let (folder, file) = campaign(|text| text);
    let typed = ["diagnose", file.to_str().unwrap(), "--json"];
    let output = ident(&typed, folder.path());
    assert_eq!(output.status.code(), Some(0));
    let answer = document(&output);
    assert_eq!(answer["verdict"], "sufficient", "{answer:#}");
    assert_eq!(answer["kind"], "workspace");
    assert_eq!(answer["model"], Value::Null);
    let limits = answer["limits"].as_array().unwrap();
    let hidden = |l: &&Value| l["effect"] == "drive_stiffness" && l["site"] == "A6";
    assert!(limits.iter().any(|l| hidden(&l)), "{limits:?}");
}

/// The displacements read to full steps, mm.
fn coarse(text: &str, step: f64) -> String {
    let read = |cell: &str| {
        let value: f64 = cell.parse().unwrap();
        format!("{:.4}", (value / step).round() * step)
    };
    let line = |line: &str| match line.starts_with(|c: char| c.is_ascii_digit()) {
        false => line.to_string(),
        true => {
            let cells = line.split(',').enumerate();
            let cells = cells.map(|(i, c)| if i < 4 { c.to_string() } else { read(c) });
            cells.collect::<Vec<_>>().join(",")
        }
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// A step of 3 and of 100 times the noise: components that hardly move show one number at every load. A foundation was
/// named for it, and of a third of a millimetre a wave of A2.
#[test]
fn a_coarse_sensor_is_no_cause() {
    for step in [0.01, 0.1, 0.3] {
        let (folder, file) = campaign(|text| coarse(&text, step));
        let file = file.to_str().unwrap();
        let answer = document(&ident(&["diagnose", file, "--json"], folder.path()));
        assert_eq!(answer["verdict"], "sufficient", "{step}: {answer:#}");
        let validated = ident(&["validate", file, "--json"], folder.path());
        assert!(validated.status.code() < Some(2), "{step}");
    }
}

/// The readings at the largest force of every cycle, and no others.
fn one_force(text: String) -> String {
    let kept = |line: &&str| {
        line.starts_with('#') || line.starts_with("point") || line.contains(",750.0,")
    };
    let mut seen = std::collections::BTreeSet::new();
    let first = |line: &&str| match line.split_once(",750.0,") {
        Some((cycle, _)) => seen.insert(cycle.to_string()),
        None => true,
    };
    let lines: Vec<&str> = text.lines().filter(kept).filter(first).collect();
    lines.join("\n")
}

#[test]
fn one_force_a_cycle_counts_from_the_unloaded_robot() {
    let (folder, file) = campaign(one_force);
    let typed = ["diagnose", file.to_str().unwrap(), "--json"];
    let answer = document(&ident(&typed, folder.path()));
    assert_eq!(answer["verdict"], "sufficient", "{answer:#}");
    assert!(answer["discrepancy"]["rms"].as_f64().unwrap() > 1e-7);
    assert!(answer["discrepancy"]["noise_rms"].as_f64().unwrap() > 1e-7);
    let (folder, file) = campaign(|text| bare(one_force(text)));
    without_tilt(folder.path());
    let typed = ["diagnose", file.to_str().unwrap(), "--json"];
    let answer = document(&ident(&typed, folder.path()));
    let causes = answer["causes"].as_array().unwrap();
    assert!(!causes.is_empty(), "{answer:#}");
    assert!(
        causes.iter().all(|c| c["effect"] == "missing_tilt"),
        "{causes:#?}"
    );
}

/// One reading of every set-up scatters about nothing: the stated noise stands, where none stood and sets had no probability.
#[test]
fn one_reading_of_every_set_up_has_the_stated_noise() {
    let first = |line: &&str| {
        let mut cells = line.split(',');
        !line.contains(",750.0,") || cells.nth(2) == Some("1")
    };
    let alone = |text: String| {
        let text = one_force(text);
        text.lines().filter(first).collect::<Vec<_>>().join("\n")
    };
    let (folder, file) = campaign(|text| bare(alone(text)));
    without_tilt(folder.path());
    let typed = ["diagnose", file.to_str().unwrap(), "--json"];
    let answer = document(&ident(&typed, folder.path()));
    let noise = answer["discrepancy"]["noise"].as_str().unwrap();
    assert!(noise.starts_with("3.0 µm a reading"), "{noise}");
    let candidates = answer["candidates"].as_array().unwrap();
    assert!(!candidates.is_empty());
    assert!(
        candidates.iter().all(|c| c["probability"].is_number()),
        "{candidates:#?}"
    );
}

#[test]
fn missing_tilts_are_found_placed_and_carried_on() {
    let (folder, file) = campaign(bare);
    without_tilt(folder.path());
    let typed = ["diagnose", file.to_str().unwrap(), "--json"];
    let output = ident(&typed, folder.path());
    assert_eq!(output.status.code(), Some(1));
    let answer = document(&output);
    let causes = answer["causes"].as_array().unwrap();
    assert!(!causes.is_empty(), "{answer:#}");
    let tilt =
        |c: &Value| c["effect"] == "missing_tilt" && c["site"].as_str().unwrap().ends_with("-tilt");
    assert!(causes.iter().all(tilt), "{causes:#?}");
    let errors = answer["stiffness_error_at_unseen_points"]
        .as_array()
        .unwrap();
    let y = errors.iter().find(|e| e["direction"] == "y").unwrap();
    assert!(y["before_percent"].as_f64().unwrap() > 50.0, "{y}");
    assert!(y["after_percent"].as_f64().unwrap() < 8.0, "{y}");
    let model = answer["model"].as_str().unwrap();
    let named = |end: &str| folder.path().join("reports/mill").join(end).is_file();
    assert!(named("points-diagnosis.html") && named("points-diagnosis.svg"));
    let again = [
        "validate",
        file.to_str().unwrap(),
        "--robot",
        model,
        "--dry-run",
        "--json",
    ];
    let checked = document(&ident(&again, folder.path()));
    assert!(checked["mean_abs_error_percent"].as_f64().unwrap() < 8.0);
    let twice = ident(&typed, folder.path());
    assert_eq!(
        twice.stdout, output.stdout,
        "the same input gives the same bytes"
    );
}

#[test]
fn an_instrument_is_blamed_before_the_robot() {
    let tenth = |line: &str| -> String {
        let cells: Vec<&str> = line.split(',').collect();
        match cells[..] {
            [a, b, c, d, x, y, z] if a.parse::<u32>().is_ok() => {
                let y: f64 = y.parse().unwrap();
                format!("{a},{b},{c},{d},{x},{:.5},{z}", 1.25 * y)
            }
            _ => line.to_string(),
        }
    };
    let (folder, file) = campaign(|text| {
        let lines: Vec<String> = text.lines().map(tenth).collect();
        lines.join("\n") + "\n"
    });
    let typed = ["diagnose", file.to_str().unwrap(), "--json", "--dry-run"];
    let answer = document(&ident(&typed, folder.path()));
    let cause = &answer["causes"][0];
    assert_eq!(cause["effect"], "sensor_gain", "{answer:#}");
    assert_eq!(cause["site"], "sensor-y");
    let gain = cause["parameters"][0]["value"].as_f64().unwrap();
    assert!((gain - 0.25).abs() < 0.03, "{gain}");
}

#[test]
fn wrong_input_is_refused_with_a_remedy() {
    let refused = |change: fn(String) -> String, word: &str| {
        let (folder, file) = campaign(change);
        let output = ident(&["diagnose", file.to_str().unwrap()], folder.path());
        let said = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(word), "{said}");
    };
    refused(
        |t| t.replace("robot = \"kr210\"", "robot = \"none.toml\""),
        "none.toml",
    );
    refused(|t| t.replace("1,x,1,150.0", "11,x,1,150.0"), "point 11");
    refused(|t| t.replace("1,x,1,150.0", "1,w,1,150.0"), "direction");
    refused(
        |t| t.replace("kind = \"workspace\"", "kind = \"path\""),
        "path",
    );
    refused(|t| t.replace(", 21.0375],", "],"), "angles");
}

/// The example's readings with what an elastic axis adds to them.
fn softened(text: &str, axis: ElasticAxis) -> String {
    changed(text, |robot, points| {
        let mut soft = robot.clone();
        soft.elastic.push(axis.clone());
        Deflection::of(&soft, points).slopes
    })
}

/// The example's readings with other slopes (m/N, by point, direction and component) in the place of the robot's.
fn changed(text: &str, other: impl Fn(&Robot, &[Vec<f64>]) -> Vec<[[f64; 3]; 3]>) -> String {
    let robot = ident::robot::builtin::named("kr210").unwrap().unwrap();
    let angles = text.lines().filter_map(|line| line.strip_prefix("#   ["));
    let angles = angles.map(|line| {
        let own = line.trim_end_matches("],").split(", ");
        own.map(|q| q.parse::<f64>().unwrap().to_radians())
            .collect()
    });
    let points: Vec<Vec<f64>> = angles.collect();
    let (before, after) = (
        Deflection::of(&robot, &points).slopes,
        other(&robot, &points),
    );
    let line = |line: &str| -> String {
        let cells: Vec<&str> = line.split(',').collect();
        let Some(point) = cells[0].parse::<usize>().ok().filter(|_| cells.len() == 7) else {
            return line.to_string();
        };
        let direction = ["x", "y", "z"].iter().position(|d| *d == cells[1]).unwrap();
        let force: f64 = cells[3].parse().unwrap();
        let [was, is] = [&before, &after].map(|slopes| slopes[point - 1][direction]);
        let read = |k: usize| {
            let own: f64 = cells[4 + k].parse().unwrap();
            format!("{:.5}", own + 1e3 * force * (is[k] - was[k]))
        };
        let read = [0, 1, 2].map(read).join(",");
        format!("{},{read}", cells[..4].join(","))
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn what_gives_way_about_an_oblique_axis_is_one_cause() {
    let robot = ident::robot::builtin::named("kr210").unwrap().unwrap();
    let middle = |i: usize| {
        let [a, b] = [robot.joints[i - 1].point, robot.joints[i].point];
        [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]))
    };
    for (effect, site, after, point, axis, stiffness) in [
        ("base_compliance", "base", 0, [0.0; 3], [0.6, 0.8, 0.0], 4e6),
        (
            "link_compliance",
            "link2",
            2,
            middle(2),
            [0.48, 0.6, 0.64],
            2e6,
        ),
        (
            "tool_compliance",
            "tool",
            6,
            robot.tool.flange,
            [0.0, 0.6, 0.8],
            1e5,
        ),
    ] {
        let added = ElasticAxis {
            name: "hidden".into(),
            after,
            axis,
            point,
            spring: Spring::new(stiffness, 0.0),
            body: None,
        };
        let (folder, file) = campaign(|text| softened(&text, added.clone()));
        let typed = ["diagnose", file.to_str().unwrap(), "--json", "--dry-run"];
        let answer = document(&ident(&typed, folder.path()));
        let causes = answer["causes"].as_array().unwrap();
        let named = |c: &Value| c["effect"] == effect && c["site"] == site;
        assert!(
            causes.len() == 1 && causes.iter().all(named),
            "{effect}: {answer:#}"
        );
        assert_eq!(answer["verdict"], "explained", "{effect}: {answer:#}");
    }
}

/// A reflector beside the tip moves by what the tool turns by: no load is turned and no sensor wrong.
#[test]
fn a_target_beside_the_tip_is_no_cause() {
    let (folder, file) = campaign(|text| {
        let exact = text.replace("setup_repeatability = 0.015", "setup_repeatability = 0.002");
        changed(&exact, |robot, points| {
            let tip = Deflection::of(robot, points).slopes;
            let [at, beside] = [0.0, 0.025].map(|off| {
                let place = [0, 1, 2].map(|k| robot.tool.tcp[k] + off * [0.6, 0.0, 0.8][k]);
                Deflection::seen_at(robot, points, 6, place).slopes
            });
            let moved = |p: usize, d: usize, k: usize| tip[p][d][k] + beside[p][d][k] - at[p][d][k];
            let point = |p: usize| [0, 1, 2].map(|d| [0, 1, 2].map(|k| moved(p, d, k)));
            (0..points.len()).map(point).collect()
        })
    });
    let typed = ["diagnose", file.to_str().unwrap(), "--json", "--dry-run"];
    let answer = document(&ident(&typed, folder.path()));
    assert_eq!(answer["causes"].as_array().unwrap().len(), 0, "{answer:#}");
}
