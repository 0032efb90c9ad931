//! A set of causes as it was fitted, as the engine weighs it.

use super::map::Fit;
use super::suspect::{Suspect, same};
use crate::findings::engine::posterior::Weighed;

/// A fitted set of causes.
#[derive(Clone)]
pub struct Set {
    /// The fit.
    pub fit: Fit,
    /// Its causes by their place among all suspects, ascending.
    suspects: Vec<usize>,
    /// Its log evidence.
    score: f64,
}

impl Weighed for Set {
    fn suspects(&self) -> &[usize] {
        &self.suspects
    }

    fn score(&self) -> f64 {
        self.score
    }
}

impl Set {
    /// Of a fit; none where it has no evidence when only the share `temper` of every squared residual counts.
    pub fn of(fit: Fit, all: &[Suspect], temper: f64) -> Option<Self> {
        let score = fit.evidence_at(temper)?;
        let own = fit.point.set.iter().map(|own| place(all, own));
        let mut suspects: Vec<usize> = own.collect::<Option<_>>()?;
        suspects.sort_unstable();
        Some(Self {
            fit,
            suspects,
            score,
        })
    }

    /// What was not compared: fewer causes, fitted anew. It is no better than what it was told from.
    pub fn refitted(&self, suspects: Vec<usize>, fit: Fit) -> Self {
        Self {
            fit,
            suspects,
            score: self.score,
        }
    }
}

/// Of all fits, the best of every set of causes, best first.
pub fn sets(fits: &[Fit], all: &[Suspect], temper: f64) -> Vec<Set> {
    let each = fits.iter().cloned();
    let each = each.filter_map(|fit| Set::of(fit, all, temper));
    let mut sets: Vec<Set> = each.collect();
    sets.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut best: Vec<Set> = Vec::new();
    for set in sets {
        if !best.iter().any(|known| known.suspects == set.suspects) {
            best.push(set);
        }
    }
    best
}

/// Where a cause stands among all suspects, its forms being one.
pub fn place(all: &[Suspect], own: &Suspect) -> Option<usize> {
    all.iter().position(|other| same(other, own))
}
