//! Inverse kinematics: 1e5 random poses, every branch back to within 1e-10 m and rad.

use ident::ground::random::Random;
use ident::ground::spatial::{IDENTITY, M3, Pose, norm};
use ident::motion::inverse::SphericalWrist;
use ident::motion::{self, Chain, Work, numeric};
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
    let far = Pose {
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

/// Name, a1, a2, b, c1 .. c4 (m), offsets (rad) and signs.
type Opw = (&'static str, [f64; 7], [f64; 6], [f64; 6]);

/// The oracle's robots.
const OPW: [Opw; 2] = [
    (
        "Irb2400_10",
        [0.1, -0.135, 0.0, 0.615, 0.705, 0.755, 0.085],
        [0.0, 0.0, -std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0],
        [1.0; 6],
    ),
    (
        "KukaKR6_R700_sixx",
        [0.025, -0.035, 0.0, 0.4, 0.315, 0.365, 0.08],
        [0.0, -std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
        [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
    ),
];

/// The arm of Brandstötter et al. 2014, Fig. 1, upright.
fn opw_chain([a1, a2, b, c1, c2, c3, c4]: [f64; 7]) -> Chain {
    let (y, z) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let wrist = [a1 + a2, b, c1 + c2 + c3];
    let mut chain = Chain::default();
    let axes = [
        (z, [0.0; 3]),
        (y, [a1, b, c1]),
        (y, [a1, b, c1 + c2]),
        (z, wrist),
        (y, wrist),
        (z, wrist),
    ];
    axes.iter()
        .for_each(|(axis, point)| chain.push("axis", *axis, *point, None, None));
    chain.end_at([wrist[0], wrist[1], wrist[2] + c4], IDENTITY);
    chain
}

fn words(text: &str) -> Vec<f64> {
    text.split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect()
}

fn quaternion(q: &[f64]) -> M3 {
    let [x, y, z, w] = [q[0], q[1], q[2], q[3]];
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - z * w),
            2.0 * (x * z + y * w),
        ],
        [
            2.0 * (x * y + z * w),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - x * w),
        ],
        [
            2.0 * (x * z - y * w),
            2.0 * (y * z + x * w),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}

/// Every solution of the C++ original is one of ours, and we have no more than it. Where A4 and A6
/// are in line, both of its wrist solutions are the one posture that we report as singular.
#[test]
fn agrees_with_the_opw_original() {
    let cases = include_str!("data/opw_cases.txt")
        .lines()
        .filter(|line| !line.starts_with('#'));
    for line in cases {
        let mut parts = line.split(';');
        let name = parts.next().unwrap().trim();
        let (_, lengths, offsets, signs) = OPW.iter().find(|robot| robot.0 == name).unwrap();
        let pose = words(parts.next().unwrap());
        let pose = Pose {
            point: [pose[0], pose[1], pose[2]],
            rotation: quaternion(&pose[3..]),
        };
        let solver = SphericalWrist::of(&opw_chain(*lengths), &[[-10.0, 10.0]; 6]).unwrap();
        let ours = solver.solve(&pose, &[0.0; 6]);
        let theirs: Vec<Vec<f64>> = parts.next().unwrap().split('|').map(words).collect();
        let straight = |q: &Vec<f64>| q[4].to_radians().sin().abs() < 1e-6;
        let merged = theirs.iter().filter(|q| straight(q)).count() / 2;
        assert_eq!(ours.as_slice().len(), theirs.len() - merged, "{line}");
        for solution in theirs.iter().filter(|q| !straight(q)) {
            let wanted: Vec<f64> = (0..6)
                .map(|i| solution[i].to_radians() * signs[i] - offsets[i])
                .collect();
            let gap = |q: &[f64; 6]| {
                q.iter()
                    .zip(&wanted)
                    .map(|(a, b)| (a - b).sin().hypot(1.0 - (a - b).cos()))
                    .fold(0.0, f64::max)
            };
            let best = ours
                .as_slice()
                .iter()
                .map(|posture| gap(&posture.q))
                .fold(f64::MAX, f64::min);
            assert!(best < 1e-6, "{name} {solution:?}: {best}");
        }
    }
}
