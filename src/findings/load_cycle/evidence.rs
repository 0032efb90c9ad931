//! What a noise is chosen by.

use super::noise::Coloured;
use crate::findings::engine::bank::Bank;
use crate::findings::engine::rest::Span;
use crate::findings::engine::{Member, Statement};

/// Sizes of structure that may stand beside colour, noise deviations, and its price, nats.
const STRUCTURED: ([f64; 3], f64) = ([1.5, 6.0, 25.0], 8.0);

/// Greatest evidence of some sets under a noise, their prices paid, and what its nuisances take up; structure of unknown make may stand beside the
/// first and the empty one, or it would be taken for colour. `waves`: the sets as [`Record::in_waves`](super::statement::Record) has them, and how many of the
/// nuisances are kept.
pub(super) fn evidence(
    (waves, kept): (&mut Statement, usize),
    noise: &Coloured,
    sets: &[(Vec<Member>, f64)],
) -> (f64, f64) {
    waves.noise = Box::new(noise.of_waves());
    let others = waves.nuisances.split_off(kept.min(waves.nuisances.len()));
    let best = evidence_of(waves, noise, sets);
    waves.nuisances.extend(others);
    best
}

fn evidence_of(waves: &Statement, noise: &Coloured, sets: &[(Vec<Member>, f64)]) -> (f64, f64) {
    let (generic, bank) = (Span::of(waves), Bank::new(waves));
    let last = sets.len().saturating_sub(1);
    let mut first = 0;
    let mut best = f64::NEG_INFINITY;
    for (k, (members, price)) in sets.iter().enumerate() {
        let own: Vec<usize> = (first..first + members.len()).collect();
        first += members.len();
        let Some(fit) = bank.fit(&own) else { continue };
        let span = generic.as_ref().filter(|_| k == 0 || k == last);
        let structured = span.map_or(f64::NEG_INFINITY, |span| {
            span.greatest(&bank, &fit, &STRUCTURED.0) - STRUCTURED.1
        });
        best = best.max(fit.posterior.ln_evidence.max(structured) - price);
    }
    (best - noise.ln_size(), bank.room())
}
