//! Against Pinocchio 4.1.0 (tests/data/pinocchio_golden*.json): pose, Jacobian, M, G, inverse and
//! forward dynamics within 1e-10 relative, for four URDFs and a chain of 18 hinges.

use crate::robot_common;

use crate::robot_common::{matrix, near, numbers, shared, vector};
use ident::motion::{self, Work};
use ident::robot::{Robot, check, load};
use serde_json::Value;

const GOLDEN: &str = include_str!("data/pinocchio_golden.json");
const GOLDEN18: &str = include_str!("data/pinocchio_golden_virtual18.json");
const TOLERANCE: f64 = 1e-10;

fn urdf(name: &str) -> Option<Robot> {
    let path = shared(&format!("robots/{name}.urdf"))?;
    Some(load::read(&std::fs::read(path).unwrap()).unwrap())
}

fn compare(robot: &Robot, golden: &Value) {
    let chain = motion::rigid(robot);
    let mut work = Work::new(&chain);
    let (q, v, a) = (
        vector(&golden["q"]),
        vector(&golden["v"]),
        vector(&golden["a"]),
    );
    let pose = motion::forward_kinematics(&chain, &mut work, &q);
    let wanted = matrix(&golden["T_tool0"]);
    for (i, row) in wanted.iter().take(3).enumerate() {
        near(&[pose.point[i]], &row[3..], TOLERANCE, "point");
        near(&pose.rotation[i], &row[..3], TOLERANCE, "rotation");
    }
    let columns = motion::jacobian(&chain, &work);
    let rows: Vec<f64> = (0..6)
        .flat_map(|r| columns.iter().map(move |c| c[r]))
        .collect();
    near(
        &rows,
        &numbers(&golden["J_tool0_lwa"]),
        TOLERANCE,
        "Jacobian",
    );
    near(
        motion::crba(&chain, &mut work, &q),
        &numbers(&golden["M"]),
        TOLERANCE,
        "M",
    );
    near(
        motion::gravity_torque(&chain, &mut work, &q),
        &vector(&golden["g"]),
        TOLERANCE,
        "g",
    );
    let zero = vec![0.0; q.len()];
    near(
        motion::rnea(&chain, &mut work, &q, &v, &zero),
        &vector(&golden["nle"]),
        TOLERANCE,
        "nle",
    );
    let tau = vector(&golden["tau_rnea"]);
    near(
        motion::rnea(&chain, &mut work, &q, &v, &a),
        &tau,
        TOLERANCE,
        "rnea",
    );
    if !golden["qdd_aba"].is_null() {
        near(
            motion::aba(&chain, &mut work, &q, &v, &tau),
            &vector(&golden["qdd_aba"]),
            TOLERANCE,
            "aba",
        );
    }
    for (key, degrees) in [
        ("p_tool0_zero", [0.0; 6]),
        ("p_tool0_kuka_home", [0.0, -90.0, 90.0, 0.0, 0.0, 0.0]),
    ] {
        let q = degrees.map(f64::to_radians);
        let pose = motion::forward_kinematics(&chain, &mut work, &q);
        near(&pose.point, &vector(&golden[key]), TOLERANCE, key);
    }
}

#[test]
fn four_urdfs_agree_with_pinocchio() {
    let golden: Value = serde_json::from_str(GOLDEN).unwrap();
    for (name, values) in golden.as_object().unwrap() {
        let Some(robot) = urdf(name) else { return };
        compare(&robot, values);
    }
}

#[test]
fn eighteen_hinges_agree_with_pinocchio() {
    let Some(robot) = urdf("kr210_r2700_2") else {
        return;
    };
    let golden: Value = serde_json::from_str(GOLDEN18).unwrap();
    let chain = robot_common::virtual18(&robot);
    let mut work = Work::new(&chain);
    let (q, v, tau) = (
        vector(&golden["q"]),
        vector(&golden["v"]),
        vector(&golden["tau"]),
    );
    near(
        motion::crba(&chain, &mut work, &q),
        &numbers(&golden["M"]),
        TOLERANCE,
        "M",
    );
    near(
        motion::gravity_torque(&chain, &mut work, &q),
        &vector(&golden["g"]),
        TOLERANCE,
        "g",
    );
    near(
        motion::rnea(&chain, &mut work, &q, &v, &[0.0; 18]),
        &vector(&golden["nle"]),
        TOLERANCE,
        "nle",
    );
    near(
        motion::aba(&chain, &mut work, &q, &v, &tau),
        &vector(&golden["qdd"]),
        TOLERANCE,
        "aba",
    );
}

#[test]
fn links_without_mass_are_refused_by_name() {
    let Some(robot) = urdf("kr210_r3100_ultra") else {
        return;
    };
    let problem = check::dynamics(&robot).unwrap_err();
    assert!(
        problem.what.contains("link_5") && problem.what.contains("link_6"),
        "{problem}"
    );
}
