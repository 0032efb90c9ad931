//! Rule 1: no number and no cause without data that can carry it.

use crate::bench_of_files::{Bench, document};
use crate::honest::benches;
use crate::honest::file::{File, noise};
use serde_json::Value;

fn ran(verb: &str, file: &File) -> (i32, Value) {
    let bench = Bench::new();
    bench.put("a.csv", file.text().as_bytes());
    let ran = bench.run(&[verb, "--json", "--dry-run", "a.csv"]);
    assert!(ran.status < 2, "{verb}: {}", ran.errors);
    (ran.status, document(&ran))
}

fn rules(document: &Value) -> Vec<String> {
    let doubts = document["doubts"].as_array().cloned().unwrap_or_default();
    doubts
        .iter()
        .map(|d| d["rule"].as_str().unwrap().to_string())
        .collect()
}

/// No value, no interval, no cause, exit 1, and the rule is named by both verbs.
fn is_withheld(case: &str, rule: &str, file: &File) {
    let (status, fitted) = ran("stiffness", file);
    let result = &fitted["results"][0];
    let stiffness = &result["parameters"][0];
    assert_eq!(status, 1, "{case}");
    assert_eq!(stiffness["status"], "not-identifiable", "{case}");
    assert!(
        stiffness["value"].is_null() && stiffness["ci95"].is_null(),
        "{case}"
    );
    assert!(
        rules(result).iter().any(|r| r == rule),
        "{case}: {:?}",
        rules(result)
    );
    let (status, found) = ran("diagnose", file);
    assert_eq!(status, 1, "{case}");
    let verdict = found["verdict"].as_str().unwrap();
    assert!(
        verdict == "cannot-tell" || verdict == "unknown-cause",
        "{case}: {verdict}"
    );
    assert_eq!(found["causes"].as_array().map(Vec::len), Some(0), "{case}");
    assert!(
        rules(&found).iter().any(|r| r == rule),
        "{case}: {:?}",
        rules(&found)
    );
}

fn axis() -> File {
    File::example("axis6.csv")
}

#[test]
fn displacement_of_its_own_is_no_response() {
    is_withheld(
        "noise",
        "unrelated",
        &axis().map("displacement_mm", |i, _| noise(i, 1)),
    );
    let sine = |i: usize, _: f64| (i as f64 * 0.083).sin();
    is_withheld("sine", "unrelated", &axis().map("displacement_mm", sine));
}

#[test]
fn one_ramp_is_no_cycle() {
    let force = axis().column("force_N");
    let file = axis();
    let risen = |i: &usize| file.number(*i, force) > 370.0;
    let peak = (0..file.rows.len()).find(risen).unwrap();
    is_withheld("first ramp", "part-of-a-cycle", &axis().rows(|i| i <= peak));
}

#[test]
fn what_never_changes_is_no_response() {
    is_withheld(
        "nothing changes",
        "unchanging",
        &axis()
            .map("force_N", |_, _| 5.0)
            .map("displacement_mm", |_, _| 0.1),
    );
    is_withheld(
        "dead sensor",
        "unchanging",
        &axis().map("displacement_mm", |_, _| 0.1),
    );
    is_withheld(
        "five rows",
        "few-rows",
        &axis().rows(|i| i % 200 == 0 && i < 1000),
    );
}

#[test]
fn a_handful_of_readings_is_no_measurement() {
    for (case, file) in [
        ("screw", benches::screw().rows(|i| i < 2)),
        ("cubes", benches::cubes().rows(|i| i < 1)),
    ] {
        let (status, found) = ran("diagnose", &file);
        let verdict = found["verdict"].as_str();
        assert_eq!((status, verdict), (1, Some("cannot-tell")), "{case}");
        assert!(rules(&found).iter().any(|r| r == "few"), "{case}");
    }
}

#[test]
fn a_clipped_laser_gives_no_stiffness() {
    is_withheld(
        "both ends",
        "clipped",
        &axis().clip("displacement_mm", 0.6, 0.6),
    );
    is_withheld(
        "upper end",
        "clipped",
        &axis().clip("displacement_mm", 0.7, 1.0),
    );
    is_withheld("force", "clipped", &axis().clip("force_N", 0.7, 0.7));
}

#[test]
fn a_column_exported_twice_gives_no_stiffness() {
    let file = axis();
    let force = file.column("force_N");
    let forces: Vec<f64> = (0..file.rows.len())
        .map(|i| file.number(i, force))
        .collect();
    for factor in [1.0, 0.01] {
        let copied = axis().map("displacement_mm", |i, _| factor * forces[i]);
        is_withheld("copied", "copied", &copied);
    }
}

#[test]
fn a_wild_force_and_a_wrong_sign_give_no_stiffness() {
    let wild = axis().map("force_N", |i, f| if i == 400 { 1e40 } else { f });
    is_withheld("1e40", "wild-load", &wild);
    is_withheld(
        "upside down",
        "reversed",
        &axis().map("displacement_mm", |_, d| -d),
    );
    is_withheld("clock", "clock", &axis().map("time_s", |_, _| 3.0));
}

#[test]
fn the_second_sensor_upside_down_is_said() {
    let file = axis().map("displacement2_mm", |_, d| -d);
    for verb in ["stiffness", "diagnose", "inspect"] {
        let bench = Bench::new();
        bench.put("a.csv", file.text().as_bytes());
        let dry: &[&str] = if verb == "inspect" {
            &[verb, "a.csv"]
        } else {
            &[verb, "--dry-run", "a.csv"]
        };
        let ran = bench.run(dry);
        assert_eq!(ran.status, 1, "{verb}");
        assert!(
            (ran.out + &ran.errors).contains("second deflection runs against the first"),
            "{verb}"
        );
    }
}

#[test]
fn powers_of_ten_are_named() {
    let cases = [
        ("kN", axis().title("force_N", "force_kN"), "10^3"),
        (
            "µm",
            axis().title("displacement_mm", "displacement_um"),
            "10^3",
        ),
        ("lever 5.0", axis().fact("load_lever_m", "5.0"), "10^1"),
        (
            "lever in mm",
            axis().fact("sensor_lever_m", "400.0"),
            "10^3",
        ),
    ];
    for (case, file, power) in cases {
        for verb in ["stiffness", "diagnose"] {
            let (status, document) = ran(verb, &file);
            let said = document.to_string();
            assert_eq!(status, 1, "{case}");
            assert!(said.contains(power), "{case}, {verb}: {said}");
        }
    }
}

/// Triangle cycles of few rows on a spring, with noise.
fn many_cycles(cycles: usize, per_cycle: usize, k: f64) -> File {
    let mut file = axis()
        .without("sensor2_lever_m")
        .without("rest_s")
        .rows(|i| i == 0);
    file.titles.truncate(3);
    file.rows = (0..cycles * per_cycle)
        .map(|i| {
            let x = (i as f64 / per_cycle as f64 + 0.25).fract();
            let force = 1000.0 * (1.0 - 4.0 * (x - 0.5).abs());
            let mm = 1e3 * 0.4 * 0.5 * force / k + 2e-3 * noise(i, 5);
            vec![
                format!("{:.3}", 0.05 * i as f64),
                format!("{force:.3}"),
                format!("{mm:.6}"),
            ]
        })
        .collect();
    file
}

#[test]
fn thousands_of_cycles_are_not_mixed() {
    for (cycles, per_cycle) in [(2400, 40), (600, 60), (100, 200)] {
        let file = many_cycles(cycles, per_cycle, 314_030.0);
        let (_, fitted) = ran("stiffness", &file);
        let value = fitted["results"][0]["parameters"][0]["value"]
            .as_f64()
            .unwrap();
        assert!(
            (value / 314_030.0 - 1.0).abs() < 0.01,
            "{cycles} cycles: {value}"
        );
        let (_, found) = ran("diagnose", &file);
        assert_eq!(
            found["causes"].as_array().map(Vec::len),
            Some(0),
            "{cycles}: {found}"
        );
    }
    let bench = Bench::new();
    bench.put("a.csv", many_cycles(400, 40, 3e5).text().as_bytes());
    let seen = document(&bench.run(&["inspect", "--json", "a.csv"]));
    let count = seen["cycles"].as_u64().unwrap();
    assert!((399..=401).contains(&count), "{count}");
}

#[test]
fn the_interval_of_a_stiffness_has_the_levers_in_it() {
    let (_, fitted) = ran("stiffness", &axis());
    let stiffness = &fitted["results"][0]["parameters"][0];
    let number = |v: &Value| v.as_f64().unwrap();
    let value = number(&stiffness["value"]);
    let (readings, levers) = (
        number(&stiffness["parts"]["readings"]),
        number(&stiffness["parts"]["levers"]),
    );
    assert!((levers / value / (0.002 * 2.0_f64.sqrt()) - 1.0).abs() < 1e-9);
    assert!((number(&stiffness["stderr"]) / readings.hypot(levers) - 1.0).abs() < 1e-9);
}

#[test]
fn without_a_nominal_stiffness_no_simulation_is_blamed() {
    let file = axis().without("nominal_stiffness_Nm_rad").without("robot");
    let (_, found) = ran("diagnose", &file);
    let said = found["sentence"].as_str().unwrap();
    assert!(said.starts_with("No stiffness is stated"), "{said}");
}

fn points() -> File {
    File::example("workspace.csv")
}

#[test]
fn force_steps_without_force_are_not_sufficient() {
    let (status, found) = ran("diagnose", &points().map("force_N", |_, _| 0.0));
    assert_eq!(status, 1);
    assert_eq!(found["verdict"], "cannot-tell");
    assert!(rules(&found).contains(&"unchanging".to_string()));
}

#[test]
fn accelerations_of_pure_noise_name_no_cause() {
    let hits = short_hammer().map("ax_m_s2", |i, _| noise(i, 1));
    let hits = hits
        .map("ay_m_s2", |i, _| noise(i, 2))
        .map("az_m_s2", |i, _| noise(i, 3));
    let (status, found) = ran("diagnose", &hits);
    assert_eq!(status, 1);
    assert_eq!(found["causes"].as_array().map(Vec::len), Some(0));
    assert!(rules(&found).contains(&"unrelated".to_string()));
}

/// The example hammer test with three hits a direction.
pub fn short_hammer() -> File {
    let file = File::example("hammer.csv");
    let kept: Vec<bool> = file
        .rows
        .iter()
        .map(|r| ["1", "2", "3"].contains(&r[1].as_str()))
        .collect();
    file.rows(|i| kept[i])
}

#[test]
fn a_drive_a_million_times_too_soft_is_doubted() {
    let bench = Bench::new();
    let text = bench.run(&["robot", "convert", "kr210"]).out;
    let from = text.find("stiffness_Nm_rad = ").unwrap() + "stiffness_Nm_rad = ".len();
    let end = from + text[from..].find([',', ' ', '\n']).unwrap();
    let soft = format!("{}5.6{}", &text[..from], &text[end..]);
    bench.put("soft.toml", soft.as_bytes());
    let ran = bench.run(&["robot", "check", "soft.toml"]);
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.errors);
    assert!(ran.out.contains("below 1e3"), "{}", ran.out);
}
