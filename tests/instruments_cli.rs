//! The campaigns of instruments as typed: cubes, force sensor and screw in `ident run`, their results where
//! later verbs take them up, and their diagnoses against the truth of the campaign.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

fn ident(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ident"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

fn json(output: &Output) -> Value {
    let said = String::from_utf8_lossy(&output.stderr);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {said}"))
}

/// A workspace with one of the example campaigns.
fn bench(campaign: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let from = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("measurements")
        .join(campaign);
    let to = folder.path().join("measurements").join(campaign);
    std::fs::create_dir_all(&to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().flatten() {
        if entry.path().extension().is_some_and(|e| e == "csv") {
            std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
        }
    }
    folder
}

fn named(answer: &Value) -> Vec<(String, String)> {
    let text = |v: &Value| v.as_str().unwrap().to_string();
    let causes = answer["causes"].as_array().unwrap();
    let mut found: Vec<(String, String)> = causes
        .iter()
        .map(|c| (text(&c["effect"]), text(&c["site"])))
        .collect();
    found.sort();
    found
}

fn pair(effect: &str, site: &str) -> (String, String) {
    (effect.into(), site.into())
}

#[test]
fn a_campaign_of_a_robot_has_its_cubes_and_its_force_sensor_in_the_report() {
    let bench = bench("kr300");
    let ran = ident(bench.path(), &["run", "measurements/kr300", "--json"]);
    let said = json(&ran);
    let verbs: Vec<&str> = said["steps"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| s["verb"].as_str().unwrap())
        .collect();
    assert_eq!(verbs, ["stiffness", "stiffness", "sensor", "diagnose"]);
    assert_eq!(said["passed_over"], serde_json::json!([]));
    let at = |name: &str| bench.path().join(name);
    let page = std::fs::read_to_string(at("reports/kr300/index.html")).unwrap();
    for word in [
        "The measuring cubes",
        "The force sensor",
        "The axis tests",
        "synthetic",
    ] {
        assert!(page.contains(word), "{word}");
    }
    for name in [
        "fits/kr300/cubes.toml",
        "fits/kr300/weights-sensor.toml",
        "fits/kr300/axis1.toml",
    ] {
        assert!(at(name).is_file(), "{name}");
    }
    // the robot holds what cubes and axis tests found together, and loads
    let robot: toml::Table = std::fs::read_to_string(at("fits/kr300/robot.toml"))
        .unwrap()
        .parse()
        .unwrap();
    let joint = &robot["joints"][2]["drive"];
    let a3 = joint["stiffness_Nm_rad"].as_float().unwrap();
    assert!((a3 / (0.88 * 4.3e6) - 1.0).abs() < 0.01, "{a3}");
    assert!(
        joint["source"].as_str().unwrap().contains("cubes.csv"),
        "{joint}"
    );
    let elastic = robot["elastic"].as_array().unwrap();
    let arm = elastic
        .iter()
        .find(|e| e["name"].as_str() == Some("linked-arm-y"))
        .unwrap();
    let arm = arm["stiffness_Nm_rad"].as_float().unwrap();
    assert!((arm / (0.8 * 3.8e6) - 1.0).abs() < 0.03, "{arm}");
    let pose = [
        "simulate",
        "deflection",
        "--robot",
        "fits/kr300/robot.toml",
        "--joints-deg",
        "0,-90,90,0,0,0",
        "--force-N",
        "100,0,0",
        "--json",
    ];
    assert_eq!(ident(bench.path(), &pose).status.code(), Some(0));
}

#[test]
fn cubes_and_axis_tests_of_one_campaign_are_compared() {
    let bench = bench("kr300");
    let axes = ["stiffness", "axis1.csv", "axis2.csv", "axis3.csv", "--json"];
    json(&ident(bench.path(), &axes));
    let said = json(&ident(bench.path(), &["stiffness", "cubes.csv", "--json"]));
    let compared = said["axis_tests"].as_array().unwrap();
    let sites: Vec<&str> = compared
        .iter()
        .map(|c| c["site"].as_str().unwrap())
        .collect();
    assert_eq!(sites, ["A1", "A2", "A3"]);
    for own in compared {
        assert!(
            own["difference_percent"].as_f64().unwrap().abs() < 3.0,
            "{own}"
        );
    }
    // in the account too, and the fit of the cubes does not count as an axis test of itself
    let again = ident(bench.path(), &["stiffness", "cubes.csv"]);
    assert!(String::from_utf8_lossy(&again.stdout).contains("axis test"));
    let again = json(&ident(bench.path(), &["stiffness", "cubes.csv", "--json"]));
    assert_eq!(again["axis_tests"], said["axis_tests"]);
}

#[test]
fn a_fit_of_cubes_that_were_changed_since_is_not_used() {
    let bench = bench("kr300");
    json(&ident(bench.path(), &["stiffness", "cubes.csv", "--json"]));
    let path = bench.path().join("measurements/kr300/cubes.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text + "# \n").ok();
    let ran = ident(bench.path(), &["stiffness", "axis1.csv", "--json"]);
    let said = String::from_utf8_lossy(&ran.stderr).to_string();
    assert!(said.contains("cubes.toml is not used"), "{said}");
}

#[test]
fn what_was_hidden_in_cubes_and_sensor_is_named() {
    let bench = bench("kr300");
    let cubes = json(&ident(bench.path(), &["diagnose", "cubes.csv", "--json"]));
    assert_eq!(cubes["verdict"], "explained");
    assert_eq!(
        named(&cubes),
        [
            pair("drive_stiffness", "A3"),
            pair("link_compliance", "linked-arm-y")
        ]
    );
    let weights = json(&ident(bench.path(), &["diagnose", "weights.csv", "--json"]));
    let found = named(&weights);
    assert_eq!(
        found,
        [pair("hose_force", "tool"), pair("sensor_offset", "sensor")]
    );
}

#[test]
fn a_record_is_corrected_with_the_model_that_was_written() {
    let bench = bench("kr300");
    json(&ident(bench.path(), &["sensor", "weights.csv", "--json"]));
    // the same sensor in two of its orientations, pressed by 20 N along its x
    let from =
        std::fs::read_to_string(bench.path().join("measurements/kr300/weights.csv")).unwrap();
    let mut text = String::from("# kind = \"force-sensor\"\n# synthetic = true\n");
    let mut lines = from.lines().filter(|l| !l.starts_with('#'));
    text += &format!("{}\n", lines.next().unwrap());
    for line in lines.take(4) {
        let mut cells: Vec<String> = line.split(',').map(String::from).collect();
        cells[4] = (cells[4].parse::<f64>().unwrap() + 20.0).to_string();
        text += &format!("{}\n", cells.join(","));
    }
    std::fs::write(bench.path().join("record.csv"), text).unwrap();
    let ran = ident(
        bench.path(),
        &[
            "sensor",
            "fits/kr300/weights-sensor.toml",
            "--apply",
            "record.csv",
            "--json",
        ],
    );
    let said = json(&ran);
    let file = said["applied"]["file"].as_str().unwrap();
    let corrected = std::fs::read_to_string(bench.path().join(file)).unwrap();
    let rows = corrected
        .lines()
        .filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
    for row in rows {
        let cells: Vec<f64> = row.split(',').map(|c| c.parse().unwrap()).collect();
        let force = &cells[cells.len() - 6..cells.len() - 3];
        for (found, wanted) in force.iter().zip([20.0, 0.0, 0.0]) {
            assert!((found - wanted).abs() < 1.5, "{row}");
        }
    }
}

#[test]
fn the_screw_of_a_campaign_is_judged_before_and_after_its_table() {
    let bench = bench("dispenser");
    let ran = ident(bench.path(), &["run", "measurements/dispenser", "--json"]);
    let said = json(&ran);
    let verbs: Vec<&str> = said["steps"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| s["verb"].as_str().unwrap())
        .collect();
    assert_eq!(verbs, ["screw", "diagnose"]);
    let ran = ident(
        bench.path(),
        &[
            "screw",
            "x-axis-corrected.csv",
            "--before",
            "x-axis.csv",
            "--json",
        ],
    );
    let said = json(&ran);
    let figure = |v: &Value| v["iso230_2"]["A_um"].as_f64().unwrap();
    assert!(
        figure(&said) < 0.2 * figure(&said["before"]),
        "{} {}",
        figure(&said),
        figure(&said["before"])
    );
    let before = json(&ident(bench.path(), &["screw", "x-axis.csv", "--json"]));
    let holds = |key: &str| {
        let runs = before["motion"]["runs"].as_array().unwrap();
        let run = runs.iter().find(|r| r["correction"] == key).unwrap();
        (
            run["speed_holds"].as_bool().unwrap(),
            run["position_holds"].as_bool().unwrap(),
        )
    };
    assert_eq!(holds("points"), (false, true));
    assert_eq!(holds("quadratics"), (true, true));
}

#[test]
fn what_was_hidden_in_the_screw_is_named() {
    let bench = bench("dispenser");
    let said = json(&ident(bench.path(), &["diagnose", "x-axis.csv", "--json"]));
    let found: Vec<String> = named(&said).into_iter().map(|f| f.0).collect();
    assert_eq!(
        found,
        ["backlash", "cyclic_error", "pitch_scale", "wear_zone"]
    );
    let after = json(&ident(
        bench.path(),
        &["diagnose", "x-axis-corrected.csv", "--json"],
    ));
    let found = named(&after);
    assert!(
        found
            .iter()
            .all(|f| f.0 != "backlash" && f.0 != "pitch_scale"),
        "{found:?}"
    );
}

/// Where the model of a sensor cannot be written no page about it stays behind.
#[test]
fn what_cannot_be_written_whole_is_not_written() {
    let bench = bench("kr300");
    std::fs::write(bench.path().join("fits"), "a file where a folder would be").unwrap();
    let ran = ident(bench.path(), &["sensor", "measurements/kr300/weights.csv"]);
    let said = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(2), "{said}");
    assert!(said.contains("cannot be written"), "{said}");
    let pages = std::fs::read_dir(bench.path().join("reports/kr300"));
    assert_eq!(pages.into_iter().flatten().count(), 0);
}

/// Turned about the vertical alone, a sensor reads the same force along its axis: no dead channel, and weight and offset are one.
#[test]
fn a_sensor_turned_about_the_vertical_alone_is_asked_for_more() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = String::from("# kind = \"force-sensor\"\n# synthetic = true\n");
    text += "point,qw,qx,qy,qz,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm\n";
    for i in 0..12 {
        let half = f64::from(i) * std::f64::consts::PI / 12.0;
        let off = |k: i32| 0.02 * f64::from((7 * i + k) % 5 - 2);
        let [fx, fy, fz] = [1.0, 2.0, -27.0].map(|f| f + off(i));
        let [mx, my, mz] = [0.7, 0.5, 0.3].map(|m| m + 0.1 * off(i + 1));
        let (qw, qz) = (half.cos(), half.sin());
        text += &format!("{i},{qw:.7},0,0,{qz:.7},{fx},{fy},{fz},{mx},{my},{mz}\n");
    }
    std::fs::write(folder.path().join("turned.csv"), text).unwrap();
    let ran = ident(
        folder.path(),
        &["sensor", "turned.csv", "--json", "--dry-run"],
    );
    assert_eq!(ran.status.code(), Some(1));
    let parameters = json(&ran)["parameters"].clone();
    let weight = parameters.as_array().unwrap().iter();
    let weight: Vec<&Value> = weight.filter(|p| p["name"] == "weight").collect();
    assert_eq!(weight[0]["status"], "not-identifiable", "{parameters}");
}
