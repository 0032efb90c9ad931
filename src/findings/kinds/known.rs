//! What every kind of data behind the engine may blame, as text: the effects of its own table.

use super::KINDS;
use crate::findings::table::Effect;
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

/// The effects of a kind's own table, of the kind of this name.
pub type Table = fn(&'static str) -> Vec<Known>;

/// All of them, kind by kind.
pub fn known() -> Vec<Known> {
    KINDS
        .iter()
        .flat_map(|(kind, _, table)| table(kind))
        .collect()
}

/// A kind whose effects all stand in the tables of joints ([`crate::effects::EFFECTS`]) and of the whole robot
/// ([`crate::causes::CAUSES`]).
pub(super) fn of_all(_: &'static str) -> Vec<Known> {
    Vec::new()
}

/// Those of a table.
pub(super) fn of<C>(kind: &'static str, effects: &[Effect<C>]) -> Vec<Known> {
    let one = |effect: &Effect<C>| Known {
        name: effect.name,
        kind,
        summary: effect.summary,
        mechanism: effect.mechanism,
        would_tell: effect.would_tell,
    };
    effects.iter().map(one).collect()
}
