//! Diagnosis of hammer tests before data by a judge of its own (`tests/judge/hammer`).
//!
//! `IDENT_BLIND_SEED` and `IDENT_JUDGE_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses (2: everything).
//! `cargo test --test suite judge_hammer:: -- --nocapture` prints the rates.

use crate::judge::hammer::{checked, draw, exact};
use crate::judge::{Floors, conclude, judged};

/// The judge's own dynamics against `ident simulate frf`, in the band and in time.
#[test]
fn two_dynamics_agree() {
    checked(0);
    checked(3);
}

/// Nothing is wrong but noise: nothing may be said.
#[test]
fn a_robot_as_its_file_is_sufficient() {
    let rates = conclude("exact hammer", &judged(exact, 2));
    let clean = rates.of("clean");
    assert_eq!(clean.right, clean.all);
}

#[test]
fn hammers_of_strangers_are_judged_rightly() {
    let rates = conclude("hammer", &judged(draw, 4));
    let floors = Floors {
        clean: 0.0,
        single: 0.0,
        pair: 0.0,
        outside: 0.0,
        wrong: 1.0,
    };
    floors.hold(&rates);
}
