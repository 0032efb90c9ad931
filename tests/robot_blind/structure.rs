//! Changes of the structure that both kinds of test can hide: springs too soft or too stiff, springs
//! that the robot file lacks. Each is drawn as a place and a change that grows with a size of 0 to 1.

use super::case::between;
use super::family::turning;
use super::robot::{Robot, Spring, V3, across};
use crate::blind_generator::random::Random;
use nalgebra::{Rotation3, Unit};

/// Changes the robot by a size of 0..1 and says how.
pub type Change = Box<dyn Fn(&mut Robot, f64) -> String>;

pub const STRUCTURE: [&str; 6] = [
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "base_compliance",
    "link_compliance",
    "tool_compliance",
];

/// The same along none of the frame's axes, and not half-way; no suite draws them by chance.
pub const OBLIQUE: [&str; 2] = ["base_compliance:oblique", "link_compliance:oblique"];

/// Names of the place and change; `None` if the name is of no structure, or the robot has no such place.
pub fn draw(
    effect: &str,
    robot: &Robot,
    damping: f64,
    random: &mut Random,
) -> Option<(Vec<String>, Change)> {
    match effect {
        "drive_stiffness" => {
            let (joint, (from, to)) = (random.integer(0, 5), factors(random));
            let change = move |robot: &mut Robot, size: f64| {
                scale(&mut robot.joints[joint].drive, between(from, to, size))
            };
            Some((vec![format!("A{}", joint + 1)], Box::new(change)))
        }
        "tilt_stiffness" => {
            let (joint, (from, to)) = (tilting(robot, true, random)?, factors(random));
            let change = move |robot: &mut Robot, size: f64| {
                scale(
                    robot.joints[joint].tilt.as_mut().unwrap(),
                    between(from, to, size),
                )
            };
            Some((vec![format!("A{}-tilt", joint + 1)], Box::new(change)))
        }
        "missing_tilt" => {
            let joint = tilting(robot, false, random)?;
            let drive = robot.joints[joint].drive;
            let change = move |robot: &mut Robot, size: f64| {
                let stiffness = drive.stiffness * between(10.0, 0.4, size);
                robot.joints[joint].tilt = Some(spring(stiffness, damping));
                format!("{stiffness:.3e} Nm/rad")
            };
            Some((vec![format!("A{}-tilt", joint + 1)], Box::new(change)))
        }
        "base_compliance" => Some((vec!["base".into()], base(damping, random))),
        "base_compliance:oblique" => Some((vec!["base".into()], oblique(damping, random))),
        "link_compliance" => Some(link(robot, damping, None, random)),
        "link_compliance:oblique" => {
            let oblique = (random.choose(&[0.2, 0.8]), random.uniform(0.4, 1.1));
            Some(link(robot, damping, Some(oblique), random))
        }
        "tool_compliance" => {
            // Axes that the file has at the flange are the same place by another name.
            let known = robot.extra.iter().filter(|e| e.after == 6);
            let sites = known.map(|e| e.name.clone()).chain(["tool".into()]);
            Some((sites.collect(), tool(robot, damping, random)))
        }
        _ => None,
    }
}

/// Half or less, or one and a half times or more: from the least to the largest change.
fn factors(random: &mut Random) -> (f64, f64) {
    if random.chance(0.65) {
        (0.7, 0.3)
    } else {
        (1.5, 3.0)
    }
}

fn scale(spring: &mut Spring, factor: f64) -> String {
    spring.stiffness *= factor;
    format!("times {factor:.2}")
}

fn spring(stiffness: f64, damping: f64) -> Spring {
    Spring {
        stiffness,
        damping: damping * stiffness,
    }
}

fn tilting(robot: &Robot, with: bool, random: &mut Random) -> Option<usize> {
    let fits = |i: &usize| robot.joints[*i].tilt.is_some() == with;
    let joints: Vec<usize> = (0..6).filter(fits).collect();
    (!joints.is_empty()).then(|| random.choose(&joints))
}

/// The foundation turns about x, about y or about both, and sometimes slides as well.
fn base(damping: f64, random: &mut Random) -> Change {
    let which = random.integer(0, 2);
    let ratio = random.log_uniform(0.5, 2.0);
    let slide = random
        .chance(0.25)
        .then(|| random.choose(&[V3::x(), V3::y()]));
    Box::new(move |robot, size| {
        let stiffness = between(4e8, 2e6, size);
        for (name, axis, k) in [("base-x", V3::x(), 1.0), ("base-y", V3::y(), ratio)] {
            let asked = which == 2 || (which == 1) == (name == "base-y");
            let soft = spring(k * stiffness, damping);
            let extra = asked.then(|| turning(name, 0, axis, V3::zeros(), soft));
            robot.extra.extend(extra);
        }
        if let Some(axis) = slide {
            let soft = spring(4.0 * stiffness, damping);
            let mut extra = turning("base-slide", 0, axis, V3::zeros(), soft);
            extra.slides = true;
            robot.extra.push(extra);
        }
        let about = ["x", "y", "x and y"][which];
        let slides = if slide.is_some() { ", slides" } else { "" };
        format!("about {about} {stiffness:.2e} Nm/rad{slides}")
    })
}

/// The foundation turns about an axis along none of the frame's.
fn oblique(damping: f64, random: &mut Random) -> Change {
    let angle = random.uniform(0.5, 1.1) + random.choose(&[0.0, std::f64::consts::FRAC_PI_2]);
    let axis = V3::new(angle.cos(), angle.sin(), random.uniform(-0.2, 0.2)).normalize();
    Box::new(move |robot, size| {
        let stiffness = between(4e8, 2e6, size);
        let soft = spring(stiffness, damping);
        robot
            .extra
            .push(turning("base-oblique", 0, axis, V3::zeros(), soft));
        format!("about {:.2?} {stiffness:.2e} Nm/rad", axis.as_slice())
    })
}

/// Link arm or forearm bends, in one direction or in both: half-way, or after a share of its length and in directions
/// turned about it by an angle, rad.
fn link(
    robot: &Robot,
    damping: f64,
    oblique: Option<(f64, f64)>,
    random: &mut Random,
) -> (Vec<String>, Change) {
    let number = random.integer(2, 3);
    let (from, to) = (robot.joints[number - 1].point, robot.joints[number].point);
    let along = Unit::new_normalize(to - from);
    let turned = Rotation3::from_axis_angle(&along, oblique.map_or(0.0, |o| o.1));
    let axes = across(&along).map(|axis| turned * axis);
    let (ways, first) = (random.integer(1, 2), random.integer(0, 1));
    let share = oblique.map_or_else(|| random.uniform(0.35, 0.65), |o| o.0);
    let at = from.lerp(&to, share);
    let change: Change = Box::new(move |robot, size| {
        let stiffness = between(8e7, 4e5, size);
        for way in 0..ways {
            let axis = axes[(first + way) % 2];
            let name = format!("bend{way}");
            let soft = spring(stiffness, damping);
            robot.extra.push(turning(&name, number, axis, at, soft));
        }
        format!("{ways} ways {stiffness:.2e} Nm/rad")
    });
    (vec![format!("link{number}")], change)
}

/// The tool's mount turns across its axis, in one direction or in both.
fn tool(robot: &Robot, damping: f64, random: &mut Random) -> Change {
    let at = robot.flange;
    let (ways, first) = (random.integer(1, 2), random.integer(0, 1));
    Box::new(move |robot, size| {
        let stiffness = between(5e6, 3e4, size);
        for way in 0..ways {
            let axis = [V3::y(), V3::z()][(first + way) % 2];
            let soft = spring(stiffness, damping);
            robot
                .extra
                .push(turning(&format!("mount{way}"), 6, axis, at, soft));
        }
        format!("{ways} ways {stiffness:.2e} Nm/rad")
    })
}
