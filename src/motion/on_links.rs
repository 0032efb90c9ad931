//! How points on the links of a robot move in a mode.

use super::build::elastic;
use super::kinematics::{column, place};
use super::statics::springs;
use super::work::Work;
use crate::ground::spatial::{V3, add, scale};
use crate::robot::Robot;

/// Movement, base axes, of points (m, base frame at the joint angles) per unit of a shape: one value per
/// elastic coordinate in the order of [`super::linearise`], rad. A point rides on link 0 (the foot, with the
/// foundation under it), 1 (behind the first joint), and so on.
pub fn swing_of_points(
    robot: &Robot,
    joints: &[f64],
    shape: &[f64],
    points: &[(usize, V3)],
) -> Vec<V3> {
    let chain = elastic(robot);
    let mut work = Work::new(&chain);
    place(&chain, &mut work, &chain.spread(joints));
    let hinges: Vec<usize> = springs(&chain).map(|(i, _)| i).collect();
    let moved = |(link, at): &(usize, V3)| {
        // A link ends where the next joint's tilt begins; axes fixed to a link lie behind its drive.
        let end = chain
            .drives
            .get(*link)
            .map_or(chain.len(), |drive| drive - tilts(robot, *link));
        let inside = hinges.iter().zip(shape).filter(|(hinge, _)| **hinge < end);
        inside.fold([0.0; 3], |sum, (hinge, amount)| {
            add(sum, scale(*amount, column(&work, *hinge, *at).0))
        })
    };
    points.iter().map(moved).collect()
}

/// Hinges of the tilt of a joint, before its drive.
fn tilts(robot: &Robot, joint: usize) -> usize {
    match robot.joints[joint].tilt {
        Some(_) => 2,
        None => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::skeleton::{skeleton, swing};
    use crate::robot::load::load;

    #[test]
    fn points_of_the_line_move_as_the_line_does() {
        let robot = load("kr210", None).unwrap().robot;
        let joints = [0.3, -1.2, 1.4, 0.4, -0.9, 0.2];
        let chain = elastic(&robot);
        let count = springs(&chain).count();
        let shape: Vec<f64> = (0..count)
            .map(|i| ((i * 7 % 5) as f64 - 2.0) * 0.3)
            .collect();
        let line = skeleton(&robot, &joints).line;
        let whole = swing(&robot, &joints, &shape);
        // Foot, joints 1 to 6 (each rides on the link before it), flange and tool.
        let links = [0, 0, 1, 2, 3, 4, 5, 6, 6];
        let points: Vec<(usize, V3)> = links.into_iter().zip(line.iter().copied()).collect();
        let found = swing_of_points(&robot, &joints, &shape, &points);
        for (k, (a, b)) in found.iter().zip(&whole).enumerate().skip(1) {
            let apart = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-7, "point {k}: {a:?} {b:?}");
        }
    }
}
