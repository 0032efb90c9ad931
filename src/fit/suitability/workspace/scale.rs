//! Units: measured compliance beside the simulated one.

use super::{Loaded, Rule, own};
use crate::fit::suitability::magnitude::{explanation, power_of_ten, times};
use crate::fit::suitability::{Said, Weight};
use crate::measurement::workspace_test::DIRECTIONS;
use crate::signal::outliers::median;

/// A compliance far from the simulated one at all points is a unit, not a joint.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check the units at the ends of the column names, and the robot that the file names",
    look,
};

/// Ratio of measured to simulated compliance that no robot shows at all points.
const FAR: f64 = 4.0;

fn look(on: &Loaded) -> Said {
    let Some(simulated) = &on.simulated else {
        return Vec::new();
    };
    let ratios = |d: usize| -> Vec<f64> {
        let own = on.setups.iter().filter(|s| s.direction == d);
        let ratio = own.filter_map(|s| Some(own_slope(s)? / simulated[s.point][d][d]));
        ratio.filter(|r| r.is_finite() && *r > 0.0).collect()
    };
    let mut found = Vec::new();
    for (d, direction) in DIRECTIONS.iter().enumerate() {
        let all = ratios(d);
        let middle = median(&all);
        if all.is_empty() || (1.0 / FAR..=FAR).contains(&middle) {
            continue;
        }
        let why = explanation(middle).map_or(String::new(), |why| format!("; {why}"));
        let what = format!(
            "forces along {direction} move the tool {} as far as the simulation says{why}",
            times(middle)
        );
        let weight = match power_of_ten(middle) {
            Some(power) if power.abs() > 1 => Weight::Fatal,
            _ if !(1e-2..=1e2).contains(&middle) => Weight::Fatal,
            _ => Weight::Odd,
        };
        found.push((weight, what));
    }
    found
}

fn own_slope(setup: &crate::fit::force_steps::Setup) -> Option<f64> {
    own(setup).map(|(slope, _)| slope)
}
