//! The built-in robots against what the documents report, without tuning (issue 4). Where the model
//! disagrees, the test pins the number seen and says what the document says.

use ident::ground::spatial::Pose;
use ident::ground::spatial::{M3, V3, add, norm, roll_pitch_yaw, rotate};
use ident::motion::inverse::SphericalWrist;
use ident::motion::modes::{complex_modes, modal};
use ident::motion::statics::deflect;
use ident::motion::{self, Work, linearise};
use ident::robot::{Robot, builtin};

/// Postures of the KR 210 in front of the robot: arm upright and inclined, hand ahead and down.
const POSTURES: [[f64; 6]; 4] = [
    [0.0, -90.0, 90.0, 0.0, 0.0, 0.0],
    [0.0, -90.0, 90.0, 0.0, 90.0, 0.0],
    [0.0, -60.0, 90.0, 0.0, 0.0, 0.0],
    [0.0, -45.0, 90.0, 0.0, 45.0, 0.0],
];

fn named(name: &str) -> Robot {
    builtin::named(name).unwrap().unwrap()
}

/// Compliance of the tool, m/N.
fn compliance(robot: &Robot, q: &[f64; 6]) -> M3 {
    let chain = motion::elastic(robot);
    deflect(&chain, &mut Work::new(&chain), &chain.spread(q), [0.0; 3]).0
}

/// Stiffness along x, y, z, N/mm.
fn stiffness(robot: &Robot, q: &[f64; 6]) -> V3 {
    let c = compliance(robot, q);
    [0, 1, 2].map(|i| 1e-3 / c[i][i])
}

/// Joint angles that bring the tool to `point` (m) with the tool axes `rotation`.
fn reach(robot: &Robot, point: V3, rotation: M3) -> Option<[f64; 6]> {
    let chain = motion::rigid(robot);
    let limits: Vec<[f64; 2]> = robot.joints.iter().map(|joint| joint.limits).collect();
    let wrist = SphericalWrist::of(&chain, &limits)?;
    let home = [0.0, -1.5, 1.6, 0.0, 0.5, 0.0];
    wrist
        .solve(&Pose { rotation, point }, &home)
        .nearest(&home)
        .map(|posture| posture.q)
}

/// Tool axes with the spindle pointing ahead (+x) or down (−z).
fn ahead() -> M3 {
    roll_pitch_yaw(0.0, std::f64::consts::FRAC_PI_2, 0.0)
}
fn down() -> M3 {
    roll_pitch_yaw(0.0, std::f64::consts::PI, 0.0)
}

/// P1 to P9: three rows away from the base, in each left, middle, right (the thesis gives its points
/// only as a figure, Fig. 3.5; this grid is ours).
fn nine_points(robot: &Robot, rotation: M3) -> Vec<V3> {
    let point = |i: usize| [1.3 + 0.3 * (i / 3) as f64, 0.5 * (i % 3) as f64 - 0.5, 1.2];
    (0..9)
        .map(|i| stiffness(robot, &reach(robot, point(i), rotation).unwrap()))
        .collect()
}

/// Source 000, section 3.3: "In y-Richtung hat sich der Steifigkeitswert etwa gedrittelt mit dem
/// Einsatz der virtuellen Achsen."
#[test]
fn tilt_cuts_the_y_stiffness_to_about_a_third() {
    let robot = named("kr210");
    let rigid = robot.without_tilt();
    let ratio = |q: &[f64; 6]| {
        stiffness(&robot, &q.map(f64::to_radians))[1]
            / stiffness(&rigid, &q.map(f64::to_radians))[1]
    };
    let ratios: Vec<f64> = POSTURES.iter().map(ratio).collect();
    println!("y with tilt / without: {ratios:.3?}");
    assert!(ratios.iter().all(|r| (0.2..0.4).contains(r)), "{ratios:?}");
}

/// Source 004, section 11.1: 0.25 mm under 100 N at the tool.
#[test]
fn a_hundred_newtons_move_the_tool_a_quarter_millimetre() {
    let robot = named("kr210");
    let mm = |q: &[f64; 6]| 1e5 * compliance(&robot, &q.map(f64::to_radians))[1][1];
    let moved: Vec<f64> = POSTURES.iter().map(mm).collect();
    println!("mm under 100 N along y: {moved:.3?}");
    let mean = moved.iter().sum::<f64>() / moved.len() as f64;
    assert!((0.2..0.35).contains(&mean), "{moved:?}");
}

/// Source 000, section 3.3: "An den mittleren Messpunkten 2, 5 und 8 liegt in x- und z-Richtung ein
/// höherer Wert vor als an den jeweils benachbarten äußeren Punkten."
#[test]
fn middle_points_are_stiffer_in_x_and_z() {
    let robot = named("kr210");
    for (label, rotation) in [("ahead", ahead()), ("down", down())] {
        let k = nine_points(&robot, rotation);
        println!("{label}: {k:.0?}");
        for middle in [1, 4, 7] {
            for outer in [middle - 1, middle + 1] {
                assert!(k[middle][0] > k[outer][0], "{label} x at P{}", middle + 1);
                assert!(k[middle][2] > k[outer][2], "{label} z at P{}", middle + 1);
            }
        }
    }
}

/// Source 000, section 3.3 (and 004, Fig. 11.10): "in z- und y-Richtung ... immer kleiner werdende
/// Steifigkeiten, je weiter der Messpunkt von der Roboterbasis entfernt ist."
#[test]
fn stiffness_in_y_and_z_falls_with_the_distance() {
    let robot = named("kr210");
    for (label, rotation) in [("ahead", ahead()), ("down", down())] {
        let k = nine_points(&robot, rotation);
        for near in 0..6 {
            assert!(k[near][1] > k[near + 3][1], "{label} y at P{}", near + 1);
            assert!(k[near][2] > k[near + 3][2], "{label} z at P{}", near + 1);
        }
    }
}

/// Source 002, section 3.1: 750 N along x, y and −z at four positions in five poses (B and C ±30
/// degrees); the model is 6 % or 0.11 mm below the measurement: about 1.8 mm measured, 1.7 modelled.
/// Ours gives 1.35 mm at four positions of our choice: the document prints neither its positions nor
/// the length of its spindle holder, and 0.25 m is assumed for the tool.
#[test]
fn kr300_bends_under_750_newtons() {
    let robot = named("kr300");
    let chain = motion::elastic(&robot);
    let mut work = Work::new(&chain);
    let mut sizes = Vec::new();
    for point in [
        [1.6, -0.4, 1.0],
        [1.6, 0.4, 1.0],
        [1.9, -0.4, 0.8],
        [1.9, 0.4, 0.8],
    ] {
        for (b, c) in [
            (0.0, 0.0),
            (30.0, 0.0),
            (-30.0, 0.0),
            (0.0, 30.0),
            (0.0, -30.0_f64),
        ] {
            let base = roll_pitch_yaw(0.0, std::f64::consts::FRAC_PI_4 * 3.0, 0.0);
            let turn = roll_pitch_yaw(c.to_radians(), f64::to_radians(b), 0.0);
            let rotation = ident::ground::spatial::product(&base, &turn);
            let Some(q) = reach(&robot, point, rotation) else {
                panic!("{point:?} {b} {c}")
            };
            for force in [[750.0, 0.0, 0.0], [0.0, 750.0, 0.0], [0.0, 0.0, -750.0]] {
                sizes.push(1e3 * norm(deflect(&chain, &mut work, &chain.spread(&q), force).1));
            }
        }
    }
    let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
    println!("KR 300, mean deflection under 750 N: {mean:.3} mm");
    assert!((1.3..2.2).contains(&mean), "{mean}");
}

/// Source 004, section 11.3.1: six main modes below 100 Hz; the model may have more.
#[test]
fn at_least_six_modes_lie_below_100_hz() {
    let robot = named("kr210");
    let chain = motion::elastic(&robot);
    for q in POSTURES {
        let linear = linearise(
            &chain,
            &mut Work::new(&chain),
            &chain.spread(&q.map(f64::to_radians)),
        )
        .unwrap();
        let modes = complex_modes(&linear, &modal(&linear).unwrap());
        let below: Vec<f64> = modes
            .iter()
            .map(|mode| mode.frequency_hz)
            .filter(|f| *f < 100.0)
            .collect();
        println!("{below:.1?}");
        assert!(below.len() >= 6 && below[0] > 5.0, "{below:?}");
    }
}

/// Table 3.1 of source 000 and Table 1 of source 002 stand in the files as printed.
#[test]
fn stiffness_tables_are_as_printed() {
    let pick = |robot: &Robot| -> Vec<[f64; 2]> {
        let both = |joint: &ident::robot::Joint| {
            [
                joint.drive.as_ref().unwrap().stiffness,
                joint.tilt.as_ref().unwrap().stiffness,
            ]
        };
        robot.joints.iter().map(both).collect()
    };
    assert_eq!(
        pick(&named("kr210")),
        [
            [5.6e6, 1.33e7],
            [8.0397e6, 2.61e7],
            [3.1205e6, 1.54e6],
            [7.1959e5, 1.93e6],
            [6.5862e5, 6.584e5],
            [3.1403e5, 1.899e6]
        ]
    );
    assert_eq!(
        pick(&named("kr300")),
        [
            [7.5e6, 1.2e7],
            [5.4e6, 6.1e6],
            [4.3e6, 6.2e6],
            [9.0e5, 3.0e6],
            [8.0e5, 2.5e6],
            [4.9e5, 6.7e5]
        ]
    );
    assert_eq!(named("kr300").elastic.len(), 12);
}

/// Geometry: KR 210-2 of visose/Robots, KR 300 R2500 ultra of J. Intell. Robot. Syst. 109:58.
#[test]
fn flanges_are_where_the_data_sheets_put_them() {
    for (name, wanted) in [
        ("kr210", [1.680, 0.0, 1.945]),
        ("kr300", [1.590, 0.0, 1.784]),
    ] {
        let robot = named(name);
        let chain = motion::rigid(&robot);
        let home = [0.0, -90.0, 90.0, 0.0, 0.0, 0.0].map(f64::to_radians);
        let pose = motion::forward_kinematics(&chain, &mut Work::new(&chain), &home);
        let flange = add(pose.point, rotate(&pose.rotation, [0.0, 0.0, -0.25]));
        assert!(
            norm([0, 1, 2].map(|k| flange[k] - wanted[k])) < 1e-12,
            "{name} {flange:?}"
        );
    }
}
