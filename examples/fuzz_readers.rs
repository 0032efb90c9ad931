//! Fuzzes every reader of tool paths and the reader of jobs, one after the other:
//! `cargo run --release --example fuzz_readers SECONDS [FIRST_CASE]`. A panic, a number that is none or a
//! refusal without line and remedy ends it with the file that did it.

#[path = "../tests/mutation/mod.rs"]
mod mutation;
#[path = "../tests/mutation/paths.rs"]
mod paths;

use paths::{case, seeds};
use std::time::{Duration, Instant};

fn main() {
    let mut words = std::env::args().skip(1);
    let number = |word: Option<String>, default: u64| {
        word.map_or(default, |word| word.parse().expect("a whole number"))
    };
    let seconds = number(words.next(), 10);
    let first = number(words.next(), 1_000_000);
    let seeds = seeds();
    for (which, seed) in seeds.iter().enumerate() {
        let start = Instant::now();
        let (mut cases, mut lawful) = (0, 0);
        while start.elapsed() < Duration::from_secs(seconds) {
            lawful += u64::from(case(&seeds, which, first + cases));
            cases += 1;
        }
        let name = seed.path.file_name().unwrap_or_default().to_string_lossy();
        println!("{name}: {seconds} s, {cases} mutated files, {lawful} of them read");
    }
}
