//! Joint angles: a plan of three by three points, and poses at random.

use super::robot::{Robot, V3};
use crate::blind_generator::random::Random;
use nalgebra::Matrix3;

pub type Angles = [f64; 6];

fn to_hundredths(angles: Angles) -> Angles {
    angles.map(|a| (a * 100.0).round() / 100.0)
}

fn allowed(robot: &Robot, angles: &Angles) -> bool {
    let inside = |(a, j): (&f64, &super::robot::Joint)| *a > j.limits[0] && *a < j.limits[1];
    angles.iter().zip(&robot.joints).all(inside)
}

fn wrist(random: &mut Random) -> [f64; 3] {
    [
        random.uniform(-70.0, 70.0),
        random.sign() * random.uniform(15.0, 80.0),
        random.uniform(-90.0, 90.0),
    ]
}

/// A pose that a mill might take: tool point ahead of the base and above the floor.
pub fn random_pose(robot: &Robot, random: &mut Random) -> Angles {
    loop {
        let [a4, a5, a6] = wrist(random);
        let (a1, a2) = (random.uniform(-75.0, 75.0), random.uniform(-130.0, -25.0));
        let pose = to_hundredths([a1, a2, random.uniform(30.0, 140.0), a4, a5, a6]);
        let tcp = robot.at(&pose).tcp();
        if allowed(robot, &pose) && tcp.z > 0.2 && tcp.xy().norm() > 0.7 {
            return pose;
        }
    }
}

/// The first three angles that bring the tool point to `target`, by Newton's method.
fn reach(robot: &Robot, start: Angles, target: V3) -> Option<Angles> {
    let mut pose = start;
    for _ in 0..40 {
        let here = robot.at(&pose).tcp();
        let miss = target - here;
        if miss.norm() < 1e-3 {
            let pose = to_hundredths(pose);
            return allowed(robot, &pose).then_some(pose);
        }
        let column = |i: usize| {
            let mut bent = pose;
            bent[i] += 0.01;
            (robot.at(&bent).tcp() - here) / 0.01
        };
        let slope = Matrix3::from_columns(&[column(0), column(1), column(2)]);
        let step = slope.try_inverse()? * miss;
        let short = (8.0 / step.amax()).min(1.0);
        (0..3).for_each(|i| pose[i] += short * step[i]);
    }
    None
}

/// Nine points of a level plan with one orientation of the wrist.
fn plan(robot: &Robot, random: &mut Random) -> Option<Vec<Angles>> {
    let size = robot.joints[2].point.x / 1.6;
    let [a4, a5, a6] = wrist(random);
    let height = size * random.uniform(0.6, 1.5);
    let (near, pitch) = (
        size * random.uniform(1.1, 1.5),
        size * random.uniform(0.25, 0.45),
    );
    let mut points = Vec::new();
    for row in 0..3 {
        for column in 0..3 {
            let (x, y) = (
                near + pitch * f64::from(row),
                pitch * f64::from(column - 1) * 1.6,
            );
            let start = [-y.atan2(x).to_degrees(), -85.0, 95.0, a4, a5, a6];
            points.push(reach(robot, start, V3::new(x, y, height))?);
        }
    }
    Some(points)
}

/// Nine points: a plan, or nine poses at random.
pub fn nine_points(robot: &Robot, random: &mut Random) -> (Vec<Angles>, &'static str) {
    let planned = random.chance(0.6);
    let found = planned.then(|| (0..40).find_map(|_| plan(robot, random)));
    match found.flatten() {
        Some(points) => (points, "plan"),
        None => {
            let points = (0..9).map(|_| random_pose(robot, random)).collect();
            (points, "random")
        }
    }
}
