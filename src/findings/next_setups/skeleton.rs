//! Where a set-up stands in space: the robot as a line, and the place of its sensor.

use super::sights::{Seat, Setting};
use crate::ground::spatial::V3;
use crate::motion::kinematics::{hinge_point, place, tcp};
use crate::motion::{Work, rigid};
use crate::robot::Robot;

/// A robot as a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Skeleton {
    /// Foot, joints, flange, and where the force acts, m, base frame.
    pub line: Vec<V3>,
    /// The sensor, m, base frame.
    pub sensor: V3,
}

impl Skeleton {
    /// Of a robot in a set-up.
    pub fn of(robot: &Robot, setting: &Setting) -> Self {
        let mut chain = rigid(robot);
        let mut work = Work::new(&chain);
        place(&chain, &mut work, &chain.spread(&setting.angles));
        let joints = (0..chain.len()).map(|hinge| hinge_point(&work, hinge));
        let mut line: Vec<V3> = [[0.0; 3]].into_iter().chain(joints).collect();
        for end in [robot.tool.flange, setting.reach.tip(robot)] {
            chain.end_at(end, robot.tool.rotation);
            line.push(tcp(&chain, &work).point);
        }
        let at = match setting.seat {
            Seat::Foot => 0,
            // The end of link i is the point of joint i + 1.
            Seat::Link(i) => i + 1,
            Seat::Tool => line.len() - 1,
        };
        Self {
            sensor: line.get(at).copied().unwrap_or_default(),
            line,
        }
    }

    /// Where the force acts, m.
    pub fn tip(&self) -> V3 {
        self.line.last().copied().unwrap_or_default()
    }
}
