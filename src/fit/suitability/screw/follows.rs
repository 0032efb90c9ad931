//! The scale must follow the targets, with the same sign and unit.

use super::{Axis, Rule};
use crate::fit::suitability::channel::sum;
use crate::fit::suitability::magnitude::{explanation, times};
use crate::fit::suitability::{Said, Weight};

/// An axis goes where it is told but for a small share of its travel.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check units and sign of `target` and `actual`, and that both are of one axis",
    look,
};

/// Share of the squares of the scale that the targets describe.
const SHARE: f64 = 0.9;
/// Times as many targets as positions: targets repeat from run to run, positions do not.
const SWAPPED: usize = 2;
/// Relative error of a pitch that no screw has.
const PITCH: f64 = 0.05;

fn look(on: &Axis) -> Said {
    let scale = &on.channels[0];
    let (told, met) = (distinct(&scale.drive), distinct(&scale.values));
    if told > SWAPPED * met {
        let what = format!(
            "{told} different targets and {met} different positions: the columns are swapped"
        );
        return vec![(Weight::Fatal, what)];
    }
    if told < 2 {
        return Vec::new();
    }
    let Some(line) = sum(&scale.values, std::slice::from_ref(&scale.drive)) else {
        return Vec::new();
    };
    let slope = line.of[0];
    let what = match () {
        () if line.share < SHARE => "the scale does not follow the targets".into(),
        () if slope < 0.0 => "the scale runs against the targets: its sign is wrong".into(),
        () if (slope - 1.0).abs() > PITCH => {
            let why = explanation(slope).map_or(String::new(), |why| format!("; {why}"));
            format!("the axis goes {} as far as it is told{why}", times(slope))
        }
        () => return Vec::new(),
    };
    vec![(Weight::Fatal, what)]
}

fn distinct(values: &[f64]) -> usize {
    let mut bits: Vec<u64> = values.iter().map(|v| v.to_bits()).collect();
    bits.sort_unstable();
    bits.dedup();
    bits.len()
}
