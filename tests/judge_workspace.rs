//! Diagnosis of force steps in the workspace before data by a judge of its own (`tests/judge/workspace.rs`).
//!
//! `IDENT_BLIND_SEED` and `IDENT_JUDGE_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses (2: everything),
//! `IDENT_JUDGE_KEEP` names a folder for the files. `cargo test --test suite judge_workspace:: -- --nocapture` prints
//! the rates.

use crate::judge;

use crate::judge::{Floors, conclude, gains, judged};

/// Three seeds of 300 cases: clean 148 of 189, single 244 of 380, pair 83 of 171, outside 50 of 71, untrue names in 27 of
/// 740. In a laboratory without drift, coarse load cell, noise that grows with the load nor set-ups askew, and with
/// displacements so small that turns add up, none of 44 clean files is blamed.
#[test]
fn points_by_strangers_are_judged_rightly() {
    let all = judged(judge::workspace::draw, 40);
    let rates = conclude("workspace", &all);
    gains(&all, judge::workspace::worth).conclude("workspace");
    let floors = Floors {
        clean: 0.6,
        single: 0.55,
        pair: 0.25,
        outside: 0.3,
        wrong: 0.12,
    };
    floors.hold(&rates);
}
