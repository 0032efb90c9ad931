//! Shared by the robot tests: where the published data lie, and comparisons.
#![allow(dead_code)]

use ident::ground::spatial::{IDENTITY, M3, product, roll_pitch_yaw};
use ident::motion::Chain;
use ident::robot::Robot;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A file of the shared data: `IDENT_SHARED_DATA`, else `../shared/data` beside the project.
/// Absent: says so and gives nothing, so that the test passes over.
pub fn shared(name: &str) -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let folder = std::env::var_os("IDENT_SHARED_DATA").map_or_else(beside, PathBuf::from);
    let path = folder.join(name);
    if !path.exists() {
        println!("passed over: {name} is not in {}", folder.display());
    }
    path.exists().then_some(path)
}

/// A JSON list of numbers.
pub fn vector(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

/// A JSON list of lists.
pub fn matrix(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().unwrap().iter().map(vector).collect()
}

/// A JSON matrix by rows.
pub fn numbers(value: &Value) -> Vec<f64> {
    matrix(value).concat()
}

/// Every entry within `tolerance` of the largest entry's size.
pub fn near(got: &[f64], wanted: &[f64], tolerance: f64, what: &str) {
    assert_eq!(got.len(), wanted.len(), "{what}");
    let size = wanted.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    for (i, (g, w)) in got.iter().zip(wanted).enumerate() {
        assert!(
            (g - w).abs() <= tolerance * size,
            "{what}[{i}]: {g} instead of {w}"
        );
    }
}

/// Joint frames of the KR 210 R2700-2 URDF with every joint at zero (rpy of its <origin> elements).
pub fn joint_frames_kr210() -> [M3; 6] {
    let (half, full) = (std::f64::consts::FRAC_PI_2, std::f64::consts::PI);
    let rpy = [
        [-full, 0.0, 0.0],
        [half, 0.0, 0.0],
        [0.0, 0.0, -half],
        [half, 0.0, 0.0],
        [-half, 0.0, 0.0],
        [half, 0.0, 0.0],
    ];
    let mut frame = IDENTITY;
    rpy.map(|[r, p, y]| {
        frame = product(&frame, &roll_pitch_yaw(r, p, y));
        frame
    })
}

/// The chain of 18 hinges of the reference values. Per joint of the KR 210 R2700-2 URDF: drive about its z, then virtual axes about its x and y, link on the last.
pub fn virtual18(robot: &Robot) -> Chain {
    let mut chain = Chain::default();
    for (joint, frame) in robot.joints.iter().zip(joint_frames_kr210()) {
        let column = |j: usize| [0, 1, 2].map(|i| frame[i][j]);
        chain.push("drive", column(2), joint.point, None, None);
        chain.push("x", column(0), joint.point, None, None);
        chain.push("y", column(1), joint.point, joint.link, None);
    }
    chain.end_at(robot.tool.tcp, robot.tool.rotation);
    chain
}
