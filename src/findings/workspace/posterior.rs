//! Probabilities of sets and of seats.

use super::search::Set;
use std::collections::HashMap;

/// Sets with their probabilities, best first.
pub struct Posterior {
    /// The sets.
    pub sets: Vec<(Set, f64)>,
    /// Where each stands.
    index: HashMap<Vec<usize>, usize>,
}

impl Posterior {
    /// Of sets that were compared, best first.
    pub fn new(sets: Vec<Set>) -> Self {
        let top = sets.first().map_or(0.0, |s| s.score);
        let total: f64 = sets.iter().map(|s| (s.score - top).exp()).sum();
        let share = |s: Set| {
            let p = (s.score - top).exp() / total;
            (s, p)
        };
        let sets: Vec<(Set, f64)> = sets.into_iter().map(share).collect();
        let place = |(i, (set, _)): (usize, &(Set, f64))| (set.seats.clone(), i);
        Self {
            index: sets.iter().enumerate().map(place).collect(),
            sets,
        }
    }

    /// Probability of exactly these seats (ascending).
    pub fn of(&self, seats: &[usize]) -> f64 {
        self.index.get(seats).map_or(0.0, |i| self.sets[*i].1)
    }

    /// Probability that a seat is among the causes.
    pub fn inclusion(&self, seat: usize) -> f64 {
        let with = self.sets.iter().filter(|(s, _)| s.seats.contains(&seat));
        with.map(|(_, p)| p).sum()
    }

    /// Seats that can stand for `seat` among `chosen`, the others kept, each with its set and its
    /// probability against the chosen one, most probable first.
    pub fn stand_ins(&self, chosen: &[usize], seat: usize) -> Vec<(usize, &Set, f64)> {
        let own = self.of(chosen);
        let rest: Vec<usize> = chosen.iter().copied().filter(|s| *s != seat).collect();
        let mut found = Vec::new();
        for (set, p) in &self.sets {
            let mut extra = set.seats.iter().filter(|s| !rest.contains(s));
            if let (Some(other), None) = (extra.next(), extra.next())
                && set.seats.len() == rest.len() + 1
                && *other != seat
            {
                found.push((*other, set, p / (p + own)));
            }
        }
        found
    }

    /// The stand-ins, of those that are `known`, that together with the chosen one are the cause with
    /// probability `sure`, given that it is one of them all.
    pub fn rivals(
        &self,
        chosen: &[usize],
        seat: usize,
        (sure, known): (f64, impl Fn(usize) -> bool),
    ) -> Vec<(usize, &Set)> {
        let mut all = self.stand_ins(chosen, seat);
        all.retain(|other| known(other.0));
        let own = self.of(chosen);
        let total: f64 = own + all.iter().map(|s| self.of(&s.1.seats)).sum::<f64>();
        let mut held = own;
        let mut found = Vec::new();
        for (other, set, _) in all {
            let p = self.of(&set.seats);
            if held >= sure * total && p <= own {
                break;
            }
            held += p;
            found.push((other, set));
        }
        found
    }
}
