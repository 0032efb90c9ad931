//! Units of frequency responses that another program estimated.

use super::Rule;
use crate::fit::suitability::{Said, Weight};
use crate::measurement::hammer::HammerRecord;
use crate::sheet::number::significant;

/// A structure that a hammer moves answers as some grams to some thousand tonnes do.
pub const RULE: Rule = Rule {
    name: "given",
    remedy: "state `response_unit` and `force_unit` beside the file, or export again",
    look,
};

/// Largest accelerance, 1/kg.
const PER_FORCE: std::ops::RangeInclusive<f64> = 1e-7..=1e4;

fn look(record: &HammerRecord) -> Said {
    let pairs = record
        .given
        .iter()
        .flat_map(|given| given.pairs.iter().flatten());
    let largest = |most: f64, values: &Vec<_>| {
        let norm = |h: &rustfft::num_complex::Complex64| h.norm();
        values.iter().map(norm).fold(most, f64::max)
    };
    let largest = pairs
        .map(|pair| largest(0.0, &pair.accelerance))
        .fold(0.0, f64::max);
    match PER_FORCE.contains(&largest) {
        true => Vec::new(),
        false => vec![(
            Weight::Fatal,
            format!(
                "the accelerance reaches {} (m/s²)/N",
                significant(largest, 2)
            ),
        )],
    }
}
