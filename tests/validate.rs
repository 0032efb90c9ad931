//! `ident validate` on campaigns with known truth: contract, coverage, what cannot be separated, the
//! finding of the thesis, bad input, determinism.

use ident::experiments::workspace::Response;
use ident::fit::axis_tests::AxisTest;
use ident::fit::identified_robot::{text, with_axis_tests};
use ident::fit::parameter::Status;
use ident::fit::separability::{Kind, groups, with_foundation};
use ident::fit::validation::{Validation, validate};
use ident::ground::random::Random;
use ident::laboratory::truth::Truth;
use ident::laboratory::workspace::WorkspaceTruth;
use ident::measurement::table::Table;
use ident::measurement::workspace_test::WorkspaceTest;
use ident::robot::file;
use ident::robot::joint_effect::JointEffect;
use ident::robot::{Robot, builtin};
use rayon::prelude::*;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn campaign() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210")
}

fn recipe() -> WorkspaceTruth {
    let truth = Truth::read(&campaign().join("truth.toml")).unwrap();
    truth.workspace.unwrap()
}

fn kr210() -> Robot {
    builtin::named("kr210").unwrap().unwrap()
}

fn read(text: &str) -> WorkspaceTest {
    let table = Table::from_reader(
        Path::new("workspace.csv"),
        text.as_bytes(),
        text.len() as u64,
    );
    WorkspaceTest::from_table(table.unwrap()).unwrap()
}

fn record(recipe: &WorkspaceTruth, truth: &Robot, seed: u64) -> WorkspaceTest {
    read(&recipe.record_with(truth, "kr210", "test", seed).unwrap())
}

/// A folder with the measurement, in which `ident` runs.
fn bench(text: &str) -> tempfile::TempDir {
    let bench = tempfile::tempdir().unwrap();
    let folder = bench.path().join("measurements/demo");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("workspace.csv"), text).unwrap();
    bench
}

fn ident(bench: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    command.current_dir(bench).args(arguments).output().unwrap()
}

fn example() -> String {
    std::fs::read_to_string(campaign().join("workspace.csv")).unwrap()
}

fn document(output: &Output) -> Value {
    assert!(
        output.status.code().is_some_and(|c| c < 2),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_json_keeps_its_contract() {
    let bench = bench(&example());
    let answer = document(&ident(bench.path(), &["validate", "--json"]));
    assert_eq!(answer["schema"], "ident/1");
    assert_eq!(answer["verb"], "validate");
    assert_eq!(answer["inputs"][0]["sha256"].as_str().unwrap().len(), 64);
    let points = answer["points"].as_array().unwrap();
    assert_eq!(points.len(), 27);
    let mut sum = 0.0;
    let mut largest = 0.0_f64;
    for point in points {
        let number = |key: &str| point[key].as_f64().unwrap();
        assert!(point["point"].as_u64().is_some() && point["direction"].as_str().is_some());
        assert!(number("simulated_without_tilt_N_m") > number("simulated_N_m"));
        let error = 100.0 * (number("simulated_N_m") / number("measured_N_m") - 1.0);
        sum += error.abs();
        largest = largest.max(error.abs());
    }
    let close =
        |key: &str, value: f64| assert!((answer[key].as_f64().unwrap() - value).abs() < 1e-9);
    close("mean_abs_error_percent", sum / 27.0);
    close("max_abs_error_percent", largest);
    for parameter in answer["parameters"].as_array().unwrap() {
        let known = parameter["status"] == "identified";
        assert_eq!(
            parameter["value"].is_number() && parameter["ci95"].is_array(),
            known,
            "{parameter}"
        );
        assert_eq!(parameter["unit"], "N·m/rad");
    }
}

/// The same as `ident simulate deflection` says, and the robot it wrote is taken without `--robot`.
#[test]
fn the_simulation_is_that_of_simulate_deflection() {
    let bench = bench(&example());
    let answer = document(&ident(bench.path(), &["validate", "--json"]));
    let posture = "--joints-deg=0.0,-94.8276,108.615,0.0,76.2127,0.0";
    let typed = [
        "simulate",
        "deflection",
        "--json",
        "--force-N=1,0,0",
        posture,
    ];
    let named = document(&ident(
        bench.path(),
        &[&typed[..], &["--robot", "kr210"]].concat(),
    ));
    let simulated = answer["points"][4]["simulated_N_m"].as_f64().unwrap();
    let expected = named["stiffness_N_m"]["yy"].as_f64().unwrap();
    assert!(
        (simulated / expected - 1.0).abs() < 1e-9,
        "{simulated} {expected}"
    );
    let found = ident(bench.path(), &typed);
    assert!(String::from_utf8_lossy(&found.stderr).contains("fits/demo/robot.toml"));
    assert_eq!(
        document(&found)["inputs"][0]["path"],
        "fits/demo/robot.toml"
    );
}

#[test]
fn the_same_input_gives_the_same_bytes_the_second_time_too() {
    let bench = bench(&example());
    let run = || ident(bench.path(), &["validate", "--json"]).stdout;
    let files = || {
        [
            "fits/demo/robot.toml",
            "reports/demo/validate.html",
            "reports/demo/validate-map.svg",
        ]
        .map(|name| std::fs::read(bench.path().join(name)).unwrap())
    };
    let (first, written) = (run(), files());
    assert_eq!(first, run());
    assert_eq!(written, files());
    let truth = recipe();
    let text = || truth.record("kr210", "s", 7).unwrap();
    assert_eq!(text(), text());
}

/// The file in the example campaign is the one that its truth makes.
#[test]
fn the_example_is_made_from_its_truth() {
    let truth = Truth::read(&campaign().join("truth.toml")).unwrap();
    let files = truth.record().unwrap();
    let (_, text) = files
        .iter()
        .find(|(name, _)| name.ends_with("workspace.csv"))
        .unwrap();
    assert_eq!(*text, example());
}

/// A robot whose stiffnesses scatter about the nominal ones as the file states, each repetition anew.
fn scattered(spread: f64, random: &mut Random) -> Robot {
    let mut robot = kr210();
    for (_, spring) in robot.springs_mut() {
        spring.stiffness /= (1.0 + spread * random.normal()).max(0.2);
    }
    robot
}

fn covers(ci95: Option<[f64; 2]>, truth: f64) -> Option<bool> {
    ci95.map(|[low, high]| (low..=high).contains(&truth))
}

fn percent(hits: &[bool]) -> f64 {
    100.0 * hits.iter().filter(|hit| **hit).count() as f64 / hits.len() as f64
}

/// The same, read to full steps, m.
fn coarse(mut test: WorkspaceTest, step: f64) -> WorkspaceTest {
    let each = test.steps.iter_mut().flat_map(|s| &mut s.displacement);
    each.for_each(|d| *d = (*d / step).round() * step);
    test
}

/// Hits of the measured stiffnesses and of the re-identified ones in one repetition.
fn repeat(
    recipe: &WorkspaceTruth,
    seed: u64,
    sensor: impl Fn(WorkspaceTest) -> WorkspaceTest,
) -> (Vec<bool>, Vec<bool>) {
    let truth = scattered(recipe.nominal_stiffness_rel_std, &mut Random::new(seed));
    let test = sensor(record(recipe, &truth, seed + 1_000_000));
    let found = validate(&test, &kr210(), &[]).unwrap();
    let exact = Response::of(&truth, &test.facts.joint_angles);
    let measured = found.comparisons.iter().filter_map(|c| {
        let direction = c.setup.direction;
        covers(
            c.measured.ci95,
            1.0 / exact.matrix(c.setup.point)[direction][direction],
        )
    });
    let parameters = found.refit.parameters();
    let fitted = parameters.iter().filter_map(|p| {
        let (_, spring) = truth.springs().find(|(site, _)| *site == p.site)?;
        covers(p.ci95, spring.stiffness)
    });
    (measured.collect(), fitted.collect())
}

#[test]
fn intervals_cover_as_often_as_they_say() {
    let recipe = recipe();
    let runs: Vec<_> = (0..240)
        .into_par_iter()
        .map(|i| repeat(&recipe, 5000 + i, |test| test))
        .collect();
    let measured: Vec<bool> = runs.iter().flat_map(|r| r.0.clone()).collect();
    let fitted: Vec<bool> = runs.iter().flat_map(|r| r.1.clone()).collect();
    let (a, b) = (percent(&measured), percent(&fitted));
    println!(
        "240 campaigns: {} point stiffnesses covered {a:.1} %, {} re-identified {b:.1} %",
        measured.len(),
        fitted.len()
    );
    assert!(
        (92.0..=98.0).contains(&a) && (92.0..=98.0).contains(&b),
        "{a} {b}"
    );
    assert!(fitted.len() > 2 * 240);
}

/// Seven deviations of the noise to a step: rounding is the same in every cycle, and no reading is wild for it.
#[test]
fn intervals_cover_where_the_sensor_is_coarse() {
    let recipe = recipe();
    let read = |test| coarse(test, 20e-6);
    let runs: Vec<_> = (0..40)
        .into_par_iter()
        .map(|i| repeat(&recipe, 9000 + i, read))
        .collect();
    let measured: Vec<bool> = runs.iter().flat_map(|r| r.0.clone()).collect();
    let fitted: Vec<bool> = runs.iter().flat_map(|r| r.1.clone()).collect();
    let (a, b) = (percent(&measured), percent(&fitted));
    assert!(a >= 92.0 && b >= 92.0, "{a} {b}");
    assert!(fitted.len() > 2 * 40);
    let truth = scattered(0.0, &mut Random::new(1));
    let test = read(record(&recipe, &truth, 17));
    let found = validate(&test, &kr210(), &[]).unwrap();
    let lines = found.comparisons.iter().flat_map(|c| c.setup.lines);
    assert_eq!(lines.flatten().map(|line| line.wild).sum::<usize>(), 0);
}

fn sites_of(found: &Validation, kind: Kind) -> Vec<Vec<String>> {
    let own = found.groups.iter().filter(|group| group.kind == kind);
    own.map(|group| group.sites.clone()).collect()
}

fn holds(groups: &[Vec<String>], wanted: [&str; 2]) -> bool {
    groups
        .iter()
        .any(|sites| wanted.iter().all(|site| sites.iter().any(|s| s == site)))
}

#[test]
fn foundation_about_z_is_not_told_from_drive_a1() {
    let found = validate(&record(&recipe(), &kr210(), 3), &kr210(), &[]).unwrap();
    assert!(holds(&sites_of(&found, Kind::Exact), ["A1", "base-z"]));
    let invisible = sites_of(&found, Kind::Unloaded);
    assert!(
        invisible.iter().any(|sites| sites == &["A6"]),
        "the tool lies on A6: {invisible:?}"
    );
    let a6 = found
        .refit
        .parameters()
        .into_iter()
        .find(|p| p.site == "A6")
        .unwrap();
    assert_eq!((a6.status, a6.value), (Status::NotIdentifiable, None));
}

/// With the wrist straight and the tool beside A6, its drive turns about the line of an A5 tilt axis.
#[test]
fn a6_drive_and_a5_tilt_about_one_line_are_named() {
    let mut robot = kr210();
    robot.tool.tcp[2] -= 0.3;
    let mut recipe = recipe();
    recipe.tcp_m = Vec::new();
    let posture = |i: usize| {
        vec![
            10.0 * i as f64 - 40.0,
            -90.0 + 3.0 * i as f64,
            100.0,
            20.0 * i as f64,
            0.0,
            15.0,
        ]
    };
    recipe.joint_angles_deg = (0..9).map(posture).collect();
    let test = record(&recipe, &robot, 4);
    let found = validate(&test, &robot, &[]).unwrap();
    let exact = sites_of(&found, Kind::Exact);
    assert!(holds(&exact, ["A5-tilt", "A6"]), "{exact:?}");
    recipe
        .joint_angles_deg
        .iter_mut()
        .enumerate()
        .for_each(|(i, q)| q[4] = 30.0 + 5.0 * i as f64);
    let bent = record(&recipe, &robot, 4);
    let found = validate(&bent, &robot, &[]).unwrap();
    assert!(!holds(&sites_of(&found, Kind::Exact), ["A5-tilt", "A6"]));
    let wide = Response::of(&with_foundation(&robot), &bent.facts.joint_angles);
    assert!(!groups(&wide, &found.refit.weighing).is_empty());
}

/// Source 000, section 3.3: the virtual axes are what makes the simulation agree, above all in y.
#[test]
fn without_tilt_the_finding_of_the_thesis_shows() {
    let found = validate(&record(&recipe(), &kr210(), 5), &kr210(), &[]).unwrap();
    let (with, _) = found.errors(|c| c.simulated).unwrap();
    let (without, _) = found.errors(|c| c.without_tilt).unwrap();
    let [x, y, z] = [0, 1, 2].map(|d| found.tilt_ratio(d).unwrap());
    println!("error {with:.1} % with tilt, {without:.0} % without; ratios {x:.2} {y:.2} {z:.2}");
    assert!(with < 3.0 && without > 50.0);
    assert!((2.5..4.0).contains(&y) && y > x && y > z);
    let rigid = found.rigid_bearings.unwrap();
    assert!(
        found.refit.p_value > 1e-3 && rigid.p_value < 1e-12,
        "drives alone cannot explain the points"
    );
}

/// What an axis test found of a joint's loop goes along into the identified robot and loads back; a spring
/// that gives less than its contacts hold back goes without.
#[test]
fn the_identified_robot_carries_the_loop_of_its_axis_test() {
    let effect = JointEffect::new("hysteresis", vec![9.7e-5, 348.0, 1.1, -0.4]).unwrap();
    let carried = |stiffness: f64| {
        let test = AxisTest {
            effects: vec![effect.clone()],
            ..axis_test(stiffness)
        };
        let robot = with_axis_tests(&kr210(), &[test]);
        let back = file::read(&text(&robot, "builtin:kr210", true)).unwrap();
        let (_, spring) = back.springs().find(|(site, _)| site == "A6").unwrap();
        spring.effects.clone()
    };
    assert_eq!(carried(3.0e5), vec![effect.clone()]);
    assert_eq!(carried(3.0e9), vec![]);
}

fn axis_test(stiffness: f64) -> AxisTest {
    AxisTest {
        site: "A6".into(),
        path: "axis6.toml".into(),
        sha256: String::new(),
        input: ("axis6.csv".into(), "0123".into()),
        stiffness: (stiffness, 0.01 * stiffness),
        ci95: [0.98 * stiffness, 1.02 * stiffness],
        backlash: None,
        effects: Vec::new(),
    }
}

/// What the axis tests measured is the prior; where the points add nothing it stands unchanged.
#[test]
fn axis_tests_are_the_prior() {
    let test = axis_test(3.0e5);
    let found = validate(&record(&recipe(), &kr210(), 6), &kr210(), &[test]).unwrap();
    let a6 = found
        .refit
        .parameters()
        .into_iter()
        .find(|p| p.site == "A6")
        .unwrap();
    assert_eq!(a6.status, Status::Identified);
    assert!((a6.value.unwrap() / 3.0e5 - 1.0).abs() < 1e-6);
}

#[test]
fn missing_components_and_wild_readings_are_left_out_and_counted() {
    let text = example();
    let mut lines: Vec<String> = text.lines().map(str::to_string).collect();
    let first = lines
        .iter()
        .position(|l| l.starts_with("1,x,1,150"))
        .unwrap();
    lines[first] = "1,x,1,150.0,9.0,0.07443,".into();
    let spoilt = |line: &String| match line.starts_with("2,y,") {
        true => line.split(',').take(4).collect::<Vec<_>>().join(",") + ",,,0.1",
        false => line.clone(),
    };
    let text = lines.iter().map(spoilt).collect::<Vec<_>>().join("\n");
    let bench = bench(&(text + "\n"));
    let output = ident(bench.path(), &["validate", "--json"]);
    assert_eq!(
        output.status.code(),
        Some(1),
        "a direction without stiffness needs attention"
    );
    let answer = document(&output);
    assert_eq!(answer["points"][0]["readings_left_out"], 1);
    let silent = &answer["points"][4];
    assert_eq!(
        (&silent["measured_N_m"], &silent["status"]),
        (&Value::Null, &Value::from("not-identifiable"))
    );
    assert!(silent["simulated_N_m"].is_number());
}

#[test]
fn bad_input_is_refused_with_place_and_remedy() {
    let good = example();
    let swap = |from: &str, to: &str| good.replacen(from, to, 1);
    let row = good
        .lines()
        .position(|l| l.starts_with("1,x,1,0.0"))
        .unwrap()
        + 1;
    let cases = [
        (
            swap("kind = \"workspace\"", "kind = \"load-cycle\""),
            ":1: ",
            "not `workspace`",
        ),
        (
            swap("# robot = \"kr210\"\n", ""),
            ":1: ",
            "`robot` is missing",
        ),
        (
            swap("robot = \"kr210\"", "robot = \"none.toml\""),
            "none.toml",
            "no built-in robot",
        ),
        (
            swap("joint_angles_deg", "angles"),
            "`angles`",
            "is not a fact of this kind",
        ),
        (
            swap("[0.0, -94.8276, 108.615,", "[0.0, -94.8276,"),
            ":8: ",
            "row 2 has 5 angles",
        ),
        (
            swap("setup_repeatability = 0.015", "setup_repeatability = 1.5"),
            ":6: ",
            "fraction",
        ),
        (swap("dx_mm", "dx_N"), "`dx_N`", "expected length"),
        (swap("force_N", "load_N"), "", "no column `force_N`"),
        (
            swap("1,x,1,0.0", "1,u,1,0.0"),
            &format!(":{row}: "),
            "no direction",
        ),
        (
            swap("1,x,1,0.0", "10,x,1,0.0"),
            &format!(":{row}: "),
            "point 10",
        ),
        (
            swap("1,x,1,0.0", "1.5,x,1,0.0"),
            &format!(":{row}: "),
            "point 1.5",
        ),
        (
            swap("1,x,1,0.0", "1,x,1,abc"),
            &format!(":{row}: "),
            "not a number",
        ),
    ];
    for (text, place, says) in cases {
        let bench = bench(&text);
        let output = ident(
            bench.path(),
            &["validate", "measurements/demo/workspace.csv"],
        );
        let said = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{says}: {said}");
        assert!(
            said.contains(place) && said.contains(says) && said.contains("help:"),
            "{says}: {said}"
        );
        assert!(!bench.path().join("fits").exists());
    }
}

#[test]
fn the_campaign_is_found_or_asked_for() {
    let bench = bench(&example());
    let folder = bench.path().join("measurements/other");
    std::fs::create_dir_all(&folder).unwrap();
    let asked = ident(bench.path(), &["validate"]);
    assert_eq!(asked.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&asked.stderr).contains("demo, other"));
    assert_eq!(
        ident(bench.path(), &["validate", "--campaign", "demo"])
            .status
            .code(),
        Some(0)
    );
    assert_eq!(
        ident(bench.path(), &["validate", "--campaign", "other"])
            .status
            .code(),
        Some(2)
    );
    let nowhere = tempfile::tempdir().unwrap();
    assert_eq!(ident(nowhere.path(), &["validate"]).status.code(), Some(2));
}

/// One cycle of two levels fits every line exactly; the stated noise stands in for the scatter.
#[test]
fn two_levels_of_one_cycle_give_stiffness_by_the_stated_noise() {
    let mut seen = std::collections::BTreeSet::new();
    let mut kept = |line: &&str| {
        let cells: Vec<&str> = line.split(',').collect();
        let level = cells.get(3).copied().unwrap_or_default();
        let row = line.starts_with(|c: char| c.is_ascii_digit());
        let first = ["0.0", "750.0"].contains(&level) && cells[2] == "1";
        !row || (first && seen.insert(cells[..4].join(",")))
    };
    let text = example();
    let text: Vec<&str> = text.lines().filter(|line| kept(line)).collect();
    let bench = bench(&(text.join("\n") + "\n"));
    let output = ident(bench.path(), &["validate", "--json", "--dry-run"]);
    let said: Value = serde_json::from_slice(&output.stdout).unwrap();
    let points = said["points"].as_array().unwrap();
    assert_eq!(points.len(), 27);
    for point in points {
        assert_eq!(point["rows"], 2);
        assert_eq!(point["status"], "identified", "{point}");
    }
}
