//! What every kind of data behind the engine may blame: its own table of effects, as text.

use crate::findings::table::Effect;
use crate::findings::{cubes, force_sensor, milled_part, milling_force, screw};
use serde::Serialize;

/// An effect of one kind of data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Known {
    /// Name, as in the answers.
    pub name: &'static str,
    /// Kind of data in which it shows.
    pub kind: &'static str,
    /// What it is, one sentence.
    pub summary: &'static str,
    /// Effects of one mechanism hardly ever act together.
    pub mechanism: &'static str,
    /// What would tell it from rivals, a phrase.
    pub would_tell: &'static str,
}

/// All of them, kind by kind.
pub fn known() -> Vec<Known> {
    [
        of("cubes", cubes::EFFECTS),
        of("force-sensor", force_sensor::EFFECTS),
        of("screw", screw::EFFECTS),
        of("milling-force", milling_force::EFFECTS),
        of("milled-part", milled_part::EFFECTS),
    ]
    .concat()
}

fn of<C>(kind: &'static str, effects: &[Effect<C>]) -> Vec<Known> {
    let one = |effect: &Effect<C>| Known {
        name: effect.name,
        kind,
        summary: effect.summary,
        mechanism: effect.mechanism,
        would_tell: effect.would_tell,
    };
    effects.iter().map(one).collect()
}
