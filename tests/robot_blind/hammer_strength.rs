//! How visible a change is in a hammer test: in the transfer functions, over what noise and the
//! stated spread of the robot leave open.

use super::dynamics::{C3, Dynamics};
use super::family::{self, Spread};
use super::hammer::{Plan, Scene};
use super::robot::{M3, Robot};
use crate::blind_generator::random::Random;
use nalgebra::{Complex, Matrix3};
use std::f64::consts::TAU;

/// How far bodies, springs and dampings of the real robot are from its file.
pub fn spread(stiffness: f64) -> Spread {
    Spread {
        stiffness,
        damping: 0.2,
        mass: 0.02,
        com: 0.005,
        inertia: 0.05,
    }
}

/// Hz.
fn lines() -> impl Iterator<Item = f64> {
    (0..46).map(|i| 3.0 + f64::from(i))
}

/// What the instruments make of the transfer function.
fn seen(scene: &Scene, dynamics: &Dynamics, frequency: f64) -> C3 {
    let faded = scene.silent_window.map_or(0.0, |tau| 1.0 / tau);
    let s = Complex::new(faded, TAU * frequency);
    let mount = scene.mount.map_or(Complex::new(1.0, 0.0), |(f, ratio)| {
        let w = TAU * f;
        let swing = s * (2.0 * ratio * w) + w * w;
        swing / (s * s + swing)
    });
    let sensor = scene.sensor.map(|x| Complex::new(x, 0.0));
    sensor * dynamics.accelerance(s) * (mount * (-s * scene.late).exp())
}

fn all(scene: &Scene, plan: &Plan) -> Vec<C3> {
    let dynamics = scene.dynamics(&plan.pose);
    lines().map(|f| seen(scene, &dynamics, f)).collect()
}

/// Transfer functions of a scene and their uncertainty, line by line.
pub struct Before {
    seen: Vec<C3>,
    sigma: Vec<M3>,
}

impl Before {
    pub fn of(
        scene: &Scene,
        file: &Robot,
        stiffness: f64,
        plan: &Plan,
        random: &mut Random,
    ) -> Self {
        let told = all(&Scene::new(file.clone()), plan);
        const ROBOTS: usize = 10;
        let mut squares: Vec<M3> = vec![Matrix3::zeros(); told.len()];
        for _ in 0..ROBOTS {
            let robot = family::real(file, spread(stiffness), random);
            let might = all(&Scene::new(robot), plan);
            let each = squares.iter_mut().zip(might.iter().zip(&told));
            each.for_each(|(s, (a, b))| *s += (a - b).map(|x| x.norm_sqr() / ROBOTS as f64));
        }
        let rate = plan.rate as f64;
        let noise = plan.noise.size * (plan.samples() as f64 / plan.hits as f64).sqrt();
        let force = |f: f64| rate * plan.peak * pulse(f, plan.width);
        let sigma = squares.iter().zip(lines()).map(|(s, f)| {
            let floor = (noise / force(f)).powi(2);
            s.map(|x| (x + floor).sqrt())
        });
        Self {
            sigma: sigma.collect(),
            seen: all(scene, plan),
        }
    }

    /// Largest change of a transfer function over its uncertainty.
    pub fn strength(&self, after: &Scene, plan: &Plan) -> f64 {
        let after = all(after, plan);
        let each = after.iter().zip(self.seen.iter().zip(&self.sigma));
        each.map(|(a, (b, s))| (a - b).map(Complex::norm).component_div(s).max())
            .fold(0.0, f64::max)
    }
}

/// Spectrum of a half sine of unit height.
fn pulse(frequency: f64, width: f64) -> f64 {
    let x = 2.0 * frequency * width;
    let (cosine, side) = ((0.5 * std::f64::consts::PI * x).cos(), 1.0 - x * x);
    match side.abs() < 1e-6 {
        true => 0.5 * width,
        false => 2.0 * width / std::f64::consts::PI * (cosine / side).abs(),
    }
}
