//! The FRF of five real hammer hits equals the published reference.

use ident::measurement::hammer::{self, HammerRecord};
use ident::signal::frf::{CrossSpectra, Estimator, HitSpectra};
use std::path::PathBuf;

/// The shared data, where they are; `None` says that they are absent.
fn shared(name: &str) -> Option<PathBuf> {
    let root = std::env::var_os("IDENT_SHARED_DATA").map(PathBuf::from);
    let root = root.unwrap_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data"));
    let path = root.join(name);
    if !path.exists() {
        println!("passed over: {name} is not in the shared data");
        return None;
    }
    Some(path)
}

fn spectra(record: &HammerRecord) -> Vec<HitSpectra> {
    let lines = record.runs[0].force.len() / 2 + 1;
    let runs = record.runs.iter();
    runs.map(|run| HitSpectra::new(run.force.clone(), run.responses.clone(), lines))
        .collect()
}

fn close(value: f64, reference: f64, scale: f64) -> bool {
    (value - reference).abs() <= 1e-9 * scale
}

#[test]
fn five_hits_equal_the_reference() {
    let (Some(file), Some(reference)) = (
        shared("frf/hammer_5_hits.csv"),
        shared("frf/hammer_5_hits_reference.csv"),
    ) else {
        return;
    };
    let record = hammer::read_hammer(&file).unwrap();
    assert_eq!((record.runs.len(), record.interval_s), (5, 1.0 / 25600.0));
    let sums = CrossSpectra::of(&spectra(&record));
    let estimates = [Estimator::H1, Estimator::H2, Estimator::Hv].map(|e| sums.estimate(0, e));
    let coherence = sums.coherence(0);
    let text = std::fs::read_to_string(reference).unwrap();
    for (k, row) in text.lines().skip(1).enumerate().skip(1) {
        let row: Vec<f64> = row.split(',').map(|c| c.parse().unwrap()).collect();
        for (e, estimate) in estimates.iter().enumerate() {
            let (re, im) = (row[1 + 2 * e], row[2 + 2 * e]);
            let size = re.hypot(im);
            let h = estimate[k];
            assert!(close(h.re, re, size) && close(h.im, im, size), "line {k}: {h} is not {re}+{im}i");
        }
        assert!(close(coherence[k], row[7], row[7]), "coherence at line {k}");
    }
    assert!(estimates[0][0].re.is_nan());
}
