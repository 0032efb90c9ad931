//! Diagnosis of hammer tests before data by a judge of its own (`tests/judge/hammer`).
//!
//! `IDENT_BLIND_SEED` and `IDENT_JUDGE_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses (2: everything).
//! `cargo test --test suite judge_hammer:: -- --nocapture` prints the rates.

use crate::judge::hammer::{checked, draw, exact};
use crate::judge::{Floors, conclude, judged, judged_from};

/// The judge's own dynamics against `ident simulate frf`, in the band and in time.
#[test]
fn two_dynamics_agree() {
    checked(0);
    checked(3);
}

/// Nothing is wrong but noise: nothing may be said.
#[test]
fn a_robot_as_its_file_is_sufficient() {
    let rates = conclude("exact hammer", &judged(exact, 1));
    let clean = rates.of("clean");
    assert_eq!(clean.right, clean.all);
}

/// Seed 41, 130 cases: clean 25 of 27, single 54 of 60, pair 20 of 29, outside 6 of 14, untrue names in 3 of 116 and in
/// 3 of the 14. All seven false `unknown-cause` are of files with noise that grows towards low frequency.
#[test]
fn hammers_of_strangers_are_judged_rightly() {
    let rates = conclude("hammer", &judged_from(draw, 7, 2));
    let floors = Floors {
        clean: 0.8,
        single: 0.8,
        pair: 0.5,
        outside: 0.2,
        wrong: 0.08,
    };
    floors.hold(&rates);
}
