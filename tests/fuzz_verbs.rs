//! A short, repeatable run of the fuzzer over every reader and every verb; the long one is
//! `cargo run --release --example fuzz -- --seconds 600`.

use crate::mutation::verbs::{ENTRIES, seed};
use rayon::prelude::*;
use std::path::Path;

/// Spoiled files of each entry.
const CASES: u64 = 2;

#[test]
fn every_verb_survives_spoiled_files() {
    let program = Path::new(env!("CARGO_BIN_EXE_ident"));
    ENTRIES.par_iter().for_each(|entry| {
        for number in 0..CASES {
            let bytes = entry.spoiled(number);
            let ended = entry.run(program, &bytes);
            assert!(ended.is_ok(), "{} {number}: {ended:?}", entry.name);
        }
    });
}

#[test]
fn every_seed_is_understood() {
    let program = Path::new(env!("CARGO_BIN_EXE_ident"));
    ENTRIES.par_iter().for_each(|entry| {
        let ended = entry.run(program, &seed(entry.files[0]));
        let understood = ended.as_ref().is_ok_and(|ended| ended.status < 2);
        assert!(understood, "{}: {ended:?}", entry.name);
    });
}
