use super::*;
use crate::cutting::Material;
use crate::ground::units::DEGREE;

/// Mean forces of `machining-and-planning` 3.5: N = 2, a = 2 mm, c = 0.1 mm, slot, half up, half down.
const AL7075: [f64; 6] = [1319.41, 788.83, 48.75, 19.65, 26.77, 2.05];
const MEANS: [(Side, [f64; 3]); 3] = [
    (Side::Slot, [-112.9676, 156.9602, 10.3070]),
    (Side::Up, [-110.9915, 36.3285, 5.1535]),
    (Side::Down, [-1.9761, 120.6316, 5.1535]),
];

/// A tool so large that c sin φ is the chip.
fn large(helix_deg: f64, side: Side) -> (Tool, Cut) {
    let radius = 800e-3;
    let cut = Cut {
        spindle_rad_s: 1000.0,
        feed_m_s: 0.1e-3 * 2.0 * 1000.0 / TAU,
        depth_m: 2e-3,
        width_m: radius,
        side,
    };
    (Tool::square(radius, 2, helix_deg * DEGREE), cut)
}

#[test]
fn mean_forces_are_those_of_the_closed_forms_at_either_helix() {
    let material = Material::linear_edge(AL7075);
    for (side, expected) in MEANS {
        for helix in [0.0, 30.0] {
            let (tool, cut) = large(helix, side);
            let mean = mean_force(&tool, &cut, &material.coefficients);
            for k in 0..3 {
                let off = (mean[k] - expected[k]).abs();
                assert!(
                    off < 2e-3 * expected[k].abs().max(20.0),
                    "{side:?} {helix}: {mean:?}"
                );
            }
        }
    }
}

#[test]
fn runout_keeps_the_chip_of_a_whole_revolution() {
    let cut = Cut {
        spindle_rad_s: 1000.0,
        feed_m_s: 0.05,
        depth_m: 2e-3,
        width_m: 4e-3,
        side: Side::Down,
    };
    let straight = Tool::square(8e-3, 3, 0.5);
    let tilted = Tool {
        runout_m: 8e-6,
        runout_angle_rad: 0.7,
        ..straight.clone()
    };
    let [a, b] = [straight, tilted].map(|t| mean_basis(&t, &cut, 3600)[0][1]);
    assert!((a / b - 1.0).abs() < 2e-3, "{a} {b}");
}

/// A tool of five teeth that runs out by as much as a quarter of its feed.
fn running_out(helix: f64, depth_m: f64) -> (Tool, Cut, [f64; 2]) {
    let tool = Tool::square(8e-3, 5, helix);
    let cut = Cut {
        spindle_rad_s: 366.5,
        feed_m_s: 0.07e-3 * 5.0 * 366.5 / TAU,
        depth_m,
        width_m: 16e-3,
        side: Side::Slot,
    };
    (tool, cut, [9.7e-6, 15.1e-6])
}

#[test]
fn the_force_is_along_the_motion_of_the_tip() {
    let (tool, cut, runout) = running_out(0.0, 1e-3);
    let wave = Wave::new(&tool, &cut, runout, cut.width_m);
    for step in 0..500 {
        let spindle = f64::from(step) * TAU / 500.0;
        let mut along = 0.0;
        for tooth in 0..5 {
            let (angle, turned) = (spindle + f64::from(tooth) * TAU / 5.0, spindle + 0.25 * TAU);
            let x = 8e-3 * angle.sin() + runout[0] * spindle.sin() + runout[1] * turned.sin();
            let y = 8e-3 * angle.cos() + runout[0] * spindle.cos() + runout[1] * turned.cos();
            let direction = [angle.sin(), angle.cos()];
            if wave.cuts(0, tooth as usize, direction) {
                // a pull along the ray has no moment about the spindle's axis, whatever other teeth do
                along += 1e-3 * x / x.hypot(y);
            }
        }
        // the second half of the sums is one for each edge in cut: of the radial ones that of the rays
        let found = wave.basis(spindle, 0.0)[4][0];
        assert!((found + along).abs() < 2e-8, "{step}: {found} {along}");
    }
}

/// A helix is a stair of straight tools, each behind the one below it.
#[test]
fn teeth_that_run_out_enter_as_a_stair_of_straight_tools_does() {
    let (tool, cut, runout) = running_out(0.66, 1e-3);
    let wave = Wave::new(&tool, &cut, runout, cut.width_m);
    const STEPS: usize = 400;
    let step_m = cut.depth_m / STEPS as f64;
    let thin = Cut {
        depth_m: step_m,
        ..cut
    };
    let straight = Tool::square(8e-3, 5, 0.0);
    let stair = |i: usize| {
        let lag = tool.lag_rad((i as f64 + 0.5) * step_m);
        let (sin, cos) = lag.sin_cos();
        // the runout turns with the tool, so that it stands further ahead of an edge that lags
        let own = [
            runout[0] * cos - runout[1] * sin,
            runout[0] * sin + runout[1] * cos,
        ];
        (lag, Wave::new(&straight, &thin, own, cut.width_m))
    };
    let stairs: Vec<_> = (0..STEPS).map(stair).collect();
    let largest = (0..200).map(|k| {
        let spindle = f64::from(k) * TAU / 200.0;
        let sum = |axis: usize| -> f64 {
            let each = stairs.iter();
            each.map(|(lag, wave)| wave.basis(spindle - lag, 0.0)[3][axis])
                .sum()
        };
        let found = wave.basis(spindle, 0.0)[3];
        (found[0] - sum(0)).abs().max((found[1] - sum(1)).abs())
    });
    let largest = largest.fold(0.0, f64::max);
    assert!(largest < 0.02 * cut.depth_m, "{largest}");
}
