//! What load cycles are simulated with at present: an earlier fit, or the robot that the file names.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Backlash, width of the hysteresis and seed of one test of A6.
const TESTS: &[(&str, f64, f64, u64)] = &[
    ("before", 2.15e-4, 9.55e-5, 1),
    ("again", 2.15e-4, 9.55e-5, 2),
    ("worn", 3.6e-4, 9.55e-5, 3),
    ("mended", 0.0, 9.55e-5, 4),
];

fn ident(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    command.args(words).current_dir(folder).output().unwrap()
}

/// A bench with the tests of one joint, each in a campaign of its own, without nominal values
/// unless the test puts them there.
fn bench() -> (tempfile::TempDir, PathBuf) {
    let bench = tempfile::tempdir().unwrap();
    let root = bench.path().to_path_buf();
    for (name, gap, width, seed) in TESTS {
        let folder = root.join("measurements").join(name);
        std::fs::create_dir_all(&folder).unwrap();
        let truth = format!(
            "robot = \"kr210\"\nsource = \"synthetic: a test\"\nseed = {seed}\n\
             [[load_cycle]]\nfile = \"{name}.csv\"\njoint = 6\naxis = \"rotation\"\n\
             stiffness_Nm_rad = 314030.0\nload_lever_m = 0.5\nsensor_lever_m = 0.4\n\
             force_N = 1000.0\nschedule = \"growing\"\ncycles = 3\ncycle_s = 20.0\nstep_s = 0.05\n\
             sensor_noise_mm = 0.002\n\
             effects.backlash = {{ gap = {gap:e}, contact_load = 7.5 }}\n\
             effects.hysteresis = {{ width = {width:e}, slip_load = 350, spread = 1.0, tilt = 0.0 }}\n"
        );
        std::fs::write(folder.join("truth.toml"), truth).unwrap();
        let made = ident(&folder, &["lab", "truth.toml"]);
        assert!(
            made.status.success(),
            "{}",
            String::from_utf8_lossy(&made.stderr)
        );
    }
    (bench, root)
}

fn answer(folder: &Path, words: &[&str]) -> Value {
    let words = [&["diagnose", "--dry-run", "--json"], words].concat();
    let output = ident(folder, &words);
    let said = String::from_utf8_lossy(&output.stderr);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{said}"))
}

fn causes(answer: &Value) -> Vec<&str> {
    let causes = answer["causes"].as_array().unwrap();
    causes
        .iter()
        .map(|c| c["effect"].as_str().unwrap())
        .collect()
}

fn rms(answer: &Value) -> f64 {
    answer["discrepancy"]["rms"].as_f64().unwrap()
}

#[test]
fn an_earlier_fit_is_the_present_simulation() {
    let (_keep, root) = bench();
    let file = |name: &str| format!("measurements/{name}/{name}.csv");
    let fitted = ident(&root, &["stiffness", &file("before")]);
    assert!(
        fitted.status.success(),
        "{}",
        String::from_utf8_lossy(&fitted.stderr)
    );
    let fit = "fits/before/before.toml";
    let plain = answer(&root, &[&file("again")]);
    assert_eq!(causes(&plain).len(), 2, "{plain}");
    // the same joint: nothing is new
    let again = answer(&root, &["--model", fit, &file("again")]);
    assert_eq!(again["verdict"], "sufficient", "{again}");
    assert!(rms(&again) < 0.3 * rms(&plain), "{again}");
    assert_eq!(again["present"]["effects"][0], "backlash");
    // a wider gap: it alone is named, with both values
    let worn = answer(&root, &["--model", fit, &file("worn")]);
    assert_eq!(
        (&worn["verdict"], causes(&worn)),
        (&"explained".into(), vec!["backlash"])
    );
    let parameters = worn["causes"][0]["parameters"].as_array().unwrap();
    let value = |name: &str| {
        let found = parameters.iter().find(|p| p["name"] == name).unwrap();
        found["value"].as_f64().unwrap()
    };
    assert!((value("gap") / 3.6e-4 - 1.0).abs() < 0.1, "{worn}");
    assert!(
        (value("value_before") / 2.15e-4 - 1.0).abs() < 0.1,
        "{worn}"
    );
    // no gap any more: it is named with nothing
    let mended = answer(&root, &["--model", fit, &file("mended")]);
    assert_eq!(causes(&mended), ["backlash"], "{mended}");
    let gone = &mended["causes"][0]["parameters"];
    assert_eq!(gone[0]["value"], 0.0);
    assert_eq!(gone[1]["name"], "limit95", "{mended}");
    assert!(gone[1]["value"].as_f64().unwrap() < 2e-5, "{mended}");
    let said = mended["sentence"].as_str().unwrap();
    assert!(said.contains("gap smaller than "), "{said}");
    assert!(!said.contains("0 rad"), "{said}");
}

#[test]
fn a_robot_gives_the_stiffness_that_a_file_does_not_state() {
    let (_keep, root) = bench();
    let path = root.join("measurements/again/again.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    let bare: Vec<&str> = text.lines().filter(|l| !l.contains("nominal")).collect();
    let named = |robot: &str| bare.join("\n").replace("\"kr210\"", robot) + "\n";
    std::fs::write(&path, named("\"kr210\"")).unwrap();
    let built_in = answer(&root, &["measurements/again/again.csv"]);
    assert_eq!(built_in["present"]["from"], "builtin:kr210", "{built_in}");
    assert_eq!(built_in["present"]["stiffness"], 314030.0);
    assert_eq!(causes(&built_in).len(), 2, "{built_in}");
    // with the gap that the joint has, and half as stiff
    let kr210 = ident(&root, &["robot", "convert", "kr210"]);
    let robot: toml::Table = String::from_utf8(kr210.stdout).unwrap().parse().unwrap();
    let changed = |stiffness: f64| {
        let mut robot = robot.clone();
        let drive = robot["joints"][5]["drive"].as_table_mut().unwrap();
        drive.insert("stiffness_Nm_rad".into(), stiffness.into());
        drive.insert("backlash_rad".into(), 2.15e-4.into());
        std::fs::write(root.join("measurements/again/own.toml"), robot.to_string()).unwrap();
        std::fs::write(&path, named("\"own.toml\"")).unwrap();
        answer(&root, &["measurements/again/again.csv"])
    };
    let gapped = changed(314030.0);
    assert_eq!(causes(&gapped), ["hysteresis"], "{gapped}");
    assert!(rms(&gapped) < rms(&built_in));
    let soft = changed(157015.0);
    assert!(rms(&soft) > 5.0 * rms(&gapped), "{soft}");
    assert!(
        !soft["cannot_separate"].as_array().unwrap().is_empty(),
        "{soft}"
    );
}

#[test]
fn a_model_of_something_else_is_refused() {
    let (_keep, root) = bench();
    let fitted = ident(&root, &["stiffness", "measurements/before/before.csv"]);
    assert!(fitted.status.success());
    let fit = root.join("fits/before/before.toml");
    let text = std::fs::read_to_string(&fit).unwrap();
    std::fs::write(root.join("other.toml"), text.replace("\"A6\"", "\"A5\"")).unwrap();
    let again = "measurements/again/again.csv";
    for (fit, file, why) in [
        ("other.toml", again, "was fitted at A5"),
        ("gone.toml", again, "gone.toml"),
        (
            "fits/before/before.toml",
            "measurements/again",
            "folder of a campaign",
        ),
        ("measurements/again/truth.toml", again, "is not a fit"),
    ] {
        let words = ["diagnose", "--dry-run", "--model", fit, file];
        let output = ident(&root, &words);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {said}");
        assert!(said.contains(why), "{said}");
    }
}
