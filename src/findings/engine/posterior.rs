//! Probabilities of sets and of causes, and who can stand in for whom.

use super::search::Scored;
use crate::ground::stats::log_sum_exp;

/// Sets with their probabilities, best first.
#[derive(Debug, Clone)]
pub struct Posterior {
    /// The sets.
    pub sets: Vec<(Scored, f64)>,
    temper: f64,
}

impl Posterior {
    /// Of sets, best first: the empty one is among them. `temper`: exponent of their probabilities.
    pub fn of(sets: Vec<Scored>, temper: f64) -> Self {
        let total = log_sum_exp(sets.iter().map(|s| temper * s.score));
        let probable = |s: Scored| {
            let p = (temper * s.score - total).exp();
            (s, p)
        };
        Self {
            sets: sets.into_iter().map(probable).collect(),
            temper,
        }
    }

    /// Keeps the sets with at most so many causes; all, where none is left.
    pub fn keep_up_to(&mut self, causes: usize) {
        let kept = |s: (Scored, f64)| (s.0.suspects.len() <= causes).then_some(s.0);
        if causes > 0 {
            let sets = std::mem::take(&mut self.sets);
            *self = Self::of(sets.into_iter().filter_map(kept).collect(), self.temper);
        }
    }

    /// Probability that a suspect is at work.
    pub fn inclusion(&self, suspect: usize) -> f64 {
        let holding = self.sets.iter().filter(|s| s.0.suspects.contains(&suspect));
        holding.map(|s| s.1).sum::<f64>().min(1.0)
    }

    /// The set of exactly these suspects, ascending.
    pub fn set(&self, suspects: &[usize]) -> Option<&Scored> {
        let own = self.sets.iter().find(|s| s.0.suspects == suspects);
        own.map(|s| &s.0)
    }

    /// Who can take the place of one suspect of a set, with the odds against it, best first.
    pub fn stand_ins(&self, set: &Scored, suspect: usize) -> Vec<(usize, f64)> {
        let rest: Vec<usize> = set
            .suspects
            .iter()
            .copied()
            .filter(|s| *s != suspect)
            .collect();
        let swapped = |other: &Scored| {
            let extra: Vec<usize> = other
                .suspects
                .iter()
                .copied()
                .filter(|s| !rest.contains(s))
                .collect();
            let same = other.suspects.len() == set.suspects.len() && extra.len() == 1;
            (same && extra[0] != suspect)
                .then(|| (extra[0], (self.temper * (other.score - set.score)).exp()))
        };
        self.sets.iter().filter_map(|s| swapped(&s.0)).collect()
    }
}
