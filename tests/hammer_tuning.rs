//! From simulated hits to dampings: the whole way, with and without exponential window.

use crate::common::{Blow, Mode, axis, record, robot};
use ident::experiments::hammer_frf::{Settings, estimate};
use ident::fit::frf_measured::measured;
use ident::fit::frf_model::{Kind, Pose};
use ident::fit::frf_tuning::{Parameter, Residuals, Tuned, Tuning, tune};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// The structure in modal coordinates: unit masses, stiffness ω², damping 2ζω to be found.
fn pose(modes: &[Mode]) -> Pose {
    let n = modes.len();
    let diagonal =
        |f: &dyn Fn(usize) -> f64| DMatrix::from_fn(n, n, |i, j| if i == j { f(i) } else { 0.0 });
    Pose {
        mass: DMatrix::identity(n, n),
        damping: DMatrix::zeros(n, n),
        stiffness: diagonal(&|i| (TAU * modes[i].hz).powi(2)),
        jacobian: DMatrix::from_fn(3, n, |row, i| modes[i].shape[row]),
        directions: (0..n)
            .map(|p| diagonal(&|i| f64::from(u8::from(i == p))))
            .collect(),
        weight: None,
        uncertain: None,
        measured: Vec::new(),
    }
}

fn tuned(modes: &[Mode], settings: &Settings) -> Tuned {
    let mut blows = Vec::new();
    for direction in ["x", "y", "z"] {
        blows.extend(
            [(
                direction,
                Blow {
                    axis: axis(direction),
                    ..Blow::default()
                },
            ); 4],
        );
    }
    let frf = estimate(&record(modes, &blows, 12), settings).unwrap();
    let mut pose = pose(modes);
    pose.measured = measured(&frf, 2.0, 50.0);
    let parameter = |m: &Mode| Parameter {
        site: format!("{} Hz", m.hz),
        kind: Kind::Damping,
        start: 2.0 * 0.03 * TAU * m.hz,
        bounds: [1e-3, 1e3],
        prior_ln_std: None,
        nuisance: false,
    };
    let parameters = modes.iter().map(parameter).collect();
    tune(&Tuning {
        parameters,
        poses: vec![pose],
        residuals: Residuals::None,
        starts: 3,
    })
    .unwrap()
}

fn check(name: &str, settings: &Settings, least_inside: usize) {
    let modes = robot();
    let tuned = tuned(&modes, settings);
    let below = modes.iter().enumerate().filter(|(_, m)| m.hz < 45.0);
    let mut inside = 0;
    for (i, mode) in below {
        let truth = 2.0 * mode.damping * TAU * mode.hz;
        let error = tuned.values[i] / truth - 1.0;
        let [low, high] = tuned.uncertainty.statements[i].ci95.unwrap();
        inside += usize::from((low..=high).contains(&truth));
        println!(
            "{name}: {} Hz {:+.3} %, interval ± {:.3} %",
            mode.hz,
            100.0 * error,
            50.0 * (high - low) / truth
        );
        assert!(error.abs() < 0.01);
    }
    assert!(inside >= least_inside, "{name}: {inside} of 6 inside");
    let matches = tuned.matches.iter().flatten();
    let worst = matches
        .clone()
        .map(|[_, after]| after.log_error_db)
        .fold(0.0, f64::max);
    let frac = matches.map(|[_, after]| after.frac).fold(1.0, f64::min);
    println!(
        "{name}: FRAC at least {frac:.5}, amplitude error at most {worst:.3} dB, chi² {:.2}",
        tuned.reduced_chi_square
    );
    assert!(frac > 0.99 && worst < 0.5);
}

#[test]
fn dampings_from_hits_without_window() {
    // The 7e-4 of the slowest decay that the records cut off is not in the model without a window.
    check("no window", &Settings::default(), 4);
}

#[test]
fn dampings_from_hits_with_exponential_window() {
    let settings = Settings {
        exponential_end: Some(0.01),
        ..Settings::default()
    };
    check("exponential 1 %", &settings, 5);
}
