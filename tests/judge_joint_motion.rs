//! Diagnosis of joint motion before data by a judge of its own (`tests/judge/joint_motion`).
//!
//! `IDENT_BLIND_SEED` and `IDENT_JUDGE_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses (2: everything).
//! `cargo test --test suite judge_joint_motion:: -- --nocapture` prints the rates.

use crate::judge::joint_motion::draw;
use crate::judge::{Floors, conclude, judged};

#[test]
fn joints_by_strangers_are_judged_rightly() {
    let rates = conclude("joint-motion", &judged(draw, 24));
    let floors = Floors {
        clean: 0.5,
        single: 0.4,
        pair: 0.0,
        outside: 0.0,
        wrong: 0.3,
    };
    floors.hold(&rates);
}
