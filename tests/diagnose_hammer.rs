//! `ident diagnose` of hammer tests: the example campaign, hidden causes, and what is refused.

use ident::findings::hammer::{Diagnosis, diagnose};
use ident::findings::{Answer, Verdict};
use ident::measurement::hammer::{HammerRecord, read_hammer};
use ident::robot::load::load;
use ident::robot::{Robot, file, write::write};
use std::path::Path;
use std::process::{Command, Output};

const EXAMPLE: &str = "measurements/kr210/hammer.csv";

fn example() -> HammerRecord {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(EXAMPLE);
    read_hammer(&path).unwrap()
}

/// The robot that was struck in the example: its dampings stand in `truth.toml`.
fn struck() -> Robot {
    let truth = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210/truth.toml");
    let truth: toml::Table = std::fs::read_to_string(truth).unwrap().parse().unwrap();
    let mut robot = load("kr210", None).unwrap().robot;
    let dampings = truth["hammer"]["damping_Nms_rad"].as_table().unwrap();
    for (site, spring) in robot.springs_mut() {
        spring.damping = dampings[&site].as_float().unwrap();
    }
    robot
}

fn named(answer: &Answer) -> Vec<(&str, &str)> {
    let causes = answer.causes.iter();
    let causes = causes.map(|c| (c.effect, c.site.as_str()));
    let groups = answer.groups.iter().flat_map(|group| {
        let sites = group.sites.iter().map(String::as_str);
        group.effects.iter().copied().zip(sites)
    });
    causes.chain(groups).collect()
}

/// The truth is among what is named, and with it at most two that cannot be told from it.
fn finds(found: &Diagnosis, effect: &str, site: &str) {
    let all = named(&found.answer);
    assert!(all.contains(&(effect, site)), "{all:?}");
    assert!(all.len() <= 3, "{all:?}");
    assert!(found.answer.causes.iter().all(|c| c.gain.is_real()));
}

#[test]
fn the_robot_that_was_struck_is_sufficient() {
    let found = diagnose(&example(), &struck()).unwrap();
    let answer = &found.answer;
    assert_eq!(answer.verdict, Verdict::Sufficient, "{:?}", named(answer));
    assert!(answer.discrepancy.rms < 10.0 * answer.discrepancy.noise_rms);
    assert!(found.extended.is_none());
}

#[test]
fn a_wrong_stiffness_is_named_with_its_place_and_size() {
    let mut robot = struck();
    for (site, spring) in robot.springs_mut() {
        spring.stiffness *= if site == "A2" { 1.6 } else { 1.0 };
    }
    let truth = struck().joints[1].drive.as_ref().unwrap().stiffness;
    let found = diagnose(&example(), &robot).unwrap();
    finds(&found, "drive_stiffness", "A2");
    let (name, value, _) = found.answer.causes[0].parameters[0];
    assert_eq!(name, "stiffness");
    assert!((value / truth - 1.0).abs() < 0.1, "{value:e}");
    let extended = found.extended.unwrap();
    let again = file::read(&write(&extended)).unwrap();
    assert_eq!(again, extended);
    assert!(
        again
            .notes
            .iter()
            .any(|note| note.contains("drive_stiffness at A2"))
    );
}

/// Of one hit a direction none can be left out, and no scatter is known: lines are.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_wrong_stiffness_is_named_by_one_hit_a_direction() {
    let mut robot = struck();
    for (site, spring) in robot.springs_mut() {
        spring.stiffness *= if site == "A2" { 1.6 } else { 1.0 };
    }
    let mut record = example();
    let mut seen = Vec::new();
    record.runs.retain(|run| {
        let is_first = !seen.contains(&run.direction);
        seen.push(run.direction.clone());
        is_first
    });
    assert_eq!(record.runs.len(), 3);
    let found = diagnose(&record, &robot).unwrap();
    finds(&found, "drive_stiffness", "A2");
    let sound = diagnose(&record, &struck()).unwrap();
    assert!(
        named(&sound.answer).is_empty(),
        "{:?}",
        named(&sound.answer)
    );
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_missing_tilt_is_named() {
    let mut robot = struck();
    robot.joints[2].tilt = None;
    let found = diagnose(&example(), &robot).unwrap();
    finds(&found, "missing_tilt", "A3-tilt");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn an_instrument_is_blamed_for_its_own_faults() {
    let mut record = example();
    for run in &mut record.runs {
        for response in &mut run.responses {
            response.rotate_right(3);
            response[..3].fill(0.0);
        }
    }
    finds(
        &diagnose(&record, &struck()).unwrap(),
        "time_skew",
        "sensor",
    );
    let mut record = example();
    for run in &mut record.runs {
        run.responses[1].iter_mut().for_each(|a| *a *= 1.2);
    }
    finds(
        &diagnose(&record, &struck()).unwrap(),
        "accelerometer_gain",
        "sensor-y",
    );
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn an_undeclared_window_is_no_damping() {
    let mut record = example();
    let step = record.interval_s;
    let window = |i: usize| (-1.5 * i as f64 * step).exp();
    for run in &mut record.runs {
        let channels = run
            .responses
            .iter_mut()
            .chain(std::iter::once(&mut run.force));
        channels.for_each(|c| c.iter_mut().enumerate().for_each(|(i, x)| *x *= window(i)));
    }
    finds(
        &diagnose(&record, &struck()).unwrap(),
        "exponential_window",
        "sensor",
    );
    record.exponential_window_s = Some(1.0 / 1.5);
    let declared = diagnose(&record, &struck()).unwrap().answer;
    assert_eq!(
        declared.verdict,
        Verdict::Sufficient,
        "{:?}",
        named(&declared)
    );
}

fn ident(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ident"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

#[test]
fn the_example_with_assumed_dampings_speaks_of_dampings() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = ident(&["diagnose", EXAMPLE, "--dry-run", "--json"], folder);
    assert_eq!(output.status.code(), Some(1));
    let said: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(said["kind"], "hammer");
    assert_eq!(said["discrepancy"]["unit"], "(m/s²)/N");
    assert_eq!(said["hits_rejected"].as_array().unwrap().len(), 2);
    let lists = ["causes", "cannot_separate"].map(|key| said[key].to_string());
    assert!(lists.concat().contains("joint_damping"), "{said}");
}

#[test]
fn what_is_missing_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let text =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(EXAMPLE)).unwrap();
    let cases = [
        ("# robot = \"kr210\"\n", "", "names no robot"),
        (
            "# joint_angles_deg = [20.0, -75.0, 100.0, 30.0, 45.0, 15.0]\n",
            "",
            "at which pose",
        ),
        ("45.0, 15.0]", "45.0]", "5 joint angles"),
        ("\"kr210\"", "\"nobody\"", "no built-in robot"),
    ];
    for (from, to, said) in cases {
        std::fs::write(folder.path().join("h.csv"), text.replace(from, to)).unwrap();
        let output = ident(&["diagnose", "h.csv", "--dry-run"], folder.path());
        let error = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(said) && error.contains("help:"), "{error}");
    }
}
