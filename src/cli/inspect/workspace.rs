//! The account of force steps at points of the workspace.

use super::{Account, degrees, range, span, title};
use crate::experiments::workspace::fits;
use crate::fit::suitability::Doubt;
use crate::fit::suitability::workspace::doubts;
use crate::ground::problem::Outcome;
use crate::measurement::workspace_test::{DIRECTIONS, Step, WorkspaceTest};
use crate::report::json;
use crate::robot::load::load;
use crate::sheet::number::fixed;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;

/// Fewer steps than this are no line.
const FEWEST_STEPS: usize = 3;

/// The steps of one point in one direction.
struct Setup {
    point: usize,
    direction: usize,
    steps: usize,
    cycles: usize,
    force: [f64; 2],
    /// Steps in which x, y, z were measured.
    measured: [usize; 3],
}

/// Reads and tells.
pub fn account(path: &Path) -> Outcome<Account> {
    let test = WorkspaceTest::read(path)?;
    let setups = setups(&test);
    Ok(Account {
        lines: lines(&test, &setups),
        json: document(&test, &setups),
        odd: odd(&test, &setups),
    })
}

fn setups(test: &WorkspaceTest) -> Vec<Setup> {
    let places = (0..test.facts.joint_angles.len()).flat_map(|p| (0..3).map(move |d| (p, d)));
    let found = places.filter_map(|(point, direction)| {
        let own = |step: &&Step| step.point == point && step.direction == direction;
        let steps: Vec<&Step> = test.steps.iter().filter(own).collect();
        let cycles: BTreeSet<i64> = steps.iter().map(|step| step.cycle).collect();
        let seen = |k: usize| steps.iter().filter(|s| !s.displacement[k].is_nan()).count();
        (!steps.is_empty()).then(|| Setup {
            point,
            direction,
            steps: steps.len(),
            cycles: cycles.len(),
            force: range(steps.iter().map(|step| step.force)),
            measured: [0, 1, 2].map(seen),
        })
    });
    found.collect()
}

impl Setup {
    fn name(&self) -> String {
        format!("P{} {}", self.point + 1, DIRECTIONS[self.direction])
    }

    fn components(&self) -> Vec<&'static str> {
        let axes = (0..3).filter(|k| self.measured[*k] > 0);
        axes.map(|k| DIRECTIONS[k]).collect()
    }
}

fn lines(test: &WorkspaceTest, setups: &[Setup]) -> Vec<String> {
    let facts = &test.facts;
    let what = format!("workspace of {}", facts.robot);
    let mut lines = title(&test.path, &what, facts.synthetic);
    lines.push(format!(
        "{} rows, {} left out for an empty cell",
        test.rows, test.left_out
    ));
    lines.push(format!(
        "{} points with {} joint angles each, {} set-ups (point and direction)",
        facts.joint_angles.len(),
        facts.joint_angles.first().map_or(0, Vec::len),
        setups.len()
    ));
    if test.from_unloaded {
        lines.push(
            "one force in every cycle: displacements count from the unloaded robot, a step at 0 N"
                .into(),
        );
    }
    lines.extend((0..3).filter_map(|d| direction_line(d, setups)));
    let percent = |x: Option<f64>| x.map_or("not stated".into(), |x| format!("{:.2} %", 100.0 * x));
    lines.push(format!(
        "spread of the nominal stiffness: {}; repeatability of a set-up: {}; noise of the sensors: {}",
        percent(facts.nominal_rel_std),
        percent(facts.setup_repeatability),
        facts.sensor_noise.map_or("not stated".into(), |x| format!("{:.1} µm", x * 1e6)),
    ));
    lines
}

/// `force along x: 9 points, 3 cycles, 11 to 22 steps, 0 to 750 N; displacement x y z`.
fn direction_line(direction: usize, setups: &[Setup]) -> Option<String> {
    let own: Vec<&Setup> = setups.iter().filter(|s| s.direction == direction).collect();
    if own.is_empty() {
        return None;
    }
    let count = |of: fn(&Setup) -> usize| {
        let [low, high] = range(own.iter().map(|setup| of(setup) as f64));
        span(low, high)
    };
    let [low, high] = range(own.iter().flat_map(|setup| setup.force));
    let axes: BTreeSet<&str> = own.iter().flat_map(|setup| setup.components()).collect();
    let axes: Vec<&str> = axes.into_iter().collect();
    Some(format!(
        "force along {}: {} points, {} cycles and {} steps each, {} to {} N; displacement measured along {}",
        DIRECTIONS[direction],
        own.len(),
        count(|setup| setup.cycles),
        count(|setup| setup.steps),
        fixed(low, 1),
        fixed(high, 1),
        axes.join(", ")
    ))
}

fn document(test: &WorkspaceTest, setups: &[Setup]) -> serde_json::Map<String, Value> {
    let facts = &test.facts;
    let point = |(i, angles): (usize, &Vec<f64>)| {
        let own = setups.iter().filter(|setup| setup.point == i);
        let directions = own.map(|setup| {
            json!({
                "direction": DIRECTIONS[setup.direction], "cycles": setup.cycles, "steps": setup.steps,
                "force_N": setup.force, "measured": setup.components(),
            })
        });
        json!({
            "point": i + 1, "joint_angles_deg": degrees(angles),
            "directions": directions.collect::<Vec<_>>(),
        })
    };
    let points = facts.joint_angles.iter().enumerate().map(point);
    let mut map = json::head("inspect", &[(&test.path, &test.sha256)]);
    map.insert("kind".into(), json!("workspace"));
    map.insert("robot".into(), json!(facts.robot));
    map.insert("synthetic".into(), json!(facts.synthetic));
    map.insert("rows".into(), json!(test.rows));
    map.insert("rows_left_out".into(), json!(test.left_out));
    map.insert("points".into(), points.collect());
    let stated = [
        ("nominal_stiffness_rel_std", facts.nominal_rel_std),
        ("setup_repeatability", facts.setup_repeatability),
        ("sensor_noise_m", facts.sensor_noise),
    ];
    stated.into_iter().for_each(|(key, value)| {
        map.insert(key.into(), json!(value));
    });
    map
}

fn odd(test: &WorkspaceTest, setups: &[Setup]) -> Vec<String> {
    let mut odd = Vec::new();
    let mut say = |names: Vec<String>, what: &str| {
        if !names.is_empty() {
            odd.push(format!("{what}: {}", names.join(", ")));
        }
    };
    let of = |wrong: fn(&&Setup) -> bool| setups.iter().filter(wrong).map(Setup::name).collect();
    say(
        of(|s| s.measured[s.direction] == 0),
        "no displacement along the force, so no stiffness",
    );
    say(of(|s| s.steps < FEWEST_STEPS), "fewer than 3 steps");
    let robot = load(&test.facts.robot, Some(&test.path)).ok();
    let robot = robot.filter(|r| fits(&r.robot, test).is_ok());
    let found = doubts(test, robot.as_ref().map(|r| &r.robot));
    odd.extend(found.iter().map(Doubt::sentence));
    odd
}
