//! The identified robot: a robot with what the axis tests and the workspace points found, value by
//! value with provenance and interval.

use super::axis_tests::AxisTest;
use super::parameter::{Identified, Status};
use crate::robot::joint_effect::held_back;
use crate::robot::spring::Spring;
use crate::robot::{Robot, write};

/// The robot with the stiffness, backlash, hysteresis and friction of every axis test.
#[must_use]
pub fn with_axis_tests(robot: &Robot, tests: &[AxisTest]) -> Robot {
    let mut robot = robot.clone();
    for joint in &mut robot.joints {
        let own = |site: &str| tests.iter().find(|test| test.site == site);
        let spring = |test: &AxisTest| Spring::new(test.stiffness.0, 0.0);
        let tilt = joint.tilt_site();
        joint.drive = joint.drive.take().or_else(|| own(&joint.name).map(spring));
        joint.tilt = joint.tilt.take().or_else(|| own(&tilt).map(spring));
    }
    for (site, spring) in robot.springs_mut() {
        if let Some(test) = tests.iter().find(|test| test.site == site) {
            take_axis_test(spring, test);
        }
    }
    robot
}

fn take_axis_test(spring: &mut Spring, test: &AxisTest) {
    let before = spring
        .source
        .take()
        .unwrap_or_else(|| "the robot file".into());
    spring.stiffness = test.stiffness.0;
    spring.ci95.stiffness = Some(test.ci95);
    spring.stiffness_rel_std = None;
    let mut found = vec!["stiffness"];
    if let Some((gap, ci95)) = test.backlash {
        spring.backlash = vec![gap.max(0.0)];
        spring.ci95.backlash = Some(ci95);
        found.push("backlash");
    }
    if !test.effects.is_empty() {
        spring.effects = test.effects.clone();
        found.extend(test.effects.iter().map(|effect| effect.name.as_str()));
    }
    drop_impossible(spring);
    let found = found.join(", ");
    spring.source = Some(format!(
        "{found}: ident stiffness, {}; other numbers: {before}",
        test.provenance()
    ));
}

/// A spring that is stiffer than its sticking contacts cannot carry them: no robot file holds it.
fn drop_impossible(spring: &mut Spring) {
    if held_back(&spring.effects) * spring.stiffness >= 1.0 {
        spring.effects.clear();
    }
}

/// The robot with every stiffness that the points of a workspace test identified. `provenance`: the
/// measurement and the start of its hash.
#[must_use]
pub fn with_points(robot: &Robot, parameters: &[Identified], provenance: &str) -> Robot {
    with_stiffnesses(robot, parameters, &format!("ident validate, {provenance}"))
}

/// The robot with every stiffness that measuring cubes identified, as [`with_points`].
#[must_use]
pub fn with_cubes(robot: &Robot, parameters: &[Identified], provenance: &str) -> Robot {
    with_stiffnesses(robot, parameters, &format!("ident stiffness, {provenance}"))
}

fn with_stiffnesses(robot: &Robot, parameters: &[Identified], found_by: &str) -> Robot {
    let mut robot = robot.clone();
    for (site, spring) in robot.springs_mut() {
        let own = parameters.iter().find(|p| p.site == site);
        let own = own.filter(|p| p.status == Status::Identified);
        if let Some((value, ci95)) = own.and_then(|p| Some((p.value?, p.ci95?))) {
            let before = spring
                .source
                .take()
                .unwrap_or_else(|| "the robot file".into());
            spring.stiffness = value;
            spring.ci95.stiffness = Some(ci95);
            spring.stiffness_rel_std = None;
            drop_impossible(spring);
            spring.source = Some(format!(
                "stiffness: {found_by}, starting from what follows; {before}"
            ));
        }
    }
    robot
}

/// The text of `fits/<campaign>/robot.toml`.
pub fn text(robot: &Robot, base: &str, synthetic: bool) -> String {
    let mut robot = robot.clone();
    robot.notes.push(format!(
        "Identified by ident {} from {base}: every value says where it comes from; intervals are 95 %.",
        env!("CARGO_PKG_VERSION")
    ));
    let label = match synthetic {
        true => "# synthetic: identified from simulated measurements\n",
        false => "",
    };
    format!("{label}{}", write::write(&robot))
}
