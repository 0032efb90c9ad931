//! Diagnosis of force steps in the workspace before data by a judge of its own (`tests/judge/workspace.rs`).
//!
//! `IDENT_BLIND_SEED` and `IDENT_JUDGE_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses (2: everything),
//! `IDENT_JUDGE_KEEP` names a folder for the files. `cargo test --test suite judge_workspace:: -- --nocapture` prints
//! the rates.

use crate::common::few_or_all;
use crate::judge;

use crate::judge::{Floors, conclude, gains, judged};

/// Three seeds (1 to 3) of 300 cases: clean 174 of 189, single 308 of 380, pair 119 of 171, outside 48 of 71, untrue names
/// in 40 of 740. Seeds 77 and 78, 300 cases each: 89 of 101, 226 of 267, 73 of 97, 50 of 64, 25 of 465; seeds 79 and 80, whose
/// single answers nobody had looked at: 123 of 133, 205 of 240, 90 of 129, 27 of 40, 27 of 502. Before finite turns were part of the simulation, seeds 1 to 3: 148, 244, 83, 50, and 27.
#[test]
fn points_by_strangers_are_judged_rightly() {
    let all = judged(judge::workspace::draw, few_or_all(10, 40));
    let rates = conclude("workspace", &all);
    gains(&all, judge::workspace::worth).conclude("workspace");
    let floors = Floors {
        clean: 0.8,
        single: 0.75,
        pair: 0.5,
        outside: 0.3,
        wrong: 0.12,
    };
    floors.hold(&rates);
}
