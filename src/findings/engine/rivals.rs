//! Who else may be at work in the place of a named cause.

use super::judgement::Judgement;
use super::posterior::{Posterior, Weighed};

/// The rivals of one suspect of a set.
#[derive(Debug, Clone, PartialEq)]
pub struct Rivals {
    /// Those that the data cannot rule out, the most probable first.
    pub open: Vec<usize>,
    suspect: usize,
    /// Odds of the suspect and its rivals against it.
    total: f64,
}

/// Most members of a group: beyond, the data tell nothing.
const LARGEST_GROUP: usize = 6;

impl Rivals {
    /// Of those that may be named.
    pub fn of<S: Weighed>(
        posterior: &Posterior<S>,
        set: &S,
        suspect: usize,
        is_named: impl Fn(usize) -> bool,
        judgement: &Judgement,
    ) -> Self {
        let mut rivals = posterior.stand_ins(set, suspect);
        rivals.retain(|r| r.1 > judgement.ambiguous && is_named(r.0));
        rivals.truncate(LARGEST_GROUP - 1);
        let total: f64 = 1.0 + rivals.iter().map(|r| r.1).sum::<f64>();
        rivals.truncate(carrying(&rivals, judgement.group_carries * total));
        Self {
            open: rivals.into_iter().map(|r| r.0).collect(),
            suspect,
            total,
        }
    }

    /// Probability of the suspect beside them, as it is stated.
    pub fn probability<S: Weighed>(&self, posterior: &Posterior<S>, judgement: &Judgement) -> f64 {
        (posterior.inclusion(self.suspect) / self.total).min(judgement.certain)
    }
}

/// How many rivals, best first, carry so much together with the named cause, whose odds are one.
fn carrying(rivals: &[(usize, f64)], wanted: f64) -> usize {
    let before = |i: &usize| 1.0 + rivals[..*i].iter().map(|r| r.1).sum::<f64>();
    (0..rivals.len())
        .take_while(|i| before(i) < wanted - 1e-12)
        .count()
}

/// Runners-up that may be named, with their probability against the named cause.
pub fn runners_up<S: Weighed>(
    posterior: &Posterior<S>,
    set: &S,
    suspect: usize,
    is_named: impl Fn(usize) -> bool,
) -> Vec<(usize, f64)> {
    let mut rivals = posterior.stand_ins(set, suspect);
    rivals.retain(|r| is_named(r.0));
    let told = rivals.iter().take(3).filter(|r| r.1 > 1e-3);
    told.map(|(s, odds)| (*s, odds / (1.0 + odds))).collect()
}
