//! Load cycles whose load goes in steps and is read in coarse ones, and causes smaller than the noise of one reading.

use ident::findings::{Diagnosis, Settings, Verdict, diagnose};
use ident::ground::random::Random;
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;
use std::fmt::Write;
use std::path::Path;

/// Stiffness, N/m, noise of the deflection, m, and rows for which the load stands.
const STIFFNESS: f64 = 2e6;
const NOISE: f64 = 1e-6;
const STAND: usize = 24;

/// Loads on a stair up and down between both ends, N: as they are, no multiples of anything.
fn stair() -> Vec<f64> {
    let mut random = Random::new(3);
    let steps = [
        0.0, 1.0, 2.0, 3.0, 4.0, 3.0, 2.0, 1.0, 0.0, -1.0, -2.0, -3.0, -4.0, -3.0, -2.0, -1.0,
    ];
    let cycles = (0..3).flat_map(|_| steps);
    cycles
        .map(|k| 110.0 * k + 14.0 * random.uniform(-1.0, 1.0))
        .collect()
}

/// A file whose load cell shows whole multiples of `step`, N; `bent`: what is not elastic, m, over the load.
fn file(step: f64, bent: impl Fn(f64) -> f64) -> String {
    let mut random = Random::new(8);
    let mut text = "# kind = \"load-cycle\"\n# synthetic = true\n# nominal_stiffness_N_m = 2e6\n\
                    # nominal_stiffness_rel_std = 0.03\ntime_s,force_N,displacement_um\n"
        .to_string();
    for (k, load) in stair().into_iter().enumerate() {
        let read = (load / step).round() * step;
        for i in 0..STAND {
            let time = 0.1 * (k * STAND + i) as f64;
            let way = load / STIFFNESS + bent(load) + NOISE * random.normal();
            writeln!(text, "{time:.1},{read:.3},{:.4}", 1e6 * way).unwrap();
        }
    }
    text
}

fn diagnosed(text: &str) -> Diagnosis {
    let table = Table::from_reader(Path::new("axis.csv"), text.as_bytes(), text.len() as u64);
    diagnose(
        &LoadCycle::from_table(table.unwrap()).unwrap(),
        &Settings::default(),
    )
}

fn names_the_asymmetry(text: &str) {
    let found = diagnosed(text);
    let named: Vec<&str> = found.causes.iter().map(|c| c.effect).collect();
    let told = format!("{:?} {:?}", found.verdict, found.groups);
    assert_eq!(named, ["asymmetry"], "{told}");
}

/// A load cell that shows steps of 19 N is off by the same as long as the load stands: 4.75 µm at most here, which no law of the robot makes.
#[test]
fn a_coarse_load_cell_is_no_unknown_cause() {
    let found = diagnosed(&file(19.0, |_| 0.0));
    assert_eq!(found.verdict, Verdict::Sufficient, "{:?}", found.causes);
    // what is there besides is seen all the same
    names_the_asymmetry(&file(19.0, |load| 25e-6 * (load / 440.0).powi(2)));
}

/// An asymmetry of about the noise of one reading shows in a thousand of them.
#[test]
fn what_many_readings_show_is_named() {
    names_the_asymmetry(&file(0.01, |load| 1.2e-6 * (load / 440.0).abs()));
    let found = diagnosed(&file(0.01, |_| 0.0));
    assert_eq!(found.verdict, Verdict::Sufficient, "{:?}", found.causes);
}
