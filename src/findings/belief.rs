//! What one experiment believes about the robot, once its instruments are summed out: the coin in which
//! experiments of different kinds are added up.

use crate::robot::Robot;

/// A physical cause and its site, as `("drive_stiffness", "A2")`.
pub type Place = (&'static str, String);

/// A set of physical causes that was weighed.
#[derive(Debug, Clone, PartialEq)]
pub struct Weighed {
    /// The causes, in order.
    pub causes: Vec<Place>,
    /// Logarithm of its probability, the causes' prior odds included.
    pub ln_p: f64,
    /// Logarithm of its evidence, up to a constant of the experiment: no prior odds of physical causes in it.
    pub ln_evidence: f64,
    /// The robot with these causes as this experiment fits them.
    pub robot: Robot,
}

/// What an experiment believes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Belief {
    /// Every physical cause that it would show.
    pub sees: Vec<Place>,
    /// The sets it weighed, most probable first.
    pub sets: Vec<Weighed>,
}

/// Prior probability of one cause at one place in a joint inference: experiments bring evidence, and this is
/// applied once. A hundred places of a robot, and mostly one of them wrong.
pub const PRIOR: f64 = 0.01;
/// Sets with less than this probability are not kept.
pub const LEAST: f64 = 1e-9;
/// No more sets than so many are kept.
const KEPT: usize = 100;
/// Logarithm of the evidence of a set of which not even a part was weighed.
const UNHEARD_OF: f64 = -25.0;

impl Belief {
    /// From sets with their probabilities and the logarithm of the prior odds of their physical causes that is
    /// in these, best first. Sets that differ by instruments only are one; the robot of the most probable of
    /// them counts.
    pub fn new(
        sees: Vec<Place>,
        weighed: impl Iterator<Item = (Vec<Place>, f64, f64, Robot)>,
    ) -> Self {
        let mut sets: Vec<Weighed> = Vec::new();
        for (mut causes, p, ln_odds, robot) in weighed.filter(|w| w.1 > LEAST).take(KEPT) {
            causes.sort();
            match sets.iter_mut().find(|set| set.causes == causes) {
                Some(set) => {
                    let more = ((set.ln_p.exp() + p).ln() - set.ln_p).max(0.0);
                    set.ln_p += more;
                    set.ln_evidence += more;
                }
                None => sets.push(Weighed {
                    causes,
                    ln_p: p.ln(),
                    ln_evidence: p.ln() - ln_odds,
                    robot,
                }),
            }
        }
        sets.sort_by(|a, b| b.ln_p.total_cmp(&a.ln_p));
        Self { sees, sets }
    }

    /// What of these causes it would show.
    pub fn visible(&self, causes: &[Place]) -> Vec<Place> {
        let seen = causes.iter().filter(|c| self.sees.contains(c));
        seen.cloned().collect()
    }

    /// Logarithm of the evidence for these causes (in order, all visible). A set that was not weighed is at
    /// least as good as any part of it: more causes never fit worse.
    pub fn ln_evidence(&self, causes: &[Place]) -> f64 {
        if let Some(own) = self.sets.iter().find(|set| set.causes == causes) {
            return own.ln_evidence;
        }
        let within = |set: &&Weighed| set.causes.iter().all(|c| causes.contains(c));
        let parts = self.sets.iter().filter(within);
        parts.map(|set| set.ln_evidence).fold(UNHEARD_OF, f64::max)
    }

    /// The robot with these causes, if they were weighed.
    pub fn robot(&self, causes: &[Place]) -> Option<&Robot> {
        let own = self.visible(causes);
        let set = self.sets.iter().find(|set| set.causes == own);
        set.map(|set| &set.robot)
    }

    /// Probability that a cause is present; `None` where this experiment would not show it.
    pub fn inclusion(&self, place: &Place) -> Option<f64> {
        let holding = self.sets.iter().filter(|set| set.causes.contains(place));
        let p: f64 = holding.map(|set| set.ln_p.exp()).sum();
        self.sees.contains(place).then(|| p.min(1.0))
    }
}
