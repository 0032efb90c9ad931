//! FRF of 30 hits of 204 800 samples and 3 responses: `cargo bench --bench frf`.
//! pyFRF 1.5.0 takes 270 ms for the same on one thread.

use criterion::{Criterion, criterion_group, criterion_main};
use ident::ground::random::Random;
use ident::signal::frf::{Estimator, accumulate};
use std::hint::black_box;

const HITS: usize = 30;
const SAMPLES: usize = 204_800;
const RESPONSES: usize = 3;

fn frf(criterion: &mut Criterion) {
    let mut random = Random::new(1);
    let record =
        |random: &mut Random| -> Vec<f64> { (0..SAMPLES).map(|_| random.unit() - 0.5).collect() };
    let hits: Vec<(Vec<f64>, Vec<Vec<f64>>)> = (0..HITS)
        .map(|_| {
            let force = record(&mut random);
            (force, (0..RESPONSES).map(|_| record(&mut random)).collect())
        })
        .collect();
    let mut group = criterion.benchmark_group("frf");
    group.sample_size(10);
    group.bench_function("30 hits x 204800 samples x 3 responses", |bench| {
        bench.iter(|| {
            let sums = accumulate(&hits, SAMPLES / 2 + 1);
            let results =
                (0..RESPONSES).map(|o| (sums.estimate(o, Estimator::H1), sums.coherence(o)));
            black_box(results.collect::<Vec<_>>())
        });
    });
    group.finish();
}

criterion_group!(benches, frf);
criterion_main!(benches);
