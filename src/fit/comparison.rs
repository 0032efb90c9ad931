//! One fit of a record against another: what is left that neighbours do not share, and what one law gains over another.

use super::observation::Observation;
use super::solution::Solution;
use crate::signal::colour::Colour;
use crate::signal::smooth::noise;

/// What a model leaves, over the scatter of neighbours, above which something is sought that it lacks.
const LEFT: f64 = 1.03;

/// Nats by which what was not asked for must be ahead (Jeffreys 1961: beyond reasonable doubt).
pub const BEYOND: f64 = 5.0;

/// Whether a fit leaves more than the scatter of neighbours.
pub fn misses(fitted: &Solution) -> bool {
    fitted.rms > LEFT * noise(&fitted.residual)
}

/// Nats that so many parameters more cost: half the logarithm of the rows each (Schwarz 1978).
pub fn price(parameters: f64, rows: usize) -> f64 {
    0.5 * parameters * (rows as f64).ln()
}

/// Rise of the log likelihood from one noise to another, each that of its own residual.
pub fn nats(before: &Colour, after: &Colour) -> f64 {
    let each = before.sigma.iter().zip(&after.sigma);
    each.map(|(b, a)| (b / a).ln()).sum()
}

/// Nats by which one fit is ahead of another of the same data, the price of its parameters taken off.
pub fn ahead(one: &Solution, other: &Solution, data: &Observation) -> f64 {
    let more = one.model.len() as f64 - other.model.len() as f64;
    nats(&other.colour, &one.colour) - price(more, data.rows())
}
