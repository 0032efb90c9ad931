//! A short, repeatable run of a fuzzer over every reader of tool paths and over job files. A longer one,
//! reader by reader: `cargo run --release --example fuzz_readers 120`.

use crate::paths::{case, read, seeds};

/// Mutated files of each seed.
const CASES: u64 = 2000;

#[test]
fn seeds_are_read() {
    for seed in seeds() {
        read(&seed.path, &seed.bytes).unwrap_or_else(|problem| panic!("{problem}"));
    }
}

#[test]
fn mutated_paths_and_jobs_are_read_or_refused() {
    let seeds = seeds();
    let number = CASES * seeds.len() as u64;
    let which = |number: u64| number as usize % seeds.len();
    let lawful = (0..number).filter(|n| case(&seeds, which(*n), *n)).count();
    println!("{number} mutated files, {lawful} of them read");
    assert!(
        lawful as u64 * 10 > number,
        "mutations too wild: {lawful} of {number} were read"
    );
}
