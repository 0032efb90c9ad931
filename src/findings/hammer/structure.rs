//! A robot at the pose of the test as matrices, and how its bodies' uncertain numbers change them.

use crate::ground::problem::Outcome;
use crate::ground::spatial::V3;
use crate::motion::linear::gravity_stiffness;
use crate::motion::swing::State;
use crate::motion::{self, Linear, Work, linearise};
use crate::robot::model::Tool;
use crate::robot::{Body, Robot};
use nalgebra::DMatrix;

/// Masses are known to this share, centres of mass to these metres, inertias to that share.
const BODY: (f64, f64, f64) = (0.02, 0.005, 0.05);
/// Where a sensor on the foot sits, m, base frame.
const FOOT: V3 = [0.4, 0.4, 0.0];
/// Uncertain numbers of a body: mass, centre, inertia.
const NUMBERS: usize = 10;

/// The robot with play closed, at rest under its weight.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// Its matrices, weight's stiffness included.
    pub linear: Linear,
    /// Angle of every hinge, rad, by site: weight has bent the robot.
    rest: Vec<(String, f64)>,
}

impl Structure {
    /// The matrices of `robot` at the joint angles `joints` (rad).
    ///
    /// # Errors
    /// No equilibrium, or nothing elastic.
    pub fn of(robot: &Robot, joints: &[f64]) -> Outcome<Self> {
        let chain = motion::elastic(robot);
        let bent = State::settled(&chain, joints)?.angles();
        let rest = chain.names.iter().cloned().zip(bent).collect();
        Self {
            linear: Linear::default(),
            rest,
        }
        .altered(robot)
    }

    /// The matrices of the robot with something changed, where it came to rest before: what a cause
    /// adds bends by less than a thousandth of a radian.
    ///
    /// # Errors
    /// Nothing elastic.
    pub fn altered(&self, robot: &Robot) -> Outcome<Self> {
        let chain = motion::elastic(robot);
        let mut work = Work::new(&chain);
        let mut linear = linearise(&chain, &mut work, &self.angles(&chain.names))?;
        let weight = gravity_stiffness(&chain, &work);
        let both = linear.stiffness.iter_mut().zip(&weight);
        both.for_each(|(k, w)| *k += w);
        let rest = self.rest.clone();
        Ok(Self { linear, rest })
    }

    /// Angles of the hinges of these names; the tilts of one bearing stand in their order.
    fn angles(&self, names: &[String]) -> Vec<f64> {
        let mut known: Vec<&(String, f64)> = self.rest.iter().collect();
        let angle = |name: &String| match known.iter().position(|k| k.0 == *name) {
            Some(i) => known.remove(i).1,
            None => 0.0,
        };
        names.iter().map(angle).collect()
    }

    /// Translation per coordinate, m/rad, of a sensor on the mass centre of the body that joint
    /// `joint` moves, or for 0 on the foot, 0.4 m beside the middle.
    pub fn sensor(&self, robot: &Robot, joint: usize) -> Vec<V3> {
        let mut part = robot.clone();
        part.joints.truncate(joint);
        part.elastic.retain(|axis| axis.after < joint.max(1));
        let body = part.joints.last().and_then(|joint| joint.link);
        let at = body.map_or(FOOT, |body| body.com);
        part.tool = Tool {
            flange: at,
            tcp: at,
            ..Tool::default()
        };
        let chain = motion::elastic(&part);
        let angles = self.angles(&chain.names);
        let linear = linearise(&chain, &mut Work::new(&chain), &angles);
        let mut levers = linear.map_or(Vec::new(), |linear| linear.tool);
        levers.resize(self.linear.n, [0.0; 3]);
        levers
    }

    /// What one standard deviation of every uncertain number of every body adds to the mass matrix,
    /// one row per number: the upper triangle by rows. `robot` has the axes of this structure and
    /// the bodies of the robot as simulated now.
    pub fn bodies(&self, robot: &Robot) -> DMatrix<f64> {
        let n = self.linear.n;
        let Ok(own) = self.altered(robot) else {
            return DMatrix::zeros(0, 0);
        };
        let count = NUMBERS * (robot.dof() + 1);
        let mut out = DMatrix::zeros(count, n * (n + 1) / 2);
        for number in 0..count {
            let mut other = robot.clone();
            let Some(body) = body(&mut other, number / NUMBERS) else {
                continue;
            };
            disturb(body, number % NUMBERS);
            let chain = motion::elastic(&other);
            let Ok(moved) = linearise(&chain, &mut Work::new(&chain), &self.angles(&chain.names))
            else {
                continue;
            };
            for (place, (i, j)) in triangle(n).enumerate() {
                out[(number, place)] = moved.mass[i * n + j] - own.linear.mass[i * n + j];
            }
        }
        out
    }
}

/// Upper triangle by rows.
pub fn triangle(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i..n).map(move |j| (i, j)))
}

fn body(robot: &mut Robot, index: usize) -> Option<&mut Body> {
    match index < robot.dof() {
        true => robot.joints[index].link.as_mut(),
        false => robot.tool.body.as_mut(),
    }
}

fn disturb(body: &mut Body, number: usize) {
    let [xx, yy, zz, ..] = body.inertia;
    match number {
        0 => {
            body.mass *= 1.0 + BODY.0;
            body.inertia.iter_mut().for_each(|i| *i *= 1.0 + BODY.0);
        }
        1..=3 => body.com[number - 1] += BODY.1,
        4..=6 => body.inertia[number - 4] *= 1.0 + BODY.2,
        7 => body.inertia[3] += BODY.2 * (xx * yy).sqrt(),
        8 => body.inertia[4] += BODY.2 * (xx * zz).sqrt(),
        _ => body.inertia[5] += BODY.2 * (yy * zz).sqrt(),
    }
}
