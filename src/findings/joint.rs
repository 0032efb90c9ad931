//! One inference over all experiments on a robot: their evidence for every set of physical causes is
//! multiplied. What one experiment cannot see it does not judge; what two can see must suit both.
//!
//! The amounts of a cause are fitted by each experiment alone: whether these agree is what
//! [`super::campaign::Check`] says.

use super::answer::Group;
use super::belief::{Belief, PRIOR, Place};

/// A cause that at least one experiment thinks possible.
#[derive(Debug, Clone, PartialEq)]
pub struct Together {
    /// The cause and its site.
    pub place: Place,
    /// Probability by each experiment alone; `None` where it would not show.
    pub alone: Vec<Option<f64>>,
    /// Probability by all of them.
    pub probability: f64,
}

/// What all experiments believe together.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// The experiments.
    pub tests: Vec<String>,
    /// Causes, most probable first.
    pub causes: Vec<Together>,
    /// The most probable set of causes, in order.
    pub best: Vec<Place>,
}

/// Sets of one experiment that are combined with those of the others; combinations that go on.
const COMBINED: usize = 30;
const KEPT: usize = 300;
/// Causes less probable than this, alone and together, are not listed.
const LISTED: f64 = 0.02;
/// A member of a group with this probability by all experiments is told from the others.
const TOLD: f64 = 0.95;

impl Joint {
    /// Of at least two experiments; one alone has nothing to be joined with.
    pub fn of(beliefs: &[(String, &Belief)]) -> Option<Self> {
        if beliefs.len() < 2 {
            return None;
        }
        let beliefs_only: Vec<&Belief> = beliefs.iter().map(|b| b.1).collect();
        let sets = weighed(&beliefs_only);
        let best = sets.first()?.0.clone();
        Some(Self {
            tests: beliefs.iter().map(|b| b.0.clone()).collect(),
            causes: causes(&beliefs_only, &sets),
            best,
        })
    }

    /// Probability of a cause by all experiments.
    pub fn probability(&self, place: &Place) -> f64 {
        let own = self.causes.iter().find(|c| c.place == *place);
        own.map_or(0.0, |c| c.probability)
    }

    /// Which member of a group all experiments together tell from the others, with its probability.
    pub fn told(&self, group: &Group) -> Option<(Place, f64)> {
        let members = group
            .effects
            .iter()
            .copied()
            .zip(group.sites.iter().cloned());
        let judged = members.map(|place| {
            let p = self.probability(&place);
            (place, p)
        });
        let best = judged.max_by(|a, b| a.1.total_cmp(&b.1));
        best.filter(|(_, p)| *p > TOLD)
    }
}

/// Sets of causes with their probability by all experiments, best first.
fn weighed(beliefs: &[&Belief]) -> Vec<(Vec<Place>, f64)> {
    let mut sets: Vec<Vec<Place>> = vec![Vec::new()];
    for (i, belief) in beliefs.iter().enumerate() {
        let own = belief.sets.iter().take(COMBINED);
        let joined = own.flat_map(|set| sets.iter().map(|s| union(s, &set.causes)));
        let mut joined: Vec<Vec<Place>> = joined.chain(sets.iter().cloned()).collect();
        joined.sort();
        joined.dedup();
        let so_far = &beliefs[..=i];
        joined.sort_by(|a, b| score(so_far, b).total_cmp(&score(so_far, a)));
        joined.truncate(KEPT);
        sets = joined;
    }
    let scores: Vec<f64> = sets.iter().map(|set| score(beliefs, set)).collect();
    let top = scores.first().copied().unwrap_or(0.0);
    let total: f64 = scores.iter().map(|s| (s - top).exp()).sum();
    let share = scores.into_iter().map(|s| (s - top).exp() / total);
    sets.into_iter().zip(share).collect()
}

fn union(a: &[Place], b: &[Place]) -> Vec<Place> {
    let mut all: Vec<Place> = a.iter().chain(b).cloned().collect();
    all.sort();
    all.dedup();
    all
}

/// Prior odds once, and the evidence of every experiment.
fn score(beliefs: &[&Belief], causes: &[Place]) -> f64 {
    let evidence = beliefs.iter().map(|b| b.ln_evidence(&b.visible(causes)));
    causes.len() as f64 * PRIOR.ln() + evidence.sum::<f64>()
}

fn causes(beliefs: &[&Belief], sets: &[(Vec<Place>, f64)]) -> Vec<Together> {
    let mut places: Vec<Place> = sets.iter().flat_map(|s| s.0.clone()).collect();
    places.sort();
    places.dedup();
    let together = |place: Place| Together {
        alone: beliefs.iter().map(|b| b.inclusion(&place)).collect(),
        probability: sets
            .iter()
            .filter(|s| s.0.contains(&place))
            .map(|s| s.1)
            .sum(),
        place,
    };
    let listed = |c: &Together| {
        let alone = c.alone.iter().flatten().copied().fold(0.0, f64::max);
        c.probability > LISTED || alone > LISTED
    };
    let mut all: Vec<Together> = places.into_iter().map(together).filter(listed).collect();
    all.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::builtin::named;

    fn at(site: &str) -> Place {
        ("drive_stiffness", site.to_string())
    }

    /// An experiment that sees `sees` and believes in these sets.
    fn belief(sees: &[&str], sets: &[(&[&str], f64)]) -> Belief {
        let robot = named("kr210").unwrap().unwrap();
        let sets = sets.iter().map(|(sites, p)| {
            let causes = sites.iter().map(|site| at(site)).collect();
            let causes: Vec<Place> = causes;
            let odds = causes.len() as f64 * PRIOR.ln();
            (causes, *p, odds, robot.clone())
        });
        Belief::new(sees.iter().map(|site| at(site)).collect(), sets)
    }

    fn joint(beliefs: &[&Belief]) -> Joint {
        let all: Vec<(String, &Belief)> = beliefs.iter().map(|b| (String::new(), *b)).collect();
        Joint::of(&all).unwrap()
    }

    #[test]
    fn two_tests_separate_what_neither_does() {
        let a = belief(&["A1", "A2", "A3"], &[(&["A1"], 0.5), (&["A2"], 0.5)]);
        let b = belief(&["A1", "A2", "A3"], &[(&["A2"], 0.5), (&["A3"], 0.5)]);
        let joint = joint(&[&a, &b]);
        assert_eq!(joint.best, [at("A2")]);
        assert!(joint.probability(&at("A2")) > 0.95, "{joint:?}");
    }

    #[test]
    fn a_test_does_not_judge_what_it_cannot_see() {
        let a = belief(&["A1"], &[(&["A1"], 1.0)]);
        let b = belief(&["A2"], &[(&[], 0.5), (&["A2"], 0.5)]);
        let joint = joint(&[&a, &b]);
        assert!(joint.probability(&at("A1")) > 0.99);
        assert!((joint.probability(&at("A2")) - 0.5).abs() < 1e-6);
        assert_eq!(joint.causes[0].alone, [Some(1.0), None]);
    }

    #[test]
    fn a_cause_that_would_show_and_does_not_is_less_probable() {
        let a = belief(&["A1"], &[(&[], 0.1), (&["A1"], 0.9)]);
        let b = belief(&["A1"], &[(&[], 0.999), (&["A1"], 0.001)]);
        let joint = joint(&[&a, &b]);
        assert!(joint.probability(&at("A1")) < 0.6, "{joint:?}");
    }
}
