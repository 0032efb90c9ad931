//! Milling forces whose noise is coloured, or whose spindle swings: neither is a cause.

use crate::diagnose_milling_force::{Bench, NOISE, is_named, names};
use ident::findings::Verdict;
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// A charge amplifier's noise rises towards low frequencies: relaxations of a decade each, as large as the white part together.
fn slow_noise(rows: &mut [[f64; 5]], size: f64) {
    let mut random = Random::new(9);
    for k in 2..5 {
        for rate in [20.0, 200.0, 2000.0] {
            let (mut state, mut before) = (random.normal(), 0.0);
            for row in rows.iter_mut() {
                let kept = f64::exp(-rate * (row[1] - before));
                state = kept * state + (1.0 - kept * kept).sqrt() * random.normal();
                before = row[1];
                row[k] += size * state;
            }
        }
    }
}

#[test]
fn noise_that_rises_towards_low_frequencies_is_no_cause() {
    let bench = Bench::new(3);
    let mut rows = bench.rows();
    slow_noise(&mut rows, NOISE);
    let sound = bench.diagnosed(&rows).answer;
    assert_eq!(sound.verdict, Verdict::Sufficient, "{:?}", names(&sound));
    let mut bench = Bench::new(3);
    (0..3).for_each(|j| bench.truth[j] *= 1.25);
    let mut rows = bench.rows();
    slow_noise(&mut rows, NOISE);
    is_named(&bench.diagnosed(&rows), "cutting_coefficients");
}

/// The spindle swings by a degree and a half at 35 Hz: every reading is that of a moment before or after.
#[test]
fn a_spindle_that_swings_is_no_chatter() {
    let bench = Bench::new(3);
    let rows = bench.rows();
    let step = rows[1][1] - rows[0][1];
    let swung = |i: usize| {
        let ahead = 42e-6 / step * (TAU * 35.0 * rows[i][1]).sin();
        let other =
            &rows[(i as i64 + ahead.signum() as i64).clamp(0, rows.len() as i64 - 1) as usize];
        let mut row = rows[i];
        if other[0] == row[0] {
            (2..5).for_each(|k| row[k] += ahead.abs() * (other[k] - row[k]));
        }
        row
    };
    let answer = bench
        .diagnosed(&(0..rows.len()).map(swung).collect::<Vec<_>>())
        .answer;
    assert!(
        names(&answer).iter().all(|n| n.0 != "chatter"),
        "{:?}",
        names(&answer)
    );
    assert_ne!(answer.verdict, Verdict::Explained);
}
