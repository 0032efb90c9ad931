//! `ident simulate` and `ident robot` as they are typed: exit status, JSON and nothing else.

use crate::robot_common::shared;
use serde_json::Value;
use std::process::{Command, Output};

const HOME: &str = "0,-90,90,0,0,0";

fn ident(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ident"))
        .args(arguments)
        .output()
        .unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let output = ident(&[arguments, &["--json"]].concat());
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["schema"], "ident/1");
    assert_eq!(document["inputs"][0]["sha256"].as_str().unwrap().len(), 64);
    document
}

fn shape(value: &Value) -> Vec<usize> {
    let mut sizes = Vec::new();
    let mut at = value;
    while let Some(list) = at.as_array() {
        sizes.push(list.len());
        at = &list[0];
    }
    sizes
}

#[test]
fn pose() {
    let answer = json(&["simulate", "pose", "--robot", "kr210", "--joints-deg", HOME]);
    assert_eq!(answer["verb"], "simulate pose");
    for (key, size) in [
        ("tcp_m", vec![3]),
        ("tcp_rotation", vec![3, 3]),
        ("jacobian", vec![6, 6]),
        ("mass_matrix", vec![6, 6]),
        ("gravity_torque_Nm", vec![6]),
    ] {
        assert_eq!(shape(&answer[key]), size, "{key}");
    }
    assert!((answer["tcp_m"][0].as_f64().unwrap() - 1.93).abs() < 1e-12);
}

#[test]
fn deflection() {
    let typed = [
        "simulate",
        "deflection",
        "--robot",
        "kr210",
        "--joints-deg",
        HOME,
        "--force-N",
        "0,-100,0",
    ];
    let answer = json(&typed);
    let moved = answer["displacement_m"][1].as_f64().unwrap();
    let stiffness = answer["stiffness_N_m"]["yy"].as_f64().unwrap();
    assert_eq!(shape(&answer["compliance_m_N"]), [3, 3]);
    assert!((moved * stiffness + 100.0).abs() < 1e-9);
    let rigid = json(&[&typed[..], &["--without-tilt"]].concat());
    assert!(rigid["stiffness_N_m"]["yy"].as_f64().unwrap() > 3.0 * stiffness);
}

#[test]
fn frf() {
    let answer = json(&[
        "simulate",
        "frf",
        "--robot",
        "kr300",
        "--joints-deg",
        HOME,
        "--to-Hz",
        "50",
        "--step-Hz",
        "0.25",
    ]);
    assert_eq!(shape(&answer["frequency_Hz"]), [200]);
    for key in ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"] {
        assert_eq!(shape(&answer["accelerance"][key]), [200, 2], "{key}");
    }
    let first = &answer["modes"][0];
    assert!(
        first["frequency_Hz"].as_f64().unwrap() > 5.0
            && first["damping_ratio"].as_f64().unwrap() > 0.0
    );
    assert!(!first["shape"].as_array().unwrap().is_empty());
}

#[test]
fn motion() {
    let folder = tempfile::tempdir().unwrap();
    let force = folder.path().join("force.csv");
    std::fs::write(&force, "time_s,fy_N\n0,0\n0.01,500\n0.05,500\n").unwrap();
    let output = ident(&[
        "simulate",
        "motion",
        "--robot",
        "kr210",
        "--joints-deg",
        HOME,
        "--force",
        force.to_str().unwrap(),
    ]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = String::from_utf8(output.stdout).unwrap();
    let header = text.lines().find(|line| !line.starts_with('#')).unwrap();
    assert!(header.starts_with("time_s,dx_mm,dy_mm,dz_mm,"));
    let last: Vec<f64> = text
        .lines()
        .last()
        .unwrap()
        .split(',')
        .map(|x| x.parse().unwrap())
        .collect();
    assert!((last[0] - 0.05).abs() < 1e-9 && last[2] > 0.5, "{last:?}");
}

#[test]
fn wrong_use_ends_with_two_and_a_remedy() {
    for typed in [
        &["simulate", "pose", "--robot", "kr211", "--joints-deg", HOME][..],
        &[
            "simulate",
            "pose",
            "--robot",
            "kr210",
            "--joints-deg",
            "0,0",
        ],
        &[
            "simulate",
            "deflection",
            "--robot",
            "kr210",
            "--joints-deg",
            HOME,
            "--force-N",
            "1,2",
        ],
        &[
            "simulate",
            "frf",
            "--robot",
            "kr210",
            "--joints-deg",
            HOME,
            "--step-Hz",
            "0",
        ],
        &[
            "simulate",
            "motion",
            "--robot",
            "kr210",
            "--joints-deg",
            HOME,
        ],
    ] {
        let output = ident(typed);
        assert_eq!(output.status.code(), Some(2), "{typed:?}");
        assert!(
            String::from_utf8_lossy(&output.stderr).contains("help:"),
            "{typed:?}"
        );
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn beyond_the_limits_needs_attention() {
    let output = ident(&[
        "simulate",
        "pose",
        "--robot",
        "kr210",
        "--joints-deg",
        "0,10,90,0,0,0",
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("A2"));
}

#[test]
fn links_without_mass_are_named() {
    let Some(path) = shared("robots/kr210_r3100_ultra.urdf") else {
        return;
    };
    let output = ident(&[
        "simulate",
        "pose",
        "--robot",
        path.to_str().unwrap(),
        "--joints-deg",
        HOME,
        "--json",
    ]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("link_5"));
}

#[test]
fn a_converted_urdf_is_the_same_robot() {
    let Some(path) = shared("robots/kr300_r2800_2_mt.urdf") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let toml = folder.path().join("mt.toml");
    let typed = [
        "robot",
        "convert",
        path.to_str().unwrap(),
        "--output",
        toml.to_str().unwrap(),
    ];
    assert_eq!(ident(&typed).status.code(), Some(0));
    let pose = |robot: &str| {
        json(&[
            "simulate",
            "pose",
            "--robot",
            robot,
            "--joints-deg",
            "10,-80,70,20,30,40",
        ])
    };
    let (a, b) = (pose(path.to_str().unwrap()), pose(toml.to_str().unwrap()));
    for key in ["tcp_m", "tcp_rotation", "mass_matrix", "gravity_torque_Nm"] {
        assert_eq!(a[key], b[key], "{key}");
    }
    assert_eq!(
        ident(&["robot", "check", toml.to_str().unwrap()])
            .status
            .code(),
        Some(0)
    );
}

#[test]
fn convert_as_json() {
    let answer = json(&["robot", "convert", "kr300"]);
    assert_eq!(
        (answer["verb"].as_str(), &answer["written"]),
        (Some("robot convert"), &Value::Null)
    );
    let plain = ident(&["robot", "convert", "kr300"]);
    assert_eq!(answer["toml"], *String::from_utf8(plain.stdout).unwrap());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("copy.toml");
    let path = path.to_str().unwrap();
    let answer = json(&["robot", "convert", "kr300", "-o", path]);
    assert_eq!(answer["written"], *path);
    assert_eq!(answer["toml"], std::fs::read_to_string(path).unwrap());
}

/// A robot file with hysteresis in one drive: shown, simulated, and refused with the line where wrong.
#[test]
fn a_joint_carries_hysteresis() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let plain = String::from_utf8(ident(&["robot", "convert", "kr210"]).stdout).unwrap();
    let drive = "drive = { stiffness_Nm_rad = 5600000.0";
    let write = |name: &str, effect: &str| {
        let text = plain.replacen(drive, &format!("{drive}, effects = [{effect}]"), 1);
        std::fs::write(at(name), text).unwrap();
    };
    let good = r#"{ name = "hysteresis", width_rad = 2e-5, slip_load_Nm = 900.0, spread = 1.0, tilt = 0.0 }"#;
    write("good.toml", good);
    write("bad.toml", &good.replace("hysteresis", "creep"));
    let shown = json(&["robot", "show", &at("good.toml")]);
    let drive = shown["springs"].as_array().unwrap().iter();
    let drive = drive.clone().find(|spring| spring["site"] == "A1").unwrap();
    assert_eq!(drive["effects"][0]["slip_load_Nm"], 900.0);
    std::fs::write(at("push.csv"), "time_s,fy_N\n0,0\n0.1,400\n0.2,0\n0.5,0\n").unwrap();
    let end = |robot: &str| {
        let typed = ["simulate", "motion", "--robot", robot, "--joints-deg", HOME];
        let answer = json(&[&typed[..], &["--force", &at("push.csv")]].concat());
        let y = answer["displacement_m"]["y"].as_array().unwrap();
        y.last().unwrap().as_f64().unwrap()
    };
    let (with, without) = (end(&at("good.toml")), end("kr210"));
    assert!(
        with > without + 1e-6,
        "after the push the contacts hold the arm: {with} {without}"
    );
    let refused = ident(&["robot", "show", &at("bad.toml")]);
    let said = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(said.contains("cannot carry the effect `creep`") && said.contains("hysteresis"));
}
