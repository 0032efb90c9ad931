//! How the tip of the tool swings on the elastic robot at a pose, seen from the cut.

use super::pose::Carrier;
use crate::cutting::dexel::frame::Frame;
use crate::cutting::stability::TipMode;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, cross, dot, norm, rotate};
use crate::measurement::job::Job;
use crate::motion::{Work, elastic, forward_kinematics};
use crate::path::Quaternion;
use crate::planning::Plan;
use crate::planning::cell::Cell;
use crate::robot::Robot;

/// A place of the path where teeth may cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// Arc length of the programmed path, m.
    pub s_m: f64,
    /// Joint angles, rad.
    pub joints: Vec<f64>,
    /// Spindle axis from the tip into the spindle, workpiece frame.
    pub spindle: V3,
    /// Direction of the feed, workpiece frame.
    pub feed: V3,
}

impl Station {
    /// The start pose of a job, the feed along x of the workpiece.
    ///
    /// # Errors
    /// As [`Cell::of`].
    pub fn start(job: &Job, robot: &Robot) -> Outcome<(Self, Robot)> {
        let cell = Cell::of(job, robot)?;
        let mut work = Work::new(&cell.chain);
        let pose = cell.in_workpiece(&forward_kinematics(&cell.chain, &mut work, &cell.start));
        let station = Self {
            s_m: 0.0,
            joints: cell.start.to_vec(),
            spindle: rotate(&pose.rotation, cell.spindle),
            feed: [1.0, 0.0, 0.0],
        };
        Ok((station, cell.robot))
    }

    /// The stations of a plan, `apart_m` from one another, rapid motions left out.
    pub fn along(plan: &Plan, apart_m: f64) -> Vec<Self> {
        let count = (plan.path.length / apart_m).floor() as usize;
        let places = (0..=count).map(|i| i as f64 * apart_m);
        let cut = places.filter(|s| !plan.path.is_rapid(*s));
        cut.map(|s| Self::at(plan, s)).collect()
    }

    /// The cycle of a plan next to an arc length, m.
    pub fn at(plan: &Plan, s_m: f64) -> Self {
        let after = plan.rows.partition_point(|row| row.s < s_m);
        let row = &plan.rows[after.min(plan.rows.len() - 1)];
        let turned = |q: &Quaternion| rotate(&q.matrix(), plan.cell.spindle);
        Self {
            s_m,
            joints: row.q.to_vec(),
            spindle: turned(&row.orientation),
            feed: plan.path.direction(s_m),
        }
    }

    /// Axes of the cut frame: x along the feed, z the spindle axis, y = z × x; workpiece frame. A feed
    /// along the spindle axis (plunging) leaves the turn open: x is then chosen.
    pub fn axes(&self) -> [V3; 3] {
        let plunges = norm(cross(self.spindle, self.feed)) < PLUNGING;
        let forward = if plunges { [1.0, 0.0, 0.0] } else { self.feed };
        let frame = Frame::towards(forward, self.spindle);
        [frame.x, frame.y, frame.z]
    }

    /// The tip's modes here, in the cut frame, of the robot as `carrier` has it.
    ///
    /// # Errors
    /// A robot in which nothing is elastic.
    pub fn modes(&self, carrier: &mut Carrier) -> Outcome<Vec<TipMode>> {
        let modal = carrier.held(&self.joints)?.modal()?;
        let axes = self.axes();
        let mode = |i: usize| {
            let tau = modal.inertia[i].sqrt();
            TipMode {
                direction: axes.map(|axis| dot(axis, modal.tool[i])),
                omega: 1.0 / tau,
                damping_ratio: 0.5 * modal.damping[i * modal.n + i] / tau,
                stiffness: 1.0,
            }
        };
        Ok((0..modal.n).map(mode).collect())
    }
}

/// The elastic robot of a job, seen from its workpiece.
pub fn carrier(job: &Job, robot: &Robot) -> Carrier {
    Carrier::new(elastic(robot), job.workpiece.frame.rotation)
}

/// Sine of the angle between feed and spindle axis below which a motion is a plunge.
const PLUNGING: f64 = 1e-3;
