//! Inverse kinematics: 1e5 random poses, every branch back to within 1e-10 m and rad.

use ident::ground::random::Random;
use ident::ground::spatial::{IDENTITY, norm};
use ident::motion::inverse::SphericalWrist;
use ident::motion::{self, Work, numeric};
use ident::robot::{Robot, builtin};

const TOLERANCE: f64 = 1e-10;

fn solver(robot: &Robot) -> SphericalWrist {
    let limits: Vec<[f64; 2]> = robot.joints.iter().map(|joint| joint.limits).collect();
    SphericalWrist::of(&motion::rigid(robot), &limits).unwrap()
}

fn round_trip(robot: &Robot, poses: usize, seed: u64) {
    let chain = motion::rigid(robot);
    let wrist = solver(robot);
    let (mut work, mut random) = (Work::new(&chain), Random::new(seed));
    let mut branches = 0;
    for _ in 0..poses {
        let mut q = [0.0; 6];
        for (q, joint) in q.iter_mut().zip(&robot.joints) {
            *q = random.uniform(joint.limits[0], joint.limits[1]);
        }
        let pose = motion::forward_kinematics(&chain, &mut work, &q);
        let found = wrist.solve(&pose, &q);
        branches += found.as_slice().len();
        for posture in found.as_slice() {
            let back = motion::forward_kinematics(&chain, &mut work, &posture.q);
            let miss = numeric::error(&back, &pose);
            assert!(
                norm([miss[0], miss[1], miss[2]]) < TOLERANCE,
                "{q:?} {posture:?} {miss:?}"
            );
            assert!(
                norm([miss[3], miss[4], miss[5]]) < TOLERANCE,
                "{q:?} {posture:?} {miss:?}"
            );
        }
        let own = found.nearest(&q).unwrap();
        let step = own
            .q
            .iter()
            .zip(&q)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(step < 1e-6 || own.singular.any(), "{q:?} {own:?}");
    }
    println!(
        "{}: {:.2} branches per pose",
        robot.name,
        branches as f64 / poses as f64
    );
}

#[test]
fn a_hundred_thousand_poses_come_back() {
    round_trip(&builtin::named("kr210").unwrap().unwrap(), 100_000, 1);
}

#[test]
fn mirrored_signs_and_other_zeros_come_back() {
    let mut robot = builtin::named("kr300").unwrap().unwrap();
    robot.joints[0].axis[2] *= -1.0;
    robot.joints[2].axis[1] *= -1.0;
    robot.joints[4].axis[1] *= -1.0;
    robot.joints[0].point[1] = 0.3;
    round_trip(&robot, 10_000, 2);
}

#[test]
fn out_of_reach_gives_no_posture() {
    let robot = builtin::named("kr210").unwrap().unwrap();
    let far = ident::ground::spatial::Pose {
        rotation: IDENTITY,
        point: [9.0, 0.0, 1.0],
    };
    assert!(solver(&robot).solve(&far, &[0.0; 6]).as_slice().is_empty());
}

#[test]
fn singular_postures_are_reported_and_still_reach() {
    let robot = builtin::named("kr210").unwrap().unwrap();
    let chain = motion::rigid(&robot);
    let mut work = Work::new(&chain);
    let q = [0.2, -1.2, 1.4, 0.7, 0.0, -0.3];
    let pose = motion::forward_kinematics(&chain, &mut work, &q);
    let found = solver(&robot).solve(&pose, &q);
    let own = found.nearest(&q).unwrap();
    assert!(own.singular.wrist && !own.singular.shoulder);
    let back = motion::forward_kinematics(&chain, &mut work, &own.q);
    assert!(
        numeric::error(&back, &pose)
            .iter()
            .all(|e| e.abs() < TOLERANCE)
    );
}

#[test]
fn a_wrist_that_is_not_spherical_is_solved_numerically() {
    let mut robot = builtin::named("kr210").unwrap().unwrap();
    robot.joints[5].point[1] += 0.05;
    let chain = motion::rigid(&robot);
    let limits: Vec<[f64; 2]> = robot.joints.iter().map(|joint| joint.limits).collect();
    assert!(SphericalWrist::of(&chain, &limits).is_none());
    let mut work = Work::new(&chain);
    let mut random = Random::new(3);
    for _ in 0..200 {
        let q: Vec<f64> = robot
            .joints
            .iter()
            .map(|_| random.uniform(-1.0, -0.3))
            .collect();
        let pose = motion::forward_kinematics(&chain, &mut work, &q);
        let seed: Vec<f64> = q.iter().map(|q| q + random.uniform(-0.1, 0.1)).collect();
        let found = numeric::solve(&chain, &mut work, &pose, &seed).unwrap();
        let back = motion::forward_kinematics(&chain, &mut work, &found);
        assert!(numeric::error(&back, &pose).iter().all(|e| e.abs() < 1e-9));
    }
}
