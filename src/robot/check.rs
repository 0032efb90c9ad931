//! What can be wrong with a robot that reads well: bodies that cannot exist, units that look
//! mixed up, signs that look mirrored. Refusals stop a computation, remarks only speak.

use super::model::{Joint, Robot};
use super::spring::Spring;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{norm, sub};
use crate::ground::units::ON_A_ROBOT_M;

/// Refuses a robot whose dynamics cannot be computed: a link without body or mass, or a body that
/// cannot exist. All faults are named, links without mass first.
///
/// # Errors
/// One problem that names every link at fault.
pub fn dynamics(robot: &Robot) -> Outcome<()> {
    let missing = robot
        .joints
        .iter()
        .filter(|joint| joint.link.is_none_or(|body| body.mass == 0.0));
    let massless: Vec<&str> = missing.map(|joint| joint.link_name.as_str()).collect();
    let mut faults: Vec<String> = impossible(robot);
    if !massless.is_empty() {
        let verb = if massless.len() == 1 { "has" } else { "have" };
        faults.insert(0, format!("{} {verb} no mass", massless.join(" and ")));
    }
    refuse(
        &faults,
        "give every link mass, centre and inertia about its centre; without masses only kinematics and the deflection under a force are defined (`simulate deflection`)",
    )
}

/// Refuses a robot with a body that cannot exist. A link without body or mass is allowed: kinematics and
/// statics need none.
///
/// # Errors
/// One problem that names every link at fault.
pub fn bodies(robot: &Robot) -> Outcome<()> {
    refuse(
        &impossible(robot),
        "correct the body; if the tensor is given about the link origin, move it to the centre of mass: I_com = I − m(c²1 − ccᵀ)",
    )
}

fn refuse(faults: &[String], remedy: &str) -> Outcome<()> {
    match faults.is_empty() {
        true => Ok(()),
        false => Err(Problem::new(faults.join("; "), remedy)),
    }
}

/// Bodies with mass that no matter can have; a tool body counts too.
fn impossible(robot: &Robot) -> Vec<String> {
    let links = robot
        .joints
        .iter()
        .filter_map(|joint| Some((joint_label(joint), joint.link?)));
    let tool = robot.tool.body.map(|body| ("tool".to_string(), body));
    let carried = robot.elastic.iter();
    let carried = carried.filter_map(|axis| Some((axis.name.clone(), axis.body?)));
    let bodies = links.chain(carried).chain(tool);
    let bodies = bodies.filter(|(_, body)| body.mass != 0.0);
    bodies
        .filter_map(|(name, body)| Some(format!("{name} {}", body.fault()?)))
        .collect()
}

/// `link5 (moved by A5)`: link and axis, so that both are named.
fn joint_label(joint: &Joint) -> String {
    format!("{} (moved by {})", joint.link_name, joint.name)
}

/// A doubt about a number that is possible but unlikely.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// The joint, axis or body it concerns.
    pub site: String,
    /// What is doubtful, and what to do.
    pub text: String,
}

/// Looks for mixed-up units, mirrored signs, impossible limits and unknown numbers.
pub fn remarks(robot: &Robot) -> Vec<Remark> {
    let looks: [fn(&Robot) -> Vec<Remark>; 5] = [unsourced, stiff, far, mirrored, undamped];
    looks.iter().flat_map(|look| look(robot)).collect()
}

fn remark(site: &str, text: impl Into<String>) -> Remark {
    Remark {
        site: site.to_string(),
        text: text.into(),
    }
}

fn unsourced(robot: &Robot) -> Vec<Remark> {
    let silent = robot.source.trim().is_empty();
    silent
        .then(|| remark(&robot.name, "no `source`: say who published these numbers"))
        .into_iter()
        .collect()
}

/// Springs a thousand times stiffer or softer than any robot's: N·mm/rad read as N·m/rad, MN·m/rad as N·m/rad.
fn stiff(robot: &Robot) -> Vec<Remark> {
    let doubt = |(site, spring): (String, &Spring)| {
        let (side, unit) = match spring.stiffness {
            k if k > STIFFEST => ("above 1e9", "N·mm/rad"),
            k if k < SOFTEST => ("below 1e3", "kN·m/rad or MN·m/rad"),
            _ => return None,
        };
        let said = format!(
            "stiffness {:.3e} N·m/rad is {side}: given in {unit}?",
            spring.stiffness
        );
        Some(remark(&site, said))
    };
    robot.springs().filter_map(doubt).collect()
}

/// Stiffnesses between which the springs of robots lie, N·m/rad.
const STIFFEST: f64 = 1e9;
const SOFTEST: f64 = 1e3;

/// Points further than 20 m from the base: millimetres read as metres.
fn far(robot: &Robot) -> Vec<Remark> {
    let points = robot
        .joints
        .iter()
        .map(|joint| (joint.name.as_str(), joint.point));
    let centres = robot
        .joints
        .iter()
        .filter_map(|joint| Some((joint.link_name.as_str(), joint.link?.com)));
    let all = points.chain(centres).chain([("tool", robot.tool.tcp)]);
    let doubtful = all.filter(|(_, point)| norm(sub(*point, [0.0; 3])) > ON_A_ROBOT_M);
    doubtful
        .map(|(site, _)| {
            remark(
                site,
                "lies more than 20 m from the base: given in millimetres?",
            )
        })
        .collect()
}

/// KUKA turns A1, A4 and A6 about −z and −x (at zero). A lone joint that turns the other way while
/// the others agree is more often a mirrored sign than a new robot.
fn mirrored(robot: &Robot) -> Vec<Remark> {
    const KUKA: [[f64; 3]; 6] = [
        [0.0, 0.0, -1.0],
        [0.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
    ];
    if robot.dof() != KUKA.len() {
        return Vec::new();
    }
    let along = |joint: &Joint, k: &[f64; 3]| crate::ground::spatial::dot(joint.axis, *k);
    let signs: Vec<f64> = robot
        .joints
        .iter()
        .zip(&KUKA)
        .map(|(joint, k)| along(joint, k))
        .collect();
    let (agree, against) = (
        signs.iter().filter(|s| **s > 0.99).count(),
        signs.iter().filter(|s| **s < -0.99).count(),
    );
    if agree + against < KUKA.len() || against == 0 || against > 2 {
        return Vec::new();
    }
    let joints = robot.joints.iter().zip(&signs).filter(|(_, s)| **s < 0.0);
    joints
        .map(|(joint, _)| {
            remark(
                &joint.name,
                "turns against the KUKA convention while the other axes follow it: mirrored sign?",
            )
        })
        .collect()
}

fn undamped(robot: &Robot) -> Vec<Remark> {
    let free = robot.springs().filter(|(_, spring)| spring.damping == 0.0);
    free.map(|(site, _)| remark(&site, "has no damping: its resonances are infinite"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::builtin;

    #[test]
    fn a_mirrored_axis_is_noticed() {
        let mut robot = builtin::named("kr210").unwrap().unwrap();
        assert_eq!(mirrored(&robot), []);
        robot.joints[0].axis[2] = 1.0;
        assert_eq!(mirrored(&robot)[0].site, "A1");
    }

    #[test]
    fn newton_millimetres_are_noticed() {
        let mut robot = builtin::named("kr210").unwrap().unwrap();
        assert_eq!(stiff(&robot), []);
        robot.joints[5].drive.as_mut().unwrap().stiffness *= 1e4;
        assert_eq!(stiff(&robot)[0].site, "A6");
    }
}
