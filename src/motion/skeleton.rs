//! The robot as a line from its foot to its tool, straight or bent, and which spring gives way how much.

use super::build::elastic;
use super::chain::Chain;
use super::kinematics::{column, hinge_point, hinge_rotation, place, tcp};
use super::statics::{displacement, springs};
use super::work::Work;
use crate::ground::spatial::{V3, add, dot, norm, rotate, scale, sub};
use crate::robot::Robot;

/// Step of the difference quotient of a shape, rad.
const STEP: f64 = 1e-6;

/// A robot at a posture, m, base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Skeleton {
    /// Foot, the points of the joints, flange, tool centre point.
    pub line: Vec<V3>,
    /// Names of the joints.
    pub names: Vec<String>,
}

/// What a joint or a further elastic axis contributes to the deflection of the tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// The joint (drive and bearing together), or the elastic axis.
    pub site: String,
    /// Where it lies, m, base frame.
    pub point: V3,
    /// Its part of the deflection, along the deflection; all of them add up to one.
    pub share: f64,
}

/// The robot at joint angles, rad.
pub fn skeleton(robot: &Robot, joints: &[f64]) -> Skeleton {
    let chain = elastic(robot);
    Skeleton {
        line: line(robot, &chain, &chain.spread(joints)),
        names: robot
            .joints
            .iter()
            .map(|joint| joint.name.clone())
            .collect(),
    }
}

/// How the line of [`skeleton`] moves per unit of a shape: one value per elastic coordinate in the order
/// of [`super::linearise`], rad.
pub fn swing(robot: &Robot, joints: &[f64], shape: &[f64]) -> Vec<V3> {
    let chain = elastic(robot);
    let hinges: Vec<usize> = springs(&chain).map(|(i, _)| i).collect();
    let moved = |by: f64| {
        let mut q = chain.spread(joints);
        hinges
            .iter()
            .zip(shape)
            .for_each(|(i, amount)| q[*i] += by * amount);
        line(robot, &chain, &q)
    };
    let (up, down) = (moved(STEP), moved(-STEP));
    let rate = |(a, b): (&V3, &V3)| scale(0.5 / STEP, sub(*a, *b));
    up.iter().zip(&down).map(rate).collect()
}

fn line(robot: &Robot, chain: &Chain, q: &[f64]) -> Vec<V3> {
    let mut work = Work::new(chain);
    place(chain, &mut work, q);
    let mut line = vec![[0.0; 3]];
    line.extend(chain.drives.iter().map(|i| hinge_point(&work, *i)));
    if let (Some(last), Some(zero)) = (chain.len().checked_sub(1), chain.points_at_zero().last()) {
        let out = rotate(&hinge_rotation(&work, last), sub(robot.tool.flange, *zero));
        line.push(add(hinge_point(&work, last), out));
    }
    line.push(tcp(chain, &work).point);
    line
}

/// Who gives way under a force at the tool (N, base frame), in the order of the chain; nobody where the
/// tool does not move.
pub fn shares(robot: &Robot, joints: &[f64], force: V3) -> Vec<Share> {
    let chain = elastic(robot);
    let mut work = Work::new(&chain);
    place(&chain, &mut work, &chain.spread(joints));
    let all = displacement(&chain, &work, force);
    let at = tcp(&chain, &work).point;
    let square = norm(all).powi(2);
    let mut found: Vec<Share> = Vec::new();
    for (i, spring) in springs(&chain).filter(|_| square > 0.0) {
        let (v, _) = column(&work, i, at);
        let share = dot(v, all) * dot(v, force) / spring.stiffness / square;
        let site = site(robot, &chain.names[i]);
        match found.iter_mut().find(|other| other.site == site) {
            Some(own) => own.share += share,
            None => found.push(Share {
                site,
                point: hinge_point(&work, i),
                share,
            }),
        }
    }
    found
}

/// The joint that a drive or a bearing belongs to; else the name of the axis.
fn site(robot: &Robot, name: &str) -> String {
    let own = |joint: &&crate::robot::Joint| joint.name == name || joint.tilt_site() == name;
    let joint = robot.joints.iter().find(own);
    joint.map_or_else(|| name.to_string(), |joint| joint.name.clone())
}

/// [`shares`] under forces along x, y and z in turn, their mean.
pub fn mean_shares(robot: &Robot, joints: &[f64]) -> Vec<Share> {
    let axes: [V3; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let all = axes.map(|force| shares(robot, joints, force));
    let mut mean = all[0].clone();
    for (i, share) in mean.iter_mut().enumerate() {
        let own = all.iter().filter_map(|shares| shares.get(i));
        share.share = own.map(|one| one.share).sum::<f64>() / axes.len() as f64;
    }
    mean
}
