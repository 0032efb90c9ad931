//! The FRF of five real hammer hits equals the published reference.

use crate::common::shared;
use ident::measurement::hammer::{self, HammerRecord};
use ident::signal::frf::{CrossSpectra, Estimator, HitSpectra};
use rustfft::num_complex::Complex64;

fn spectra(record: &HammerRecord) -> Vec<HitSpectra> {
    let lines = record.runs[0].force.len() / 2 + 1;
    let runs = record.runs.iter();
    runs.map(|run| HitSpectra::new(run.force.clone(), run.responses.clone(), lines))
        .collect()
}

/// Largest and median relative difference of complex numbers given as (re, im).
struct Difference {
    worst: f64,
    median: f64,
}

/// The estimates of `file` against rows `f_Hz, H1, H2, Hv (re, im each), coherence`, except DC.
fn difference(record: &HammerRecord, rows: &str) -> Difference {
    let sums = CrossSpectra::of(&spectra(record));
    let estimates = [Estimator::H1, Estimator::H2, Estimator::Hv].map(|e| sums.estimate(0, e));
    let coherence = sums.coherence(0);
    let mut all = Vec::new();
    for row in rows.lines().skip(1).filter(|row| !row.contains("nan")) {
        let row: Vec<f64> = row.split(',').map(|c| c.parse().unwrap()).collect();
        let k = row[0] as usize;
        for (e, estimate) in estimates.iter().enumerate() {
            let reference = Complex64::new(row[1 + 2 * e], row[2 + 2 * e]);
            all.push((estimate[k] - reference).norm() / reference.norm());
        }
        all.push((coherence[k] - row[7]).abs() / row[7]);
    }
    all.sort_by(f64::total_cmp);
    Difference {
        worst: all[all.len() - 1],
        median: all[all.len() / 2],
    }
}

#[test]
fn equals_pyfrf_on_the_same_numbers() {
    let Some(file) = shared("frf/hammer_5_hits.csv") else {
        return;
    };
    let record = hammer::read_hammer(&file).unwrap();
    assert_eq!((record.runs.len(), record.interval_s), (5, 1.0 / 25600.0));
    // pyFRF 1.5.0 on this very file, written with 16 digits.
    let found = difference(&record, include_str!("data/hammer_5_hits_pyfrf.csv"));
    assert!(found.worst < 1e-9, "worst {:e}", found.worst);
}

/// The shared reference was computed before the hits were rounded to six digits, so it can be met
/// only to within that rounding: pyFRF itself, on the rounded hits, is as far away from it.
#[test]
fn equals_the_shared_reference_to_within_its_rounding() {
    let (Some(file), Some(reference)) = (
        shared("frf/hammer_5_hits.csv"),
        shared("frf/hammer_5_hits_reference.csv"),
    ) else {
        return;
    };
    let record = hammer::read_hammer(&file).unwrap();
    let found = difference(&record, &std::fs::read_to_string(reference).unwrap());
    println!("worst {:e}, median {:e}", found.worst, found.median);
    assert!(found.median < 1e-5 && found.worst < 5e-4);
}
