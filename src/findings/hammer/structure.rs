//! A robot at the pose of the test as matrices.

use crate::causes::HUNG;
use crate::ground::problem::Outcome;
use crate::ground::spatial::V3;
use crate::motion::linear::gravity_stiffness;
use crate::motion::swing::State;
use crate::motion::uncertain::bodies::{self, Spread, triangle};
use crate::motion::{self, Linear, Work, linearise};
use crate::robot::Robot;
use crate::robot::model::Tool;
use nalgebra::DMatrix;

/// Where a sensor on the foot sits, m, base frame.
const FOOT: V3 = [0.4, 0.4, 0.0];

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
        // the tool stands before what hangs at it
        if let Some(hung) = linear.names.iter().position(|name| name == HUNG) {
            (linear.tool[hung], linear.turn[hung]) = ([0.0; 3], [0.0; 3]);
        }
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
        let body = joint.checked_sub(1).and_then(|own| robot.link_body(own));
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

    /// What one standard deviation of every uncertain number of every body adds to the mass matrix
    /// (`motion::uncertain::bodies`). `robot` has the axes of this structure and the bodies of the robot as
    /// simulated now.
    ///
    /// # Errors
    /// Nothing elastic.
    pub fn bodies(&self, robot: &Robot, spread: &Spread) -> Outcome<DMatrix<f64>> {
        let names = motion::elastic(robot).names;
        let mut all = bodies::directions(robot, &self.angles(&names), spread)?;
        // of the tool, not of what hangs at it
        if let Some(hung) = self.linear.names.iter().position(|name| name == HUNG) {
            let own = triangle(self.linear.n).enumerate();
            own.filter(|(_, (i, j))| *i == hung || *j == hung)
                .for_each(|(place, _)| all.column_mut(place).fill(0.0));
        }
        Ok(all)
    }
}
