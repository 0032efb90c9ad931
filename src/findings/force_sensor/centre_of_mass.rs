//! The centre of mass lies elsewhere than it is said to.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, each_and_all};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "centre_of_mass",
    summary: "The centre of mass lies elsewhere than it is said to.",
    mechanism: "centre",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| match case.stated[1] {
        true => vec![Place::new("tool", members(case))],
        false => Vec::new(),
    },
    parameters: |case, blamed| {
        const NAMES: [&str; 3] = ["com_x", "com_y", "com_z"];
        let own = blamed.shape.iter().zip(&blamed.amounts);
        own.map(|(k, amount)| {
            (
                NAMES[*k as usize],
                case.nominal[1 + *k as usize] + amount,
                "m",
            )
        })
        .collect()
    },
    would_tell: "measure with the sensor level, turned about its own axis",
};

fn members(case: &Case) -> Vec<Member> {
    each_and_all(3, |k| case.parameter(1 + k))
}
