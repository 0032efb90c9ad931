//! The hammer bounces.

use super::contract::{Card, Cause, Sight};
use crate::effects::Family;

/// See the card.
pub struct DoubleHit;

const CARD: Card = Card {
    name: "double_hit",
    family: Family::Measurement,
    summary: "The hammer struck twice in most hits of a direction: repeat them with a lighter blow.",
    equation: "f′(t) = f(t) + a·f(t − τ)",
    source: "ISO 7626-5: repeated impacts",
    shows: &[(
        Sight::Hammer,
        "a second pulse in the force record, ripples over frequency in the force spectrum",
    )],
    amounts: &[],
};

impl Cause for DoubleHit {
    fn card(&self) -> &'static Card {
        &CARD
    }
}
