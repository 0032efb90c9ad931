//! Probabilities of sets and of seats.

use super::search::Set;

/// Sets with their probabilities, best first.
pub struct Posterior {
    /// The sets.
    pub sets: Vec<(Set, f64)>,
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
        Self {
            sets: sets.into_iter().map(share).collect(),
        }
    }

    /// Probability of exactly these seats (ascending).
    pub fn of(&self, seats: &[usize]) -> f64 {
        let own = self.sets.iter().find(|(s, _)| s.seats == seats);
        own.map_or(0.0, |(_, p)| *p)
    }

    /// Probability that a seat is among the causes.
    pub fn inclusion(&self, seat: usize) -> f64 {
        let with = self.sets.iter().filter(|(s, _)| s.seats.contains(&seat));
        with.map(|(_, p)| p).sum()
    }

    /// Seats that can stand for `seat` among `chosen`, the others kept, with at least `share` of the
    /// probability of the chosen: seat, its set, its probability against the chosen one.
    pub fn stand_ins(&self, chosen: &[usize], seat: usize, share: f64) -> Vec<(usize, &Set, f64)> {
        let own = self.of(chosen);
        let rest: Vec<usize> = chosen.iter().copied().filter(|s| *s != seat).collect();
        let mut found = Vec::new();
        let mut most = own;
        for (set, p) in &self.sets {
            let mut extra = set.seats.iter().filter(|s| !rest.contains(s));
            let one = (extra.next(), extra.next());
            if let (Some(other), None) = one {
                let same = set.seats.len() == rest.len() + 1 && *other != seat;
                if same && *p >= share * most {
                    most = most.max(*p);
                    found.push((*other, set, p / (p + own)));
                }
            }
        }
        found
    }
}
