//! Effects that a hammer test may hide, and effects that no library holds.

use super::case::between;
use super::hammer::{Plan, Scene, Second};
use super::robot::V3;
use super::structure;
use super::workspace_effects::gain;
use crate::blind_generator::random::Random;
use nalgebra::{Rotation3, Unit};
use std::f64::consts::TAU;

pub const EFFECTS: [&str; 12] = [
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "base_compliance",
    "link_compliance",
    "added_mass",
    "joint_damping",
    "accelerometer_misalignment",
    "accelerometer_gain",
    "time_skew",
    "exponential_window",
    "double_hit",
];

pub const OUTSIDE: [&str; 3] = [
    "outside:absorber",
    "outside:amplitude",
    "outside:mount_resonance",
];

/// Changes the scene by a size of 0..1 and says how.
pub type Change = Box<dyn Fn(&mut Scene, f64) -> String>;

/// An effect with its place drawn.
pub struct Drawn {
    pub sites: Vec<String>,
    /// Leaves the transfer functions as they are: only the records show it.
    pub in_records: bool,
    pub change: Change,
}

fn drawn(sites: &[&str], change: impl Fn(&mut Scene, f64) -> String + 'static) -> Option<Drawn> {
    Some(Drawn {
        sites: sites.iter().map(|s| s.to_string()).collect(),
        in_records: false,
        change: Box::new(change),
    })
}

/// Draws the place of an effect; `None` where there is none for it.
pub fn draw(effect: &str, scene: &Scene, plan: &Plan, random: &mut Random) -> Option<Drawn> {
    let drive = scene.robot.joints[0].drive;
    let damping = drive.damping / drive.stiffness;
    if let Some((sites, change)) = structure::draw(effect, &scene.robot, damping, random) {
        let sites: Vec<&str> = sites.iter().map(String::as_str).collect();
        return drawn(&sites, move |s, size| change(&mut s.robot, size));
    }
    match effect {
        "added_mass" => Some(mass(scene, random)),
        "joint_damping" => {
            let (joint, more) = (random.integer(0, 5), random.chance(0.5));
            drawn(&[&format!("A{}", joint + 1)], move |s, size| {
                let factor = if more {
                    between(2.0, 4.0, size)
                } else {
                    between(0.5, 0.25, size)
                };
                s.robot.joints[joint].drive.damping *= factor;
                format!("times {factor:.2}")
            })
        }
        "accelerometer_misalignment" => {
            let axis = Unit::new_normalize(V3::from_fn(|_, _| random.normal()));
            drawn(&["sensor"], move |s, size| {
                let degrees = between(0.5, 20.0, size);
                let turn = Rotation3::from_axis_angle(&axis, f64::to_radians(degrees));
                s.sensor = turn * s.sensor;
                format!("{degrees:.1} deg about {:.2?}", axis.as_slice())
            })
        }
        "accelerometer_gain" => {
            let (which, inverse) = (random.integer(0, 5).min(3), random.chance(0.5));
            let site = ["sensor-x", "sensor-y", "sensor-z", "sensor"][which];
            drawn(&[site], move |s, size| {
                let gain = gain(inverse, 1.03, 2.0, size);
                for c in (0..3).filter(|c| which == 3 || which == *c) {
                    let scaled = s.sensor.row(c) * gain;
                    s.sensor.set_row(c, &scaled);
                }
                format!("times {gain:.3}")
            })
        }
        "time_skew" => drawn(&["sensor"], |s, size| {
            s.late = between(2e-4, 3e-3, size);
            format!("{:.2} ms", s.late * 1e3)
        }),
        "exponential_window" => window(plan),
        "double_hit" => Some(double(random)),
        _ => outside(effect, scene, plan, random),
    }
}

/// A mass at the tool or at a link, somewhat off its centre.
fn mass(scene: &Scene, random: &mut Random) -> Drawn {
    let place = random.choose(&[7, 7, 7, 2, 3, 4]);
    let off = V3::from_fn(|_, _| random.uniform(-0.15, 0.15));
    let at_tool = scene
        .robot
        .flange
        .lerp(&scene.robot.tcp, random.uniform(0.3, 1.0));
    let change = move |s: &mut Scene, size: f64| {
        if place == 7 {
            let mass = between(3.0, 20.0, size);
            s.robot.tool = s.robot.tool.with_lump(mass, at_tool + off * 0.3);
            return format!("{mass:.1} kg");
        }
        let (mass, body) = (
            between(20.0, 100.0, size),
            &mut s.robot.joints[place - 1].body,
        );
        *body = body.with_lump(mass, body.com + off);
        format!("{mass:.0} kg")
    };
    let site = if place == 7 {
        "tool".into()
    } else {
        format!("link{place}")
    };
    drawn(&[&site], change).unwrap()
}

/// Only where no window is stated.
fn window(plan: &Plan) -> Option<Drawn> {
    if plan.window.is_some() {
        return None;
    }
    let length = plan.length;
    drawn(&["sensor"], move |s, size| {
        let end = between(0.6, 0.005, size);
        s.silent_window = Some(-length / f64::ln(end));
        format!("to {:.1} % at the end", end * 100.0)
    })
}

fn double(random: &mut Random) -> Drawn {
    let second = Second {
        direction: random.integer(0, 2),
        delay: random.log_uniform(0.01, 0.08),
        share: random.uniform(0.12, 0.6),
    };
    let change = move |s: &mut Scene, _: f64| {
        s.second = Some(second);
        format!(
            "{second_delay:.0} ms later, {:.2} as hard, {}",
            second.share,
            ["x", "y", "z"][second.direction],
            second_delay = second.delay * 1e3
        )
    };
    Drawn {
        in_records: true,
        ..drawn(&[], change).unwrap()
    }
}

fn outside(effect: &str, scene: &Scene, plan: &Plan, random: &mut Random) -> Option<Drawn> {
    let (omega, _) = super::Dynamics::of(&scene.robot, &plan.pose).modes();
    match effect {
        "outside:absorber" => {
            let near = omega[random.integer(0, 3)].clamp(TAU * 8.0, TAU * 42.0);
            let tuned = near * random.uniform(0.9, 1.15);
            let (ratio, axis) = (
                random.uniform(0.01, 0.04),
                random.choose(&[V3::x(), V3::y(), V3::z()]),
            );
            drawn(&[], move |s, size| {
                let mass = between(0.3, 12.0, size);
                s.absorber = Some((axis, mass, mass * tuned * tuned, 2.0 * ratio * mass * tuned));
                format!("{mass:.1} kg at {:.1} Hz", tuned / TAU)
            })
        }
        "outside:amplitude" => softening(scene, plan, random),
        "outside:mount_resonance" => {
            let (frequency, ratio) = (random.uniform(50.0, 62.0), random.uniform(0.02, 0.08));
            drawn(&[], move |s, size| {
                let frequency = frequency * between(1.4, 1.0, size);
                s.mount = Some((frequency, ratio));
                format!("{frequency:.1} Hz")
            })
        }
        _ => None,
    }
}

/// A drive that gives way at the angles which these hits reach, and not at smaller ones.
fn softening(scene: &Scene, plan: &Plan, random: &mut Random) -> Option<Drawn> {
    let dynamics = super::Dynamics::of(&scene.robot, &plan.pose);
    let joint = random.integer(0, 2);
    let site = format!("A{}", joint + 1);
    let degree = dynamics.sites.iter().position(|s| *s == site)?;
    let impulse = plan.peak * plan.width * 2.0 / std::f64::consts::PI;
    let (omega, shapes) = dynamics.modes();
    let reached = (0..3).map(|d| {
        let push = |i: usize| (dynamics.jacobian.row(d) * shapes.column(i))[0];
        let swing = |i: usize| (shapes[(degree, i)] * push(i) / omega[i]).abs() * impulse;
        (0..6).map(swing).fold(0.0, f64::max)
    });
    let angle = reached.fold(0.0, f64::max) * random.uniform(0.2, 0.6);
    let change = move |s: &mut Scene, size: f64| {
        let share = between(0.05, 0.6, size);
        s.softening = Some((site.clone(), share, angle));
        format!("{site} softer by {share:.2} beyond {angle:.1e} rad")
    };
    drawn(&[], change)
}
