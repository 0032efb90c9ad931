//! Fuzzes every reader and every verb through the program itself:
//! `cargo build --release && cargo run --release --example fuzz -- --seconds 600`.
//!
//! Each entry of the table in `tests/mutation/verbs.rs` gets so many seconds of mutated files. Runs over
//! 10 s or 1 GB, panics, other exit statuses than 0 to 2 and refusals without a remedy are faults; the files
//! are kept in `fuzz/found`.

#[path = "../../tests/mutation/mod.rs"]
mod mutation;

use mutation::verbs::{ENTRIES, Entry};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

struct Asked {
    seconds: u64,
    only: Option<String>,
    program: PathBuf,
    start: u64,
}

fn asked() -> Asked {
    let words: Vec<String> = std::env::args().collect();
    let after = |name: &str| {
        let at = words.iter().position(|w| w == name)?;
        words.get(at + 1).cloned()
    };
    let own = std::env::current_exe().expect("a program has a path");
    let beside = own.parent().and_then(Path::parent).map(|p| p.join("ident"));
    let number = |name: &str, usual: u64| after(name).and_then(|w| w.parse().ok()).unwrap_or(usual);
    Asked {
        seconds: number("--seconds", 60),
        only: after("--only"),
        program: after("--program")
            .map(PathBuf::from)
            .or(beside)
            .expect("--program PATH"),
        start: number("--start", 0),
    }
}

/// Mutates for so long; how many runs ended how.
fn fuzz(entry: &Entry, asked: &Asked) -> usize {
    let (begin, mut number, mut counts, mut faults) = (Instant::now(), asked.start, [0; 3], 0);
    let mut lineless: BTreeMap<String, usize> = BTreeMap::new();
    while begin.elapsed() < Duration::from_secs(asked.seconds) {
        let bytes = entry.spoiled(number);
        match entry.run(&asked.program, &bytes) {
            Ok(ended) => {
                counts[ended.status as usize] += 1;
                if let Some(message) = ended.lineless {
                    *lineless.entry(message).or_default() += 1;
                }
            }
            Err(fault) => {
                faults += 1;
                let kept = keep(entry, number, &bytes);
                println!("{}: {fault:?} in {}", entry.name, kept.display());
            }
        }
        number += 1;
    }
    println!(
        "{}: {} runs in {} s: {} done, {} with attention, {} refused, {faults} faults",
        entry.name,
        number - asked.start,
        begin.elapsed().as_secs(),
        counts[0],
        counts[1],
        counts[2],
    );
    for (message, times) in lineless {
        println!("  without a line, {times} times: {message}");
    }
    faults
}

fn keep(entry: &Entry, number: u64, bytes: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/found");
    let name = entry.name.replace([' ', ','], "-");
    let path = folder.join(format!("{name}-{number}"));
    std::fs::create_dir_all(&folder)
        .and_then(|()| std::fs::write(&path, bytes))
        .expect("fuzz/found can be written");
    path
}

fn main() {
    let asked = asked();
    let meant = |entry: &&Entry| {
        asked
            .only
            .as_ref()
            .is_none_or(|only| entry.name.contains(only.as_str()))
    };
    let faults: usize = ENTRIES
        .iter()
        .filter(meant)
        .map(|entry| fuzz(entry, &asked))
        .sum();
    std::process::exit(i32::from(faults > 0));
}
