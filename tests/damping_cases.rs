//! `ident damping` beyond the example: several poses, a released tool, elastic frames, universal files,
//! priors, and tests whose sensors or structure are not what they should be. The hits come from time
//! integration of the robot, which shares no code with spectra, linearised model or tuning.

use ident::ground::units::DEGREE;
use ident::laboratory::truth::Truth;
use ident::measurement::hammer::read_hammer;
use ident::measurement::uff::{
    self, Abscissa, Axis, Dof, Encoding, Function, Kind, Quantity, UniversalFile, Values,
};
use ident::robot::{load, write};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

fn example(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210");
    folder.join(name)
}

/// Exit status, document (null without one) and what was said, with three starts: `frf_starts` asks
/// whether more find another place.
fn damping(folder: &Path, arguments: &[&str]) -> (i32, Value, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_ident"))
        .current_dir(folder)
        .args(
            [
                &["damping", "--json", "--dry-run", "--starts", "3", "--frf"],
                arguments,
            ]
            .concat(),
        )
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).to_string();
    let document = serde_json::from_slice(&output.stdout).unwrap_or(Value::Null);
    (output.status.code().unwrap(), document, said)
}

fn found(folder: &Path, arguments: &[&str]) -> Value {
    let (status, document, said) = damping(folder, arguments);
    assert!(status < 2, "{said}");
    document
}

/// A hammer test of `robot` as its file has it, every damping times `factor`.
fn strike(robot: &str, joints_deg: [f64; 6], factor: f64) -> (String, BTreeMap<String, f64>) {
    let mut truth = Truth::read(&example("truth.toml")).unwrap();
    truth.robot = robot.into();
    truth.load_cycle.clear();
    truth.workspace = None;
    let hammer = truth.hammer.as_mut().unwrap();
    hammer.file.truncate(1);
    (hammer.double, hammer.overloaded) = (None, None);
    hammer.joint_angles_deg = joints_deg.to_vec();
    let springs = load(robot, None).unwrap().robot;
    hammer.damping = springs
        .springs()
        .map(|(site, spring)| (site, factor * spring.damping))
        .collect();
    let dampings = hammer.damping.clone();
    let files = truth.record().unwrap();
    let made = files.iter().find(|f| f.0.as_os_str() == "hammer.csv");
    (made.unwrap().1.clone(), dampings)
}

const POSE: [f64; 6] = [20.0, -75.0, 100.0, 30.0, 45.0, 15.0];
const OTHER: [f64; 6] = [-25.0, -50.0, 85.0, -60.0, -70.0, 100.0];

fn parameters(document: &Value) -> Vec<Value> {
    document["parameters"].as_array().unwrap().clone()
}

fn interval(parameter: &Value) -> [f64; 2] {
    [0, 1].map(|i| parameter["ci95"][i].as_f64().unwrap())
}

fn is_identified(parameter: &Value) -> bool {
    parameter["status"] == "identified"
}

/// Identified dampings, and how many of their intervals hold the truth.
fn held(document: &Value, truth: &BTreeMap<String, f64>) -> (usize, usize) {
    let identified: Vec<Value> = parameters(document)
        .into_iter()
        .filter(is_identified)
        .collect();
    let holds = |p: &&Value| {
        let [low, high] = interval(p);
        (low..=high).contains(&truth[p["site"].as_str().unwrap()])
    };
    (identified.len(), identified.iter().filter(holds).count())
}

fn frac_of_all(document: &Value) -> f64 {
    let pairs = document["match"].as_object().unwrap().values();
    pairs
        .map(|m| m["frac"].as_f64().unwrap())
        .fold(1.0, f64::min)
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn several_poses_fix_more_than_one() {
    let folder = tempfile::tempdir().unwrap();
    let (first, truth) = strike("kr210", POSE, 1.3);
    let (second, _) = strike("kr210", OTHER, 1.3);
    std::fs::write(folder.path().join("a.csv"), first).unwrap();
    std::fs::write(folder.path().join("b.csv"), second).unwrap();
    let one = found(folder.path(), &["a.csv"]);
    let both = found(folder.path(), &["a.csv", "b.csv"]);
    assert_eq!(both["poses"].as_array().unwrap().len(), 2);
    assert_eq!(both["frf"]["hits_used"], 30);
    let (identified, inside) = held(&both, &truth);
    println!("{inside} of {identified} inside");
    assert!(identified == 12 && inside >= 11);
    assert!(frac_of_all(&both) > 0.99);
    let width = |p: &Value| interval(p)[1] - interval(p)[0];
    for (one, both) in parameters(&one).iter().zip(&parameters(&both)) {
        let narrower = !is_identified(one) || width(both) < 1.05 * width(one);
        assert!(narrower, "{one} {both}");
    }
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn the_mass_of_the_tool_is_found_when_released() {
    let folder = tempfile::tempdir().unwrap();
    let (file, _) = strike("kr210", POSE, 1.0);
    // without these facts the bodies would be fitted along, and hold the wrong mass
    let exact = "# mass_rel_std = 0.0\n# com_std_m = 0.0\n# inertia_rel_std = 0.0\n";
    std::fs::write(folder.path().join("a.csv"), format!("{exact}{file}")).unwrap();
    let mut robot = load("kr210", None).unwrap().robot;
    let body = robot.tool.body.as_mut().unwrap();
    let truth = body.mass;
    body.mass *= 1.12;
    body.inertia = body.inertia.map(|i| 1.12 * i);
    std::fs::write(folder.path().join("heavy.toml"), write::write(&robot)).unwrap();
    let wrong = found(folder.path(), &["a.csv", "--robot", "heavy.toml"]);
    let document = found(
        folder.path(),
        &["a.csv", "--robot", "heavy.toml", "--release-mass"],
    );
    let all = parameters(&document);
    let mass = all.iter().find(|p| p["name"] == "mass").unwrap();
    assert_eq!(
        (&mass["site"], &mass["unit"]),
        (&"tool".into(), &"kg".into())
    );
    let [low, high] = interval(mass);
    println!("mass {low} .. {high} kg, truth {truth} kg");
    assert!((low..=high).contains(&truth));
    let chi = |d: &Value| d["fit"]["reduced_chi_square"].as_f64().unwrap();
    println!("chi² {} released, {} not", chi(&document), chi(&wrong));
    assert!(chi(&document) < 1.3 && chi(&wrong) > 5.0 * chi(&document));
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn elastic_frames_are_tuned_like_joints() {
    let folder = tempfile::tempdir().unwrap();
    let (file, truth) = strike("kr300", [15.0, -80.0, 95.0, 40.0, 50.0, -30.0], 1.5);
    std::fs::write(folder.path().join("a.csv"), file).unwrap();
    let document = found(folder.path(), &["a.csv"]);
    let all = parameters(&document);
    assert_eq!(all.len(), truth.len());
    for name in ["arm-y", "linked-arm-z", "sensor-x"] {
        assert!(all.iter().any(|p| p["site"] == name), "{name}");
    }
    for open in all.iter().filter(|p| !is_identified(p)) {
        assert!(open["value"].is_null() && open["ci95"].is_null() && open["stderr"].is_null());
    }
    let (identified, inside) = held(&document, &truth);
    println!("{inside} of {identified} inside, {} constants", all.len());
    assert!(inside as f64 >= 0.85 * identified as f64);
    assert!(frac_of_all(&document) > 0.99);
    assert!(
        !document["fixed_combinations"]
            .as_array()
            .unwrap()
            .is_empty()
    );
}

/// The records of a CSV file as a universal file.
fn universal(path: &Path) -> UniversalFile {
    let record = read_hammer(path).unwrap();
    let dof = |direction| Dof {
        entity: "NONE".into(),
        node: 1,
        direction,
    };
    let code = |name: &str| ["x", "y", "z"].iter().position(|n| *n == name).unwrap() as i64 + 1;
    let function = |quantity, name: &str, values: &[f64]| Function {
        id: std::array::from_fn(|_| "NONE".into()),
        kind: Kind::Time,
        numbers: [0, 1, 0],
        response: dof(code(name)),
        reference: dof(0),
        abscissa: Abscissa::Even {
            start: 0.0,
            step: record.interval_s,
        },
        values: Values::Real(values.to_vec()),
        double: true,
        z: 0.0,
        axes: [
            Axis::new(Quantity::Time, "Time", "s"),
            Axis::new(quantity, "NONE", "NONE"),
            Axis::none(),
            Axis::none(),
        ],
    };
    let run = |run: &ident::measurement::hammer::HammerRun| {
        let force = function(Quantity::ExcitationForce, &run.direction, &run.force);
        let responses = record.outputs.iter().zip(&run.responses);
        let responses = responses.map(|(name, r)| function(Quantity::Acceleration, name, r));
        std::iter::once(force).chain(responses).collect::<Vec<_>>()
    };
    UniversalFile {
        functions: record.runs.iter().flat_map(run).collect(),
        ..UniversalFile::default()
    }
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn universal_files_give_what_the_csv_gives() {
    let folder = tempfile::tempdir().unwrap();
    let csv = example("hammer.csv");
    std::fs::copy(&csv, folder.path().join("a.csv")).unwrap();
    let file = universal(&csv);
    for (name, encoding) in [("a.uff", Encoding::Binary), ("b.unv", Encoding::Ascii)] {
        std::fs::write(folder.path().join(name), uff::write(&file, encoding)).unwrap();
    }
    let wanted = parameters(&found(folder.path(), &["a.csv"]));
    let pose = POSE.map(|q| q.to_string()).join(",");
    for name in ["a.uff", "b.unv"] {
        let document = found(
            folder.path(),
            &[name, "--robot", "kr210", "--joints-deg", &pose],
        );
        for (a, b) in wanted.iter().zip(&parameters(&document)) {
            let values = [a, b].map(|p| p["value"].as_f64().unwrap());
            assert!((values[0] / values[1] - 1.0).abs() < 1e-6, "{a} {b}");
        }
    }
    let (status, _, said) = damping(folder.path(), &["a.uff", "--robot", "kr210"]);
    assert!(status == 2 && said.contains("--joints-deg"), "{said}");
    let (status, _, said) = damping(folder.path(), &["a.csv", "--joints-deg", &pose]);
    assert!(status == 2 && said.contains("states its pose"), "{said}");
    let (status, _, said) = damping(
        folder.path(),
        &["a.uff", "--robot", "kr210", "--joints-deg", "1,2"],
    );
    assert!(status == 2 && said.contains("2 joint angles"), "{said}");
}

/// The example with hits along z alone.
fn only_z(folder: &Path) {
    let text = std::fs::read_to_string(example("hammer.csv")).unwrap();
    let wanted = |l: &&str| !(l.starts_with("x,") || l.starts_with("y,"));
    let text: Vec<&str> = text.lines().filter(wanted).collect();
    std::fs::write(folder.join("z.csv"), text.join("\n") + "\n").unwrap();
}

#[test]
fn a_prior_is_stated_and_says_what_it_fixes() {
    let folder = tempfile::tempdir().unwrap();
    only_z(folder.path());
    // springs alone are asked about here: bodies fitted along have priors of their own
    let path = folder.path().join("z.csv");
    let file = std::fs::read_to_string(&path).unwrap();
    let exact = "# mass_rel_std = 0.0\n# com_std_m = 0.0\n# inertia_rel_std = 0.0\n";
    std::fs::write(&path, format!("{exact}{file}")).unwrap();
    let arguments = ["z.csv", "--release-stiffness", "--to-Hz", "30"];
    let free = found(folder.path(), &arguments);
    let held = found(
        folder.path(),
        &[&arguments[..], &["--prior", "1.2"]].concat(),
    );
    let known = |d: &Value| parameters(d).iter().filter(|p| is_identified(p)).count();
    println!(
        "identified {} without, {} with prior",
        known(&free),
        known(&held)
    );
    assert!(known(&free) < known(&held));
    assert_eq!(held["priors"].as_array().unwrap().len(), 24);
    for prior in held["priors"].as_array().unwrap().iter().take(12) {
        let spread = prior["relative_std"].as_f64().unwrap();
        assert!((spread - 1.2f64.ln()).abs() < 1e-9);
    }
    let by_prior = |d: &Value| {
        let said = |p: &&Value| p["meaning"].as_str().unwrap().contains("by its prior");
        parameters(d).iter().filter(said).count()
    };
    assert!(by_prior(&held) > 0);
}

/// The robot's own value of a constant, and the true one, SI.
fn constants(site: &str, name: &str) -> [f64; 2] {
    let truth = Truth::read(&example("truth.toml")).unwrap();
    let hammer = truth.hammer.as_ref().unwrap();
    let after = hammer.robot("kr210", &truth.load_cycle, false).unwrap();
    let before = load("kr210", None).unwrap().robot;
    [&before, &after].map(|robot| {
        let (_, spring) = robot.springs().find(|(s, _)| s == site).unwrap();
        match name {
            "damping" => spring.damping,
            _ => spring.stiffness,
        }
    })
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn one_direction_invents_nothing_and_its_combinations_hold_the_truth() {
    let folder = tempfile::tempdir().unwrap();
    only_z(folder.path());
    for more in [&[][..], &["--release-stiffness"], &["--to-Hz", "20"]] {
        let document = found(folder.path(), &[&["z.csv"], more].concat());
        for p in parameters(&document) {
            let known = is_identified(&p);
            let stated = ["identified", "at-bound", "not-identifiable"];
            assert!(stated.iter().any(|s| p["status"] == *s), "{p}");
            for key in ["value", "stderr", "ci95"] {
                assert_eq!(p[key].is_null(), !known, "{p}");
            }
        }
        let fixed = document["fixed_combinations"].as_array().unwrap();
        let off = fixed.iter().map(|one| {
            let factors = one["factors"].as_array().unwrap().iter();
            let truth: f64 = factors
                .map(|f| {
                    let [site, name] = ["site", "name"].map(|key| f[key].as_str().unwrap());
                    let [before, after] = constants(site, name);
                    f["exponent"].as_f64().unwrap() * (after / before).ln()
                })
                .sum();
            let found = one["times_before"].as_f64().unwrap().ln();
            let off = (found - truth) / one["relative_stderr"].as_f64().unwrap();
            println!(
                "{more:?}: {} is off by {off:.2} standard errors",
                one["product"]
            );
            off.abs()
        });
        let off: Vec<f64> = off.collect();
        let inside = off.iter().filter(|off| **off < 1.96).count();
        assert!(!off.is_empty() && inside as f64 >= 0.8 * off.len() as f64);
        assert!(off.iter().all(|off| *off < 4.0));
    }
}

/// The remarks on the example with one column of one direction multiplied.
fn remarks(direction: &str, column: usize, factor: f64) -> String {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(example("hammer.csv")).unwrap();
    let spoilt = text.lines().map(|line| {
        let mut cells: Vec<String> = line.split(',').map(String::from).collect();
        let wanted = direction.is_empty() || cells[0] == direction;
        let number = cells.get(column).and_then(|cell| cell.parse::<f64>().ok());
        if let (true, Some(value)) = (wanted && !line.starts_with('#'), number) {
            cells[column] = (factor * value).to_string();
        }
        cells.join(",")
    });
    let spoilt: Vec<String> = spoilt.collect();
    std::fs::write(folder.path().join("a.csv"), spoilt.join("\n") + "\n").unwrap();
    let (status, document, said) = damping(folder.path(), &["a.csv"]);
    assert_eq!(status, 1, "{said}");
    assert!(said.contains("note:"), "{said}");
    document["remarks"].to_string()
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn broken_reciprocity_and_a_turned_sensor_are_shown() {
    let not_reciprocal = remarks("y", 4, 1.6);
    assert!(
        not_reciprocal.contains("H_xy and H_yx differ"),
        "{not_reciprocal}"
    );
    let turned = remarks("", 6, -1.0);
    assert!(
        turned.contains("az: the driving point gives out power"),
        "{turned}"
    );
}

#[test]
fn the_pose_is_read_in_degrees() {
    let record = read_hammer(&example("hammer.csv")).unwrap();
    let angles = record.joint_angles.unwrap();
    assert!(
        angles
            .iter()
            .zip(POSE)
            .all(|(a, b)| (a - b * DEGREE).abs() < 1e-12)
    );
}
