//! Hammer tests: hits, the robot's answer, and what the instruments make of both.

use super::dynamics::Dynamics;
use super::instrument::{filter, on_mount};
use super::noise::Noise;
use super::poses::Angles;
use super::propagator::{Propagator, Softening};
use super::robot::{M3, Robot, V3};
use crate::blind_generator::random::Random;

/// What was done and with what.
#[derive(Clone)]
pub struct Plan {
    pub pose: Angles,
    /// Samples a second, and seconds of a record.
    pub rate: usize,
    pub length: f64,
    pub before: f64,
    pub hits: usize,
    /// Peak force, N, and width of the pulse, s, each with its scatter.
    pub peak: f64,
    pub width: f64,
    pub signs: [f64; 3],
    pub noise: Noise,
    /// Time constant of an exponential window that the file states, s.
    pub window: Option<f64>,
}

/// A second blow in every hit of one direction.
#[derive(Clone, Copy)]
pub struct Second {
    pub direction: usize,
    pub delay: f64,
    pub share: f64,
}

/// The real robot under the real instruments.
#[derive(Clone)]
pub struct Scene {
    pub robot: Robot,
    /// Reading over acceleration.
    pub sensor: M3,
    /// Acceleration late against force, s.
    pub late: f64,
    /// Time constant of a window that nobody states, s.
    pub silent_window: Option<f64>,
    pub second: Option<Second>,
    /// Axis, mass, stiffness and damping of an absorber at the tool.
    pub absorber: Option<(V3, f64, f64, f64)>,
    /// Site, share and angle of a drive that softens.
    pub softening: Option<(String, f64, f64)>,
    /// Frequency, Hz, and damping ratio of the accelerometer on its mount.
    pub mount: Option<(f64, f64)>,
}

impl Scene {
    pub fn new(robot: Robot) -> Self {
        Self {
            robot,
            sensor: M3::identity(),
            late: 0.0,
            silent_window: None,
            second: None,
            absorber: None,
            softening: None,
            mount: None,
        }
    }

    pub fn dynamics(&self, pose: &Angles) -> Dynamics {
        let bare = Dynamics::of(&self.robot, pose);
        match &self.absorber {
            Some((axis, mass, k, d)) => bare.with_absorber(axis, *mass, *k, *d),
            None => bare,
        }
    }
}

impl Plan {
    pub fn draw(robot: &Robot, pose: Angles, random: &mut Random) -> Self {
        let rate = random.choose(&[256, 512, 1024]);
        let (omega, ratio) = Dynamics::of(robot, &pose).lowest();
        let needed = 6.0 / (omega * ratio) * random.uniform(1.0, 1.3);
        let window = random.chance(0.2) || needed > 8.0;
        let length = if window {
            random.uniform(2.0, 4.0)
        } else {
            needed.clamp(2.0, 8.0)
        };
        let end: f64 = random.log_uniform(0.01, 0.1);
        let lines = |seconds: f64| (seconds * 16.0).ceil() / 16.0;
        let mut sign = || if random.chance(0.12) { -1.0 } else { 1.0 };
        let signs = [sign(), sign(), sign()];
        Self {
            pose,
            rate,
            length: lines(length),
            before: (14.0 / rate as f64).max(random.uniform(0.02, 0.08)),
            hits: random.integer(4, 5),
            peak: random.log_uniform(300.0, 1800.0),
            width: (4.0 / rate as f64).max(random.uniform(0.004, 0.012)),
            signs,
            noise: Noise::draw(random.log_uniform(0.002, 0.02), 0.25, random),
            window: window.then(|| -lines(length) / end.ln()),
        }
    }

    pub fn samples(&self) -> usize {
        (self.length * self.rate as f64).round() as usize
    }

    /// Steps of the simulation to a sample.
    fn fine(&self) -> usize {
        4096 / self.rate
    }

    /// A half sine, perhaps two, on the fine grid.
    fn pulse(&self, direction: usize, second: Option<Second>, random: &mut Random) -> Vec<f64> {
        let peak = self.signs[direction] * self.peak * (1.0 + 0.15 * random.normal_within(2.0));
        let width = self.width * (1.0 + 0.08 * random.normal_within(2.0));
        let start = self.before + random.uniform(0.0, 1.0 / self.rate as f64);
        let blow = |t: f64, from: f64, size: f64| match t > from && t < from + width {
            true => size * (std::f64::consts::PI * (t - from) / width).sin(),
            false => 0.0,
        };
        let again = second.filter(|s| s.direction == direction);
        let again = again.map(|s| {
            let delay = s.delay * random.uniform(0.85, 1.15);
            (
                start + width + delay,
                peak * s.share * random.uniform(0.8, 1.2),
            )
        });
        let force = |i: usize| {
            let t = i as f64 / 4096.0;
            blow(t, start, peak) + again.map_or(0.0, |(from, size)| blow(t, from, size))
        };
        (0..self.samples() * self.fine()).map(force).collect()
    }
}

/// Force, and acceleration in x, y, z, sample by sample.
pub type Hit = (Vec<f64>, [Vec<f64>; 3]);

/// The instruments of a plan and the robot behind them.
pub struct Bench<'a> {
    plan: &'a Plan,
    scene: &'a Scene,
    propagator: Propagator,
    prompt: Vec<f64>,
    late: Vec<f64>,
}

impl<'a> Bench<'a> {
    pub fn new(plan: &'a Plan, scene: &'a Scene) -> Self {
        let dynamics = scene.dynamics(&plan.pose);
        let soft = scene
            .softening
            .as_ref()
            .map(|(site, share, angle)| Softening {
                degree: dynamics.sites.iter().position(|s| s == site).unwrap(),
                share: *share,
                angle: *angle,
            });
        Self {
            plan,
            scene,
            propagator: Propagator::new(&dynamics, 1.0 / 4096.0, soft),
            prompt: filter(plan.fine(), 0.0),
            late: filter(plan.fine(), scene.late * plan.rate as f64),
        }
    }

    /// One hit as recorded.
    pub fn hit(&self, direction: usize, random: &mut Random) -> Hit {
        let pulse = self.plan.pulse(direction, self.scene.second, random);
        let force: Vec<V3> = pulse.iter().map(|f| V3::ith(direction, *f)).collect();
        let mut moved = self.propagator.run(&force);
        if let Some((frequency, ratio)) = self.scene.mount {
            moved = on_mount(&moved, frequency, ratio);
        }
        let (samples, noise) = (self.plan.samples(), self.plan.noise);
        let mut force = self.thinned(&pulse, &self.prompt);
        let cell = 2e-4 * self.plan.peak;
        force.iter_mut().for_each(|f| *f += cell * random.normal());
        let mut seen: [Vec<f64>; 3] = std::array::from_fn(|c| {
            let row = self.scene.sensor.row(c);
            let bare: Vec<f64> = moved.iter().map(|a| (row * a)[0]).collect();
            let thin = self.thinned(&bare, &self.late);
            let noise = noise.stretch(samples, random);
            thin.iter().zip(noise).map(|(a, n)| a + n).collect()
        });
        for tau in [self.plan.window, self.scene.silent_window]
            .into_iter()
            .flatten()
        {
            let weight = |i: usize| (-(i as f64) / (self.plan.rate as f64 * tau)).exp();
            let channels = seen.iter_mut().chain([&mut force]);
            channels.for_each(|c| c.iter_mut().enumerate().for_each(|(i, x)| *x *= weight(i)));
        }
        (force, seen)
    }

    /// Filtered and taken at the sampling rate.
    fn thinned(&self, fine: &[f64], filter: &[f64]) -> Vec<f64> {
        let (every, half) = (self.plan.fine(), filter.len() / 2);
        let at = |n: usize| {
            let middle = n * every;
            let (from, to) = (
                middle.saturating_sub(half),
                (middle + half + 1).min(fine.len()),
            );
            let weights = &filter[from + half - middle..];
            fine[from..to].iter().zip(weights).map(|(x, w)| x * w).sum()
        };
        (0..self.plan.samples()).map(at).collect()
    }
}
