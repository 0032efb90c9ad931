//! Diagnosis of joint motion before data by a judge of its own (`tests/judge/joint_motion`).
//!
//! `IDENT_BLIND_SEED` and `IDENT_JUDGE_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses (2: everything).
//! `cargo test --test suite judge_joint_motion:: -- --nocapture` prints the rates.

use crate::judge::joint_motion::draw;
use crate::judge::{Floors, conclude, judged};

/// Mended on seeds 511 to 514 and 541 to 544 (150 cases each). Seeds 551 to 553, at which nobody had looked: clean 114 of
/// 119, single 170 of 185, pair 53 of 70, outside 60 of 70, untrue names in 1 of 450.
#[test]
fn joints_by_strangers_are_judged_rightly() {
    let rates = conclude("joint-motion", &judged(draw, 24));
    let floors = Floors {
        clean: 0.85,
        single: 0.7,
        pair: 0.25,
        outside: 0.5,
        wrong: 0.08,
    };
    floors.hold(&rates);
}
