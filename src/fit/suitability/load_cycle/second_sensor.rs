//! The second sensor sees what the first sees.

use super::{Course, Rule};
use crate::fit::suitability::relation::Relation;
use crate::fit::suitability::{Said, Weight, extent};

/// Two sensors on one joint see one deflection.
pub const RULE: Rule = Rule {
    name: "second-sensor",
    remedy: "turn the sign of the second sensor, or look at its cable and lever",
    look,
};

/// Ratio of the second deflection to the first beyond which no lever explains it alone.
const FAR: f64 = 5.0;

fn look(on: &Course) -> Said {
    let file = on.file;
    let Some(second) = &file.second else {
        return Vec::new();
    };
    let filled: Vec<f64> = second
        .iter()
        .zip(&on.deflection)
        .map(|(b, a)| if b.is_nan() { *a } else { *b })
        .collect();
    if extent(&filled) <= 0.0 || extent(&file.load) <= 0.0 {
        return Vec::new();
    }
    let own = Relation::of(&file.load, &filled);
    let first = &on.relation;
    let ratio = own.slope / first.slope;
    let what = match () {
        () if !first.is_real() => return Vec::new(),
        () if !own.is_real() => "the second deflection does not depend on the load".into(),
        () if ratio < 0.0 => {
            "the second deflection runs against the first: its sign is wrong".into()
        }
        () if !(1.0 / FAR..=FAR).contains(&ratio) => {
            let why = super::super::magnitude::explanation(ratio);
            let why = why.map_or(String::new(), |why| format!("; {why}"));
            format!(
                "the second deflection is {} the first{why}",
                super::super::magnitude::times(ratio)
            )
        }
        () => return Vec::new(),
    };
    vec![(Weight::Odd, what)]
}
