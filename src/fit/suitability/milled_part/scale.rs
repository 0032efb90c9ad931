//! Deviations that no milled part has.

use super::{Probed, Rule};
use crate::fit::suitability::{Said, Weight};
use crate::ground::stats::median;

/// A part that is off by centimetres, or by less than light waves, is a unit.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check the units at the ends of the column names; dx_mm is measured less nominal",
    look,
};

/// Usual deviations of a part, m: less than a tenth of light's wave no probe reads, and two centimetres are
/// a broken tool. A choice.
const USUAL: std::ops::Range<f64> = 5e-8..2e-2;

fn look(on: &Probed) -> Said {
    let sizes = |r: &crate::measurement::milled_part::Reading| {
        let told = r.deviation.iter().filter(|d| d.is_finite());
        told.fold(0.0_f64, |m, d| m.max(d.abs()))
    };
    let usual = median(&on.test.readings.iter().map(sizes).collect::<Vec<_>>());
    match USUAL.contains(&usual) || usual == 0.0 {
        true => Vec::new(),
        false => vec![(
            Weight::Fatal,
            format!("the usual deviation is {:.3e} mm", 1e3 * usual),
        )],
    }
}
