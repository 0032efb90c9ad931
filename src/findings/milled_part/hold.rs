//! How the robot holds the tool where the part was probed: what gives way to the cut, and to the weight.

use super::stations::Station;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{M3, V3, add, dot, rotate, sub};
use crate::motion::elastic;
use crate::process::pose::Carrier;
use crate::process::setup::Setup;
use crate::robot::Robot;
use rayon::prelude::*;

/// The robot at one station, workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// Compliance of the tool, m/N.
    pub compliance: M3,
    /// Where the weight moves the tool, less what it does at the start of the job (calibrated away), m.
    pub sag: V3,
    /// Where the tool stands with every spring bent as the weight bends it at the start, less what that is there, m: what
    /// the sag is less if bends were calibrated there and no place.
    pub as_at_first: V3,
}

impl Hold {
    /// Where the tool stands under a force, N.
    pub fn under(&self, force: V3) -> V3 {
        add(rotate(&self.compliance, force), self.sag)
    }
}

/// A robot at every station.
///
/// # Errors
/// A robot in which nothing is elastic.
pub(super) fn holds(setup: &Setup, robot: &Robot, stations: &[Station]) -> Outcome<Vec<Hold>> {
    let mut carrier = Carrier::new(elastic(robot), setup.workpiece);
    let start = setup.way.at(setup.way.span()[0]);
    let start = carrier.held(&start.joints)?;
    let (bent, first) = (start.bent(), start.sag());
    let at = |carrier: &mut Carrier, s: &Station| {
        let held = carrier.held(&s.joints)?;
        Ok(Hold {
            compliance: held.compliance(),
            sag: sub(held.sag(), first),
            as_at_first: sub(held.moved(&bent), first),
        })
    };
    stations
        .par_iter()
        .map_init(|| carrier.clone(), at)
        .collect()
}

/// One spring at a station.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lever {
    /// Motion of the tool per radian of it, m/rad, workpiece frame.
    pub motion: V3,
    /// Torque of the cut on it, N·m.
    pub cut: f64,
    /// Torque of the weight on it, N·m.
    pub weight: f64,
}

/// A spring at every station; none where the robot has no such site.
pub(super) fn levers(setup: &Setup, stations: &[Station], site: &str) -> Option<Vec<Lever>> {
    let mut carrier = setup.carrier();
    let at = |s: &Station| {
        let held = carrier.held(&s.joints).ok()?;
        let own = held.linear.names.iter().position(|name| name == site)?;
        let motion = held.linear.tool[own];
        Some(Lever {
            motion,
            cut: dot(motion, s.force),
            weight: held.weight[own],
        })
    };
    stations.iter().map(at).collect()
}
