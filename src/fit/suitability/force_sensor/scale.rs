//! Units: every force channel shows the same weight, and the moments a centre of mass within reach.

use super::{Rule, Turned};
use crate::fit::suitability::magnitude::{explanation, times};
use crate::fit::suitability::{Said, Weight};
use crate::ground::spatial::norm;

/// A weight that differs from channel to channel, or from the stated one by a power of ten, is a unit.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check the units at the ends of the column names and the nominal weight and centre",
    look,
};

/// Ratio of the weights of two channels that no gain makes.
const FAR: f64 = 3.0;
/// Ratio of measured to stated weight that no tool makes.
const ANOTHER: f64 = 5.0;
/// Weights that a sensor at a flange carries, N.
const WEIGHTS: std::ops::RangeInclusive<f64> = 0.05..=1e5;
/// Farthest centre of mass, m.
const REACH: f64 = 3.0;

fn look(on: &Turned) -> Said {
    let weights = on.weights();
    let mut sorted: Vec<f64> = weights.iter().map(|w| w.1).collect();
    sorted.sort_by(f64::total_cmp);
    let Some(weight) = sorted.get(sorted.len() / 2).copied() else {
        return Vec::new();
    };
    let mut found = Vec::new();
    let mut say = |what: String, ratio: f64| {
        let why = explanation(ratio).map_or(String::new(), |why| format!("; {why}"));
        found.push((Weight::Fatal, what + &why));
    };
    for (channel, own) in &weights {
        let ratio = own / weight;
        if !(1.0 / FAR..=FAR).contains(&ratio) {
            let what = format!(
                "{} shows {} the weight of the others",
                channel.name,
                times(ratio)
            );
            say(what, ratio);
        }
    }
    if !WEIGHTS.contains(&weight) {
        say(
            format!("the forces are those of a weight of {weight:.3e} N"),
            1.0,
        );
    }
    if let Some(nominal) = on.test.facts.nominal_weight {
        let ratio = weight / nominal;
        if !(1.0 / ANOTHER..=ANOTHER).contains(&ratio) {
            say(
                format!("the weight is {} the stated one", times(ratio)),
                ratio,
            );
        }
    }
    if let Some(lever) = on.lever().map(|moment| moment / weight) {
        let nominal = on.test.facts.nominal_com.map(norm);
        if lever > REACH {
            let ratio = nominal.map_or(1.0, |n| lever / n.max(1e-3));
            say(
                format!("the moments put the centre of mass {lever:.3e} m away"),
                ratio,
            );
        }
    }
    found
}

impl Turned<'_> {
    /// Largest moment per direction of the weight, N·m.
    fn lever(&self) -> Option<f64> {
        let rows: Option<Vec<f64>> = (3..6).map(|c| Some(norm(self.row(c)?))).collect();
        rows?.into_iter().reduce(f64::max)
    }
}
