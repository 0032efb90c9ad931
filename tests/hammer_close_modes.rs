//! Close, heavily damped pairs: modes of a soft robot at four poses, hit as in a laboratory.

use crate::common::{Blow, Mode, axis, record};
use ident::experiments::hammer_frf::{Settings, estimate};
use ident::experiments::hammer_modes::modes;
use ident::ground::random::Random;
use ident::signal::modes::Mode as Found;

/// Frequency (Hz), damping ratio and shape at the tool (1/√kg) of the lowest modes of a robot with
/// twelve elastic joints, computed apart from `ident`: undamped eigenvectors of mass and stiffness,
/// damping ratios from the diagonal of the modal damping.
type Pose = [(f64, f64, [f64; 3]); 13];

const POSES: [Pose; 3] = [
    [
        (11.570, 0.0278, [0.03060, 0.04732, 0.05487]),
        (12.198, 0.0299, [-0.03793, -0.08774, 0.04294]),
        (17.004, 0.0367, [-0.02717, -0.07206, 0.02367]),
        (22.416, 0.0666, [0.11329, -0.03873, 0.06309]),
        (34.142, 0.0810, [0.01392, 0.01627, -0.01818]),
        (35.214, 0.0857, [0.01492, -0.00925, -0.00897]),
        (42.562, 0.1047, [0.02914, 0.03541, -0.01588]),
        (53.008, 0.1396, [-0.00631, -0.04303, 0.02213]),
        (56.520, 0.1421, [0.02827, -0.01480, 0.00429]),
        (59.368, 0.1451, [-0.03859, -0.01306, 0.01453]),
        (69.588, 0.1846, [0.08182, -0.02869, -0.01111]),
        (76.033, 0.1943, [0.01041, 0.04876, -0.02914]),
        (121.001, 0.2079, [-0.00344, -0.00099, 0.00448]),
    ],
    [
        (11.721, 0.0279, [0.00221, 0.04264, 0.05710]),
        (12.469, 0.0307, [-0.00966, -0.10306, 0.03365]),
        (17.358, 0.0371, [0.00058, 0.07356, -0.02109]),
        (22.973, 0.0680, [0.12038, 0.00068, 0.06386]),
        (34.626, 0.0831, [0.00940, 0.01473, -0.01987]),
        (35.084, 0.0858, [0.02194, -0.00540, -0.01728]),
        (42.298, 0.1059, [0.01973, 0.05499, -0.01336]),
        (51.526, 0.1376, [-0.01100, 0.05204, -0.01566]),
        (56.242, 0.1408, [0.05549, -0.00069, -0.00925]),
        (58.460, 0.1452, [-0.02440, -0.02634, 0.01486]),
        (64.903, 0.1679, [-0.08251, 0.01300, 0.02121]),
        (74.662, 0.1919, [-0.00160, -0.04312, 0.01631]),
        (116.750, 0.2004, [0.00227, 0.00285, -0.00419]),
    ],
    [
        (11.460, 0.0276, [0.01655, -0.05087, -0.06526]),
        (12.406, 0.0301, [-0.00786, -0.11194, 0.03509]),
        (17.976, 0.0367, [-0.00270, 0.05899, -0.00930]),
        (23.058, 0.0676, [-0.08361, -0.00879, -0.10361]),
        (34.038, 0.0795, [0.00507, -0.02567, 0.00405]),
        (35.882, 0.0897, [0.01242, -0.00206, -0.00586]),
        (43.016, 0.1059, [0.00526, 0.04312, 0.01229]),
        (52.698, 0.1392, [-0.00811, 0.04546, -0.00252]),
        (56.601, 0.1376, [0.02876, 0.01347, 0.01070]),
        (59.344, 0.1563, [-0.00697, -0.02447, -0.00596]),
        (69.541, 0.1883, [-0.08186, 0.01365, -0.03507]),
        (77.432, 0.1951, [0.00052, 0.06194, 0.00822]),
        (109.091, 0.1867, [-0.00031, -0.00682, -0.00128]),
    ],
];

fn truth(pose: &Pose) -> Vec<Mode> {
    let mode = |(hz, damping, shape): &(f64, f64, [f64; 3])| Mode {
        hz: *hz,
        damping: *damping,
        shape: *shape,
    };
    pose.iter().map(mode).collect()
}

fn found(truth: &[Mode], settings: &Settings, seed: u64) -> Vec<Found> {
    let mut random = Random::new(seed);
    let mut blows = Vec::new();
    for direction in ["x", "y", "z"] {
        for _ in 0..5 {
            let blow = Blow {
                rate_hz: 1000.0,
                length_s: 3.0,
                axis: axis(direction),
                peak_n: random.uniform(250.0, 450.0),
                width_s: random.uniform(0.007, 0.010),
                ..Blow::default()
            };
            blows.push((direction, blow));
        }
    }
    let settings = Settings {
        modes: true,
        ..*settings
    };
    let frf = estimate(&record(truth, &blows, seed), &settings).unwrap();
    modes(&frf, 50.0)
}

/// The modes found, each given to the nearest true one that is still free.
fn matched<'a>(truth: &[Mode], found: &'a [Found]) -> Vec<(Mode, &'a Found)> {
    let mut left: Vec<&Found> = found.iter().collect();
    let mut pairs = Vec::new();
    for mode in truth.iter().filter(|mode| mode.hz < 45.0) {
        let off = |f: &Found| (f.frequency_hz / mode.hz - 1.0).abs();
        let near = (0..left.len()).min_by(|a, b| off(left[*a]).total_cmp(&off(left[*b])));
        let near = near.filter(|k| off(left[*k]) < 0.005);
        let list: Vec<_> = found
            .iter()
            .map(|f| (f.frequency_hz, f.damping_ratio))
            .collect();
        let near = near.unwrap_or_else(|| panic!("{} Hz is lost; found {list:?}", mode.hz));
        pairs.push((*mode, left.remove(near)));
    }
    let spurious = left.iter().filter(|f| f.frequency_hz < 45.0).count();
    assert_eq!(spurious, 0, "spurious modes");
    pairs
}

#[test]
fn close_heavily_damped_pairs_are_told_apart() {
    let (mut dampings, mut inside, mut all) = (Vec::new(), [0, 0], 0);
    for (k, pose) in POSES.iter().enumerate() {
        let truth = truth(pose);
        for seed in [10, 20] {
            let found = found(&truth, &Settings::default(), seed + k as u64);
            for (mode, found) in matched(&truth, &found) {
                let [f, d] = [
                    found.frequency_hz - mode.hz,
                    found.damping_ratio - mode.damping,
                ];
                dampings.push((d / mode.damping).abs());
                inside[0] += usize::from(f.abs() <= found.half_width[0]);
                inside[1] += usize::from(d.abs() <= found.half_width[1]);
                all += 1;
            }
        }
    }
    dampings.sort_by(f64::total_cmp);
    let (median, worst) = (dampings[dampings.len() / 2], dampings[dampings.len() - 1]);
    println!("damping median {median:.4}, worst {worst:.4}; inside {inside:?} of {all}");
    assert!(median < 0.03 && worst < 0.10);
    assert!(inside.iter().all(|n| *n as f64 >= 0.88 * all as f64));
}

#[test]
fn a_window_changes_no_mode() {
    let truth = truth(&POSES[0]);
    let windowed = Settings {
        exponential_end: Some(0.01),
        ..Settings::default()
    };
    let both = [&Settings::default(), &windowed].map(|settings| found(&truth, settings, 3));
    assert!(!both[0].is_empty());
    assert_eq!(both[0], both[1]);
}

#[test]
fn a_sensor_mounted_upside_down_changes_no_pole() {
    let truth = truth(&POSES[1]);
    let blows = ["x", "y", "z"].map(|direction| {
        let blow = Blow {
            rate_hz: 1000.0,
            length_s: 3.0,
            axis: axis(direction),
            width_s: 0.008,
            ..Blow::default()
        };
        [(direction, blow); 3]
    });
    let mut test = record(&truth, &blows.concat(), 5);
    for run in &mut test.runs {
        run.responses[1].iter_mut().for_each(|v| *v = -*v);
    }
    let frf = estimate(&test, &Settings::default()).unwrap();
    assert!(matched(&truth, &modes(&frf, 50.0)).len() == 7);
}
