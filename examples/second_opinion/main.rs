//! A second opinion on load cycles: `cargo run --release --example second_opinion FILE..`.
//!
//! Causes are sought as *families* of shapes, one per mechanism, on the engine of `findings::engine`, where
//! `ident diagnose` fits one law per cause with a search of its own. Put in the place of that search (with its
//! tests of scale and lattice after it) and asked about 120 cases of laws other than ours (`tests/stranger.rs`,
//! seed 2), it named 59 of 62 single causes right where `diagnose` named 49, 9 of 15 pairs (5), left 31 of 31
//! clean files alone (19), and erred in 8 % (23 %). It is not the default because the colour of its noise
//! still swallows structure from outside the library: it flagged 38 % of that of `tests/blind.rs`, `diagnose`
//! more than 90 %.

mod families;
mod noise;
mod span;
mod statement;

use families::View;
use ident::effects::{EFFECTS, Effect};
use ident::findings::engine::{Judgement, diagnose};
use ident::findings::sentence::sentences;
use ident::fit::observation::Observation;
use ident::ground::problem::Outcome;
use ident::measurement::load_cycle::LoadCycle;
use noise::jumps;
use statement::Record;
use std::path::Path;

/// Rows that a record is averaged to.
const ROWS: usize = 1000;

/// Isolated changes of level that are no noise: coloured noise swallows a structure with many kinks, its
/// differences do not.
const JUMPS: usize = 5;

fn main() {
    let files: Vec<String> = std::env::args().skip(1).collect();
    if files.is_empty() {
        eprintln!("give files of kind load-cycle");
        std::process::exit(2);
    }
    for file in files {
        match opinion(Path::new(&file)) {
            Ok(said) => println!("{file}: {said}"),
            Err(problem) => {
                eprintln!("{problem}");
                std::process::exit(2);
            }
        }
    }
}

fn opinion(path: &Path) -> Outcome<String> {
    let file = LoadCycle::read(path)?;
    let data = Observation::of(&file, ROWS);
    let library: Vec<&'static dyn Effect> = EFFECTS.to_vec();
    let site = |_: &'static str| file.site();
    let unit = file.port.deflection_unit();
    let record = Record::new(&data, (unit, None), &library, &site);
    let found = diagnose(&record, &Judgement::default());
    let mut sentences = sentences(&found.answer);
    let levels = jumps(&found.left, &View::of(&data));
    if levels >= JUMPS || record.noise.is_humming(&found.left) {
        sentences.push(
            "What is left jumps from level to level, or hums: no effect of the library does."
                .into(),
        );
    }
    let sentences = sentences.join("\n  ");
    Ok(format!("{}\n  {sentences}", found.answer.verdict.name()))
}
