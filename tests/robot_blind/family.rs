//! Robots to draw from: like the KR 210-2, like the KR 300 R2500, and scaled at random.

use super::robot::{Body, Extra, Joint, M3, Robot, Spring, V3};
use crate::blind_generator::random::Random;
use nalgebra::Rotation3;

/// Lengths a1, a2, c1, c2, c3, c4 of a wrist-partitioned arm, m; springs, N·m/rad.
struct Make {
    name: &'static str,
    lengths: [f64; 6],
    drives: [f64; 6],
    tilts: [f64; 6],
}

const MAKES: [Make; 2] = [
    Make {
        name: "like-kr210",
        lengths: [0.35, 0.055, 0.75, 1.25, 1.1, 0.23],
        drives: [5.6e6, 8.04e6, 3.12e6, 7.2e5, 6.59e5, 3.14e5],
        tilts: [1.33e7, 2.61e7, 1.54e6, 1.93e6, 6.58e5, 1.9e6],
    },
    Make {
        name: "like-kr300",
        lengths: [0.35, 0.041, 0.675, 1.15, 1.0, 0.24],
        drives: [7.5e6, 5.4e6, 4.3e6, 9.0e5, 8.0e5, 4.9e5],
        tilts: [1.2e7, 6.1e6, 6.2e6, 3.0e6, 2.5e6, 6.7e5],
    },
];

const LIMITS: [[f64; 2]; 6] = [
    [-185.0, 185.0],
    [-146.0, 0.0],
    [-119.0, 155.0],
    [-350.0, 350.0],
    [-125.0, 125.0],
    [-350.0, 350.0],
];

/// What the robot file says. `lacking` bearings are rigid in it.
pub fn draw(lacking: usize, random: &mut Random) -> Robot {
    let make = &MAKES[random.integer(0, 1)];
    let own = random.chance(0.4);
    let scale = if own { random.uniform(0.7, 1.25) } else { 1.0 };
    let vary = |random: &mut Random| match own {
        true => scale.powi(3) * random.log_uniform(0.6, 1.7),
        false => 1.0,
    };
    // Damping in proportion to stiffness: 2 to 5 % of critical at 12 Hz.
    let ratio = random.uniform(5.3e-4, 1.3e-3);
    let spring = |stiffness: f64| Spring {
        stiffness,
        damping: ratio * stiffness,
    };
    let [a1, a2, c1, c2, c3, c4] = make.lengths.map(|l| l * scale);
    let wrist = V3::new(a1 + c2 + c3, 0.0, c1 - a2);
    let (elbow, shoulder) = (V3::new(a1 + c2, 0.0, c1), V3::new(a1, 0.0, c1));
    let points = [V3::new(0.0, 0.0, c1), shoulder, elbow, wrist, wrist, wrist];
    let axes = [-V3::z(), V3::y(), V3::y(), -V3::x(), V3::y(), -V3::x()];
    let bodies = bodies(&points, scale, random);
    let joints = (0..6).map(|i| Joint {
        axis: axes[i],
        point: points[i],
        limits: LIMITS[i],
        drive: spring(make.drives[i] * vary(random)),
        tilt: Some(spring(make.tilts[i] * vary(random))),
        body: bodies[i],
    });
    let joints = joints.collect();
    let flange = wrist + V3::x() * c4;
    let beside = if random.chance(0.6) {
        random.uniform(-0.2, 0.2)
    } else {
        0.0
    };
    let tcp = flange + V3::new(random.uniform(0.15, 0.4), 0.0, beside);
    let tool = boxed(
        random.uniform(25.0, 65.0),
        flange.lerp(&tcp, 0.6),
        [0.3, 0.15, 0.15],
        random,
    );
    let mut robot = Robot {
        name: if own {
            "drawn".into()
        } else {
            make.name.into()
        },
        joints,
        flange,
        tcp,
        tool,
        extra: Vec::new(),
    };
    if random.chance(0.25) {
        for (name, axis) in [("spindle-x", V3::z()), ("spindle-y", V3::y())] {
            let soft = spring(random.log_uniform(1.5e5, 1e6));
            robot.extra.push(turning(name, 6, axis, flange, soft));
        }
    }
    while robot.joints.iter().filter(|j| j.tilt.is_none()).count() < lacking {
        robot.joints[random.integer(0, 5)].tilt = None;
    }
    robot
}

/// A virtual axis that turns.
pub fn turning(name: &str, after: usize, axis: V3, point: V3, spring: Spring) -> Extra {
    Extra {
        name: name.into(),
        after,
        axis,
        point,
        slides: false,
        spring,
    }
}

fn bodies(points: &[V3; 6], scale: f64, random: &mut Random) -> [Body; 6] {
    let masses = [363.0, 232.0, 190.0, 42.0, 20.0, 9.0];
    let [_, shoulder, elbow, wrist, ..] = *points;
    let places = [
        V3::new(0.05, -0.01, 0.5 * shoulder.z),
        shoulder.lerp(&elbow, 0.42) + V3::y() * -0.11,
        elbow + V3::new(0.05, 0.13, 0.08),
        elbow.lerp(&wrist, 0.25),
        wrist + V3::new(0.0, -0.05, 0.03),
        wrist + V3::new(0.04, 0.0, 0.0),
    ];
    let sizes = [
        [0.7, 0.6, 0.6],
        [1.5, 0.35, 0.4],
        [0.8, 0.4, 0.45],
        [0.7, 0.25, 0.25],
        [0.3, 0.3, 0.3],
        [0.14, 0.22, 0.22],
    ];
    std::array::from_fn(|i| {
        let mass = masses[i] * scale.powi(3) * random.uniform(0.85, 1.15);
        boxed(mass, places[i], sizes[i].map(|l| l * scale), random)
    })
}

/// A solid box, a little askew.
fn boxed(mass: f64, com: V3, [a, b, c]: [f64; 3], random: &mut Random) -> Body {
    let main = V3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (mass / 12.0);
    let mut angle = || random.uniform(-0.2, 0.2);
    let turn = Rotation3::from_euler_angles(angle(), angle(), angle());
    let turn = turn.matrix();
    let inertia = turn * M3::from_diagonal(&main) * turn.transpose();
    Body {
        mass,
        com,
        inertia: (inertia + inertia.transpose()) * 0.5,
    }
}

/// How far a real robot is from its file, relative standard deviations; `com` in metres.
#[derive(Clone, Copy)]
pub struct Spread {
    pub stiffness: f64,
    pub damping: f64,
    pub mass: f64,
    pub com: f64,
    pub inertia: f64,
}

/// A robot as it might really be, given its file.
pub fn real(file: &Robot, spread: Spread, random: &mut Random) -> Robot {
    let mut robot = file.clone();
    let off = |s: f64, random: &mut Random| (s * random.normal_within(2.5)).exp();
    let spring = |s: &mut Spring, random: &mut Random| {
        s.stiffness *= off(spread.stiffness, random);
        s.damping *= off(spread.damping, random);
    };
    let body = |b: &mut Body, random: &mut Random| {
        let mass = off(spread.mass, random);
        b.mass *= mass;
        b.inertia *= mass * off(spread.inertia, random);
        b.com += V3::from_fn(|_, _| spread.com * random.normal_within(2.5));
    };
    for joint in &mut robot.joints {
        spring(&mut joint.drive, random);
        joint.tilt.iter_mut().for_each(|t| spring(t, random));
        body(&mut joint.body, random);
    }
    robot
        .extra
        .iter_mut()
        .for_each(|e| spring(&mut e.spring, random));
    body(&mut robot.tool, random);
    robot
}
