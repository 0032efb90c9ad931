//! Diagnosis of force steps in the workspace before data by a judge of its own (`tests/judge/workspace.rs`).
//!
//! `IDENT_BLIND_SEED` and `IDENT_JUDGE_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses (2: everything),
//! `IDENT_JUDGE_KEEP` names a folder for the files. `cargo test --test suite judge_workspace:: -- --nocapture` prints
//! the rates.

use crate::judge;

use crate::judge::{Floors, conclude, gains, judged};

/// Three seeds (1 to 3) of 300 cases: clean 174 of 189, single 308 of 380, pair 119 of 171, outside 48 of 71, untrue names
/// in 40 of 740. Before finite turns were part of the simulation: 148, 244, 83, 50, and 27.
#[test]
fn points_by_strangers_are_judged_rightly() {
    let all = judged(judge::workspace::draw, 40);
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
