//! Robots to strike: the example's changed, and arms of three other builds.

use super::super::algebra::{V3, axis, minus, norm, plus, scaled};
use super::super::arm::Arm;
use super::super::pick;
use super::super::rigid::{Frame, across};
use super::robot::{Body, Hinge, Robot, three};
use ident::ground::random::Random;

/// The example's robot with other springs and bodies.
pub fn example(random: &mut Random) -> Robot {
    let text = include_str!("../../../src/robot/builtin/kr210.toml");
    let file: toml::Value = toml::from_str(text).unwrap();
    let v3 = |v: &toml::Value| -> V3 {
        let all = v.as_array().unwrap();
        std::array::from_fn(|i| all[i].as_float().unwrap())
    };
    let joints = file["joints"].as_array().unwrap();
    let frame = Frame {
        axes: std::array::from_fn(|j| v3(&joints[j]["axis"])),
        points: std::array::from_fn(|j| v3(&joints[j]["point_m"])),
        flange: v3(&file["tool"]["flange_m"]),
        tcp: v3(&file["tool"]["tcp_m"]),
    };
    let mut own = Robot {
        build: "kr210 changed".into(),
        frame,
        hinges: Vec::new(),
        bodies: Vec::new(),
        scale: 1.0,
        home_deg: [20.0, -75.0, 100.0, 30.0, 45.0, 15.0],
    };
    for (j, joint) in joints.iter().enumerate() {
        for kind in ["tilt", "drive"] {
            let k = joint[kind]["stiffness_Nm_rad"].as_float().unwrap();
            own.spring(kind, j, three(k * random.log_uniform(0.7, 1.4)));
        }
        own.take(&joint["link"], j + 1, random);
    }
    own.take(&file["tool"]["body"], 6, random);
    own
}

impl Robot {
    fn spring(&mut self, kind: &'static str, j: usize, k: f64) {
        let (a, p) = (self.frame.axes[j], self.frame.points[j]);
        let (axes, rank) = match kind {
            "tilt" => (across(a).to_vec(), 0.7),
            _ => (vec![a], 0.8),
        };
        for axis in axes {
            self.hinges.push(Hinge {
                kind,
                site: format!("A{}", j + 1),
                link: j,
                rank: j as f64 + rank,
                axis,
                point: p,
                k,
                d: 0.0,
            });
        }
    }

    fn take(&mut self, from: &toml::Value, link: usize, random: &mut Random) {
        let share = random.uniform(0.85, 1.2);
        let list = |key: &str| from[key].as_array().unwrap().clone();
        let number = |v: &toml::Value| v.as_float().unwrap();
        let (com, inertia) = (list("com_m"), list("inertia_kgm2"));
        self.bodies.push(Body {
            link,
            rank: if self.bodies.len() == 6 {
                6.9
            } else {
                link as f64
            },
            mass: three(share * number(&from["mass_kg"])),
            com: std::array::from_fn(|i| number(&com[i])),
            inertia: std::array::from_fn(|i| share * number(&inertia[i])),
        });
    }
}

/// An arm of another build; bodies are rods with a heavy foot.
pub fn stranger(random: &mut Random) -> Robot {
    let arm = Arm::draw(random);
    let mut own = Robot {
        build: arm.build.into(),
        frame: arm.frame.clone(),
        hinges: Vec::new(),
        bodies: Vec::new(),
        scale: arm.scale,
        home_deg: arm.home_deg,
    };
    for s in &arm.springs {
        let kind = match s.effect {
            "tilt_stiffness" => "tilt",
            "drive_stiffness" => "drive",
            _ => "base",
        };
        own.hinges.push(Hinge {
            kind,
            site: s.site.clone(),
            link: s.link,
            rank: s.rank,
            axis: s.axis,
            point: s.point,
            k: s.stiffness,
            d: 0.0,
        });
    }
    for (i, (link, mass, com)) in arm.bodies.iter().enumerate() {
        let (from, to) = match i {
            0..5 => (own.frame.points[i], own.frame.points[i + 1]),
            _ => (own.frame.flange, own.frame.tcp),
        };
        let place = *pick(random, &[axis(0), axis(1), axis(2)]);
        let side = scaled(place, random.uniform(-0.05, 0.05));
        own.bodies.push(Body {
            link: *link,
            rank: if i == 6 { 6.9 } else { (i + 1) as f64 },
            mass: *mass,
            com: plus(*com, side).map(|c| (c * 1e3).round() / 1e3),
            inertia: rod(*mass, minus(to, from)),
        });
    }
    own
}

/// Inertia of a thick rod along a way, about its middle.
fn rod(mass: f64, along: V3) -> [f64; 6] {
    let long = mass * norm(along).powi(2) / 12.0;
    let thick = mass * (0.06 + 0.12 * norm(along)).powi(2);
    let u = scaled(along, 1.0 / norm(along).max(1e-3));
    let at = |i: usize, j: usize| {
        let same = f64::from(u8::from(i == j));
        long * (same - u[i] * u[j]) + thick * same
    };
    [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)].map(|x| (x * 1e4).round() / 1e4)
}
