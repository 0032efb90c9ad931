//! Time from file to stiffness: `cargo bench --bench load_cycle`.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use ident::effects::Composite;
use ident::fit::stiffness::{DEFAULT_EFFECTS, Request, identify};
use ident::laboratory::truth::Truth;
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;
use std::hint::black_box;
use std::path::Path;

/// The sixth axis of the example campaign, sampled so that about this many rows come out.
fn recording(rows: f64) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210");
    let mut truth = Truth::read(&folder.join("truth.toml")).unwrap();
    let mut test = truth.load_cycle.remove(5);
    test.step_s = (test.cycle_s * test.cycles as f64 + test.rest_s) / rows;
    let recording = test.record(&truth.robot, &truth.source, 1);
    recording.unwrap().text()
}

fn read(text: &str) -> LoadCycle {
    let table = Table::from_reader(Path::new("bench.csv"), text.as_bytes(), text.len() as u64);
    LoadCycle::from_table(table.unwrap()).unwrap()
}

fn reading(criterion: &mut Criterion) {
    let text = recording(1e5);
    let mut group = criterion.benchmark_group("read");
    group.throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("100 000 rows", |b| b.iter(|| read(black_box(&text))));
}

fn identifying(criterion: &mut Criterion) {
    let request = Request {
        model: Composite::named(DEFAULT_EFFECTS).unwrap(),
        bootstrap: 0,
        seed: 1,
    };
    let mut group = criterion.benchmark_group("identify");
    group.sample_size(10);
    for (name, rows) in [("1 600 rows", 1.6e3), ("100 000 rows", 1e5)] {
        let file = read(&recording(rows));
        group.bench_function(name, |b| b.iter(|| identify(black_box(&file), &request)));
    }
}

criterion_group!(benches, reading, identifying);
criterion_main!(benches);
