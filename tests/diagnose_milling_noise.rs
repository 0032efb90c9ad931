//! Milling forces whose noise is coloured, or whose spindle swings: neither is a cause.

use crate::diagnose_milling_force::{Bench, NOISE, is_named, names};
use ident::findings::Verdict;
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// A charge amplifier's noise rises towards low frequencies: relaxations of a decade each, every one as large as the white part.
fn slow_noise(rows: &mut [[f64; 5]], channels: std::ops::Range<usize>, size: f64) {
    let mut random = Random::new(9);
    for k in channels.map(|channel| 2 + channel) {
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
#[ignore = "takes long: .ci/thorough runs it"]
fn noise_that_rises_towards_low_frequencies_is_no_cause() {
    let bench = Bench::new(3);
    // one amplifier may be worse than the others
    for channels in [0..3, 0..1] {
        let mut rows = bench.rows();
        slow_noise(&mut rows, channels, NOISE);
        let sound = bench.diagnosed(&rows).answer;
        assert_eq!(sound.verdict, Verdict::Sufficient, "{:?}", names(&sound));
    }
    let mut bench = Bench::new(3);
    (0..3).for_each(|j| bench.truth[j] *= 1.25);
    let mut rows = bench.rows();
    slow_noise(&mut rows, 0..3, NOISE);
    is_named(&bench.diagnosed(&rows), "cutting_coefficients");
}

/// A spindle that swings by a degree and a half: every reading is that of a moment before or after.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_spindle_that_swings_is_no_chatter() {
    let bench = Bench::new(3);
    let rows = bench.rows();
    let step = rows[1][1] - rows[0][1];
    let swung = |i: usize, hz: f64| {
        let ahead = 42e-6 / step * (TAU * hz * rows[i][1]).sin();
        let other = (i as i64 + ahead.signum() as i64).clamp(0, rows.len() as i64 - 1);
        let (mut row, other) = (rows[i], &rows[other as usize]);
        if other[0] == row[0] {
            (2..5).for_each(|k| row[k] += ahead.abs() * (other[k] - row[k]));
        }
        row
    };
    // 200 Hz is farther from the nearest harmonic of the teeth than from others
    for hz in [35.0, 200.0] {
        let rows: Vec<[f64; 5]> = (0..rows.len()).map(|i| swung(i, hz)).collect();
        let answer = bench.diagnosed(&rows).answer;
        let named = names(&answer);
        assert!(named.iter().all(|n| n.0 != "chatter"), "{hz}: {named:?}");
        assert_ne!(answer.verdict, Verdict::Explained, "{hz}");
    }
}

/// A cable that knocks in the last cut, about every 7 ms, and rings each time.
#[test]
fn what_knocks_and_rings_is_no_chatter() {
    let bench = Bench::new(3);
    let mut rows = bench.rows();
    let mut random = Random::new(11);
    let last = rows[rows.len() - 1];
    let begin = rows
        .iter()
        .find(|row| row[0] == last[0])
        .map_or(0.0, |r| r[1]);
    let mut knock = begin;
    while knock < last[1] {
        let turned = [random.normal(), random.normal(), random.normal()];
        for row in rows.iter_mut().filter(|r| r[0] == last[0] && r[1] > knock) {
            let since = row[1] - knock;
            let rung = (-since / 1.5e-3).exp() * (TAU * 1437.0 * since).sin();
            (0..3).for_each(|k| row[2 + k] += 12.0 * NOISE * turned[k] * rung);
        }
        knock += random.uniform(4e-3, 1e-2);
    }
    let answer = bench.diagnosed(&rows).answer;
    let named = names(&answer);
    assert!(named.iter().all(|n| n.0 != "chatter"), "{named:?}");
    assert_ne!(answer.verdict, Verdict::Explained, "{named:?}");
}

/// The amplifiers hum a little on all channels, and the tool runs out by a fifth of a micrometre.
#[test]
fn what_every_laboratory_has_is_no_fault() {
    let mut bench = Bench::new(3);
    bench.runs_out(2e-7);
    bench.turns = 16.0;
    let mut rows = bench.rows();
    for row in &mut rows {
        (0..3).for_each(|k| row[2 + k] += 0.6 * NOISE * (TAU * 150.0 * row[1] + k as f64).sin());
    }
    let answer = bench.diagnosed(&rows).answer;
    assert_eq!(answer.verdict, Verdict::Sufficient, "{:?}", names(&answer));
}

/// A charge that leaks away within a fifth of a second of cutting: what lasts is forgotten.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_charge_that_leaks_is_no_story_of_drift_and_offset() {
    let bench = Bench::new(3);
    let mut rows = bench.rows();
    let (mut held, mut before) = ([0.0; 3], rows[0][1]);
    for row in &mut rows {
        let kept = ((before - row[1]) / 0.2).exp();
        before = row[1];
        for (k, own) in held.iter_mut().enumerate() {
            *own = kept * *own + (1.0 - kept) * row[2 + k];
            row[2 + k] -= *own;
        }
    }
    let answer = bench.diagnosed(&rows).answer;
    let named = names(&answer);
    assert_eq!(answer.verdict, Verdict::UnknownCause, "{named:?}");
    assert!(named.iter().all(|n| n.0 != "sensor_offset"), "{named:?}");
}
