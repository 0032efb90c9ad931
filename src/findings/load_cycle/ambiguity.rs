//! Comparing sets of causes: evidence, probabilities, and what cannot be told apart.

use super::refine::Refined;
use std::collections::BTreeMap;

/// Prior probability that any one cause is present.
pub const PRIOR: f64 = 0.08;

/// A law that misses the truth by this share of its own size still counts as right: nature does not
/// follow our formulas exactly (coarsened likelihood, Miller and Dunson 2019).
pub const FORMULA_ERROR: f64 = 0.07;

/// Nats that such a misfit is worth at most.
const TOLERATED_NATS: f64 = 5.0;

/// How much of the evidence counts when the whole misfit is worth `nats`.
pub fn temper(nats: f64) -> f64 {
    1.0 / (1.0 + FORMULA_ERROR * FORMULA_ERROR * nats.max(0.0) / TOLERATED_NATS)
}

/// Log evidence of a set: tempered likelihood less the price of its amplitudes (Schwarz 1978), of
/// its shapes (Laplace: a shape that the data do not see costs nothing) and of its causes.
pub fn score(set: &Refined, rows: usize, temper: f64) -> f64 {
    let amplitudes = 0.5 * set.amplitudes as f64 * (rows as f64).ln();
    let shapes: f64 = set
        .information
        .iter()
        .map(|v| 0.5 * (temper * v).ln_1p())
        .sum();
    let price = amplitudes + shapes + set.surprise;
    let odds = (PRIOR / (1.0 - PRIOR)).ln();
    temper * set.nats - price + set.causes.len() as f64 * odds
}

/// Sets with their probabilities, best first; the empty set (nothing wrong) is among them.
pub struct Posterior {
    /// Causes of each set, sorted; one entry per set of causes (its best law).
    pub sets: Vec<(Vec<&'static str>, f64, Option<usize>)>,
}

impl Posterior {
    /// Probabilities of the refined sets and of the empty one.
    pub fn new(refined: &[Refined], rows: usize, temper: f64) -> Self {
        let mut best: BTreeMap<Vec<&'static str>, (f64, Option<usize>)> = BTreeMap::new();
        best.insert(Vec::new(), (0.0, None));
        for (index, set) in refined.iter().enumerate() {
            let value = score(set, rows, temper);
            let entry = best.entry(set.causes.clone()).or_insert((f64::MIN, None));
            if value > entry.0 {
                *entry = (value, Some(index));
            }
        }
        let top = best.values().map(|v| v.0).fold(f64::MIN, f64::max);
        let total: f64 = best.values().map(|v| (v.0 - top).exp()).sum();
        let mut sets: Vec<_> = best
            .into_iter()
            .map(|(causes, (value, index))| (causes, (value - top).exp() / total, index))
            .collect();
        sets.sort_by(|a, b| b.1.total_cmp(&a.1));
        Self { sets }
    }

    /// Probability of exactly these causes (sorted).
    pub fn of(&self, causes: &[&'static str]) -> f64 {
        self.sets
            .iter()
            .find(|s| s.0 == causes)
            .map_or(0.0, |s| s.1)
    }

    /// Probability that a cause is present.
    pub fn inclusion(&self, cause: &str) -> f64 {
        self.sets
            .iter()
            .filter(|s| s.0.contains(&cause))
            .map(|s| s.1)
            .sum()
    }

    /// Causes that can stand in for `cause` in the set `chosen`: same set otherwise, with at least
    /// `share` of the chosen set's probability.
    pub fn stand_ins(
        &self,
        chosen: &[&'static str],
        cause: &'static str,
        share: f64,
    ) -> Vec<(&'static str, f64)> {
        let own = self
            .sets
            .iter()
            .find(|s| s.0 == chosen)
            .map_or(0.0, |s| s.1);
        let others: Vec<_> = chosen.iter().copied().filter(|c| *c != cause).collect();
        let mut found = Vec::new();
        for (causes, probability, _) in &self.sets {
            let extra: Vec<_> = causes
                .iter()
                .copied()
                .filter(|c| !others.contains(c))
                .collect();
            let same_rest = causes.len() == others.len() + 1 && extra.len() == 1;
            if same_rest && extra[0] != cause && *probability >= share * own {
                found.push((extra[0], probability / (probability + own)));
            }
        }
        found
    }
}
