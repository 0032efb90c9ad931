//! A short, repeatable run of the fuzzer: mutated files are read or refused, never a panic.
//!
//! `IDENT_FUZZ_SECONDS=600` goes on with other mutations for that long.

use crate::mutation::mutate;
use ident::effects::Composite;
use ident::fit::inspection::inspect;
use ident::fit::observation::Observation;
use ident::fit::stiffness::{Request, identify};
use ident::ground::problem::Outcome;
use ident::ground::random::Random;
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;
use std::path::Path;
use std::time::{Duration, Instant};

/// Mutated files of an ordinary run.
const CASES: u64 = 3000;

fn seeds() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds");
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    paths.iter().map(|p| std::fs::read(p).unwrap()).collect()
}

/// Pieces that readers stumble over.
const PIECES: &[&[u8]] = &[
    b"\n",
    b"\r\n",
    b"\r",
    b",",
    b";",
    b"\t",
    b"\"",
    b"#",
    b"# ",
    b"=",
    b"\0",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"-",
    b"+",
    b"e",
    b"1e999",
    b"1e300",
    b"1e-320",
    b"NaN",
    b"inf",
    b"-0",
    b",,,",
    b"0,5",
    b"1.234,5",
    b"9".as_slice(),
    b"99999999999999999999",
    b" ",
    b"\n\n\n",
    b"# joint = 7\n",
    b"# load_lever_m = 1e-308\n",
    b"# sensor_delay_s = 1e9\n",
    b"_mm",
    b"kN",
    b"# kind = \"load-cycle\"\n",
    b"time_s",
    b"\xc3\xa4",
    b"[",
    b"]",
    b"{",
    b"}",
];

/// Whatever was read is inspected and fitted: numbers are finite, or not there.
fn account(file: &LoadCycle) {
    inspect(file);
    let account = identify(
        file,
        &Request {
            model: Composite::named(&["backlash"]).unwrap(),
            bootstrap: 0,
            seed: 1,
        },
    );
    for parameter in &account.parameters {
        let numbers = [parameter.value, parameter.stderr, parameter.limit95];
        let ends = parameter.ci95.into_iter().flatten();
        let finite = numbers
            .into_iter()
            .flatten()
            .chain(ends)
            .all(f64::is_finite);
        assert!(finite, "{parameter:?}");
    }
}

/// What the fuzz target does with the bytes, and what comes after.
fn read(bytes: &[u8]) -> Outcome<()> {
    let table = Table::from_reader(Path::new("fuzz.csv"), bytes, bytes.len() as u64)?;
    let file = LoadCycle::from_table(table)?;
    assert!(
        file.load
            .iter()
            .chain(&file.deflection)
            .all(|v| v.is_finite())
    );
    let data = Observation::of(&file, 600);
    assert_eq!(data.rows(), data.cycles.of_row.len());
    assert!(data.cycles.starts.iter().all(|s| *s < data.rows()));
    account(&file);
    Ok(())
}

fn case(seeds: &[Vec<u8>], number: u64) -> bool {
    let random = &mut Random::new(number);
    let mut bytes = seeds[random.below(seeds.len())].clone();
    for _ in 0..1 + random.below(4) {
        mutate(&mut bytes, seeds, PIECES, random);
    }
    let outcome = std::panic::catch_unwind(|| read(&bytes));
    match outcome.unwrap_or_else(|_| panic!("case {number}: {:?}", String::from_utf8_lossy(&bytes)))
    {
        Ok(()) => true,
        Err(problem) => {
            assert!(
                !problem.what.is_empty() && !problem.remedy.is_empty(),
                "case {number}"
            );
            false
        }
    }
}

#[test]
fn mutated_files_are_read_or_refused() {
    let seeds = seeds();
    let seconds = std::env::var("IDENT_FUZZ_SECONDS").ok();
    let longer = seconds
        .and_then(|s| s.parse().ok())
        .map(Duration::from_secs);
    let start = Instant::now();
    let (mut number, mut lawful) = (0, 0);
    while number < CASES || longer.is_some_and(|l| start.elapsed() < l) {
        lawful += u64::from(case(&seeds, number));
        number += 1;
    }
    println!("{number} mutated files, {lawful} of them read");
    assert!(
        lawful * 10 > number,
        "mutations too wild: {lawful} of {number} were read"
    );
}
