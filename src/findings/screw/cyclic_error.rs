//! An error that repeats with every turn of the screw (harmonic 1), or with a part of it: a bent or
//! eccentric screw, a coupling. Targets that are whole turns apart do not show it.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, together};
use crate::fit::screw::cyclic::Sight;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "cyclic_error",
    summary: "The error repeats with every turn of the screw.",
    mechanism: "turn",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("screw", members(case))],
    parameters: |_, blamed| {
        vec![
            ("amplitude", blamed.amounts[0].hypot(blamed.amounts[1]), "m"),
            ("phase", blamed.amounts[1].atan2(blamed.amounts[0]), "rad"),
            ("harmonic", blamed.shape[0], "1"),
        ]
    },
    would_tell: "measure at targets that are not whole turns of the screw apart",
};

/// Harmonics that are tried.
const HARMONICS: i32 = 3;

fn members(case: &Case) -> Vec<Member> {
    let Some(pitch) = case.test.facts.pitch else {
        return Vec::new();
    };
    if matches!(case.sight, Sight::Blind | Sight::Few) {
        return Vec::new();
    }
    let wave = |h: i32| {
        let angle =
            |i: usize| std::f64::consts::TAU * f64::from(h) * case.test.readings[i].target / pitch;
        together(
            vec![
                case.column(|i| angle(i).sin()),
                case.column(|i| angle(i).cos()),
            ],
            &[f64::from(h)],
        )
    };
    (1..=HARMONICS).map(wave).collect()
}
