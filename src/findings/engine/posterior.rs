//! Probabilities of sets and of causes, and who can stand in for whom.

use super::search::Scored;
use crate::ground::stats::log_sum_exp;
use std::collections::HashMap;

/// A set of causes that was weighed.
pub trait Weighed {
    /// The suspects, ascending.
    fn suspects(&self) -> &[usize];
    /// Evidence over that of no cause, less the prices, nats.
    fn score(&self) -> f64;
}

impl Weighed for Scored {
    fn suspects(&self) -> &[usize] {
        &self.suspects
    }

    fn score(&self) -> f64 {
        self.score
    }
}

/// Sets with their probabilities, best first.
#[derive(Debug, Clone)]
pub struct Posterior<S = Scored> {
    /// The sets.
    pub sets: Vec<(S, f64)>,
    /// Where each stands.
    index: HashMap<Vec<usize>, usize>,
    temper: f64,
}

impl<S: Weighed> Posterior<S> {
    /// Of sets, best first: the empty one is among them. `temper`: exponent of their probabilities.
    pub fn of(sets: Vec<S>, temper: f64) -> Self {
        let total = log_sum_exp(sets.iter().map(|s| temper * s.score()));
        let probable = |s: S| {
            let p = (temper * s.score() - total).exp();
            (s, p)
        };
        let sets: Vec<(S, f64)> = sets.into_iter().map(probable).collect();
        let place = |(i, s): (usize, &(S, f64))| (s.0.suspects().to_vec(), i);
        Self {
            index: sets.iter().enumerate().map(place).collect(),
            sets,
            temper,
        }
    }

    /// Keeps the sets with at most so many causes; all, where none is left.
    pub fn keep_up_to(&mut self, causes: usize) {
        let kept = |s: (S, f64)| (s.0.suspects().len() <= causes).then_some(s.0);
        if causes > 0 {
            let sets = std::mem::take(&mut self.sets);
            *self = Self::of(sets.into_iter().filter_map(kept).collect(), self.temper);
        }
    }

    /// Probability that a suspect is at work.
    pub fn inclusion(&self, suspect: usize) -> f64 {
        let holds = |s: &&(S, f64)| s.0.suspects().contains(&suspect);
        self.sets
            .iter()
            .filter(holds)
            .map(|s| s.1)
            .sum::<f64>()
            .min(1.0)
    }

    /// Probability that a suspect of a set or one that can take its place is at work.
    pub fn inclusion_of_place(&self, set: &S, suspect: usize) -> f64 {
        let swapped: f64 = self.stand_ins(set, suspect).iter().map(|r| r.1).sum();
        (self.inclusion(suspect) * (1.0 + swapped)).min(1.0)
    }

    /// The set of exactly these suspects, ascending.
    pub fn set(&self, suspects: &[usize]) -> Option<&S> {
        self.index.get(suspects).map(|at| &self.sets[*at].0)
    }

    /// Odds of one set against another.
    pub fn odds(&self, set: &S, against: &S) -> f64 {
        self.tempered(set.score() - against.score()).exp()
    }

    /// Logarithm of the odds of what is worth so many nats more.
    pub fn tempered(&self, more: f64) -> f64 {
        self.temper * more
    }

    /// Who can take the place of one suspect of a set, with the odds against it, best first. Of a set that was not weighed, as what
    /// is left of one that was: who can in the best that holds it.
    pub fn stand_ins(&self, set: &S, suspect: usize) -> Vec<(usize, f64)> {
        let holds = |s: &&S| set.suspects().iter().all(|own| s.suspects().contains(own));
        let weighed = || self.sets.iter().map(|s| &s.0).find(holds);
        let set = self.set(set.suspects()).or_else(weighed).unwrap_or(set);
        let rest = without(set.suspects(), suspect);
        let swapped = |other: &S| {
            let all = other.suspects();
            let mut extra = all.iter().copied().filter(|s| !rest.contains(s));
            let other_one = extra.next().filter(|s| *s != suspect)?;
            let same = all.len() == set.suspects().len() && extra.next().is_none();
            same.then(|| (other_one, self.odds(other, set)))
        };
        self.sets.iter().filter_map(|s| swapped(&s.0)).collect()
    }
}

/// Suspects less one.
pub fn without(suspects: &[usize], suspect: usize) -> Vec<usize> {
    let others = suspects.iter().copied().filter(|s| *s != suspect);
    others.collect()
}

#[cfg(test)]
mod tests {
    use super::{Posterior, Weighed};

    struct Set(Vec<usize>, f64);

    impl Weighed for Set {
        fn suspects(&self) -> &[usize] {
            &self.0
        }

        fn score(&self) -> f64 {
            self.1
        }
    }

    #[test]
    fn a_place_is_as_probable_as_all_that_can_take_it() {
        let sets = vec![
            Set(vec![1], 5.0),
            Set(vec![2], 5.0),
            Set(vec![3], 4.0),
            Set(vec![], 0.0),
        ];
        let posterior = Posterior::of(sets, 1.0);
        let leader = &posterior.sets[0].0;
        let none = posterior.sets[3].1;
        assert!(posterior.inclusion(1) < 0.5);
        assert!((posterior.inclusion_of_place(leader, 1) - (1.0 - none)).abs() < 1e-12);
    }
}
