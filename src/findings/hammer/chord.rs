//! What a cause promises beside what is found, without a descent.

use super::data::Data;
use super::map::{Fit, measured, weights};
use super::point::Point;
use super::prediction::{Machine, stack};
use super::suspect::Suspect;
use nalgebra::DVector;

/// A start this near shows the tangent.
const NEAR: f64 = 0.05;
/// How far a partner may be from its start for the straight line to count, in starts.
const REACH: f64 = 2.0;

/// Nats that `suspect` promises beside what is found, along the straight line to its best start.
pub fn promise(
    machine: &Machine,
    data: &Data,
    base: &Fit,
    suspect: &Suspect,
) -> Option<(f64, Point)> {
    let chord = Chord::of(machine, data, base, suspect);
    let starts = suspect.starts();
    let near = suspect.tangents().into_iter();
    let near = near.filter_map(|start| chord.to(&start, NEAR));
    let tried = starts.iter().filter_map(|start| chord.to(start, 1.0));
    tried.chain(near).max_by(|a, b| a.0.total_cmp(&b.0))
}

/// The straight line from what is found to what a cause would show beside it.
pub(super) struct Chord<'a> {
    machine: &'a Machine<'a>,
    data: &'a Data,
    base: &'a Fit,
    suspect: &'a Suspect,
    weights: Vec<f64>,
    /// What is shown where the base ended, weighted.
    now: Vec<f64>,
}

impl<'a> Chord<'a> {
    pub(super) fn of(
        machine: &'a Machine,
        data: &'a Data,
        base: &'a Fit,
        suspect: &'a Suspect,
    ) -> Self {
        let weights = weights(data);
        let measured = measured(data);
        let each = weights.iter().zip(&measured).zip(base.residual.iter());
        Self {
            now: each.map(|((w, m), r)| m * w - r).collect(),
            machine,
            data,
            base,
            suspect,
            weights,
        }
    }

    /// Nats that so much of `start` promises, and the point on the line where it does.
    pub(super) fn to(&self, start: &[f64], share: f64) -> Option<(f64, Point)> {
        let (base, suspect) = (self.base, self.suspect);
        let scaled = suspect.times(start, share);
        let point = base.point.and(suspect, &scaled);
        let nuisance = self.machine.nuisance(&point).ok()?;
        let mut full = point.clone();
        full.theta.resize(nuisance.len(), 0.0);
        let mut rows = Vec::with_capacity(self.weights.len());
        let shown = self.machine.predict(&nuisance, &full, self.data).ok()?;
        stack(self.data, &shown, &mut rows);
        let column = rows.iter().zip(&self.weights).zip(&self.now);
        let column = column.map(|((p, w), now)| p * w - now);
        let column = DVector::from_iterator(self.weights.len(), column);
        let (nats, times) = base.promise(&column, REACH / share);
        // a body that hangs one way hangs the other way too: less than none of it is no body
        if times <= 0.0 && !suspect.is_named() {
            return None;
        }
        let amounts = suspect.times(&scaled, times);
        Some((nats, base.point.and(suspect, &within(suspect, &amounts))))
    }
}

/// Amounts inside their bounds, and not quite nothing.
fn within(suspect: &Suspect, amounts: &[f64]) -> Vec<f64> {
    let bounds = suspect.bounds().into_iter();
    let inside = |([low, high], a): ([f64; 2], &f64)| match a.abs() < NEAR {
        true => NEAR.clamp(low, high),
        false => a.clamp(low, high),
    };
    bounds.zip(amounts).map(inside).collect()
}
