//! The time column beside the spindle speed.

use super::{Cutting, Rule};
use crate::fit::suitability::{Said, Weight};
use crate::measurement::milling_force::{CutFacts, Record};
use std::f64::consts::TAU;

/// A record shorter than the passage of a tooth, or with hardly a sample per turn, has another time base.
pub const RULE: Rule = Rule {
    name: "clock",
    remedy: "check the unit of the time column and `spindle_rpm`",
    look,
};

/// Samples per turn below which no wave form is seen.
const SAMPLES: f64 = 4.0;

fn look(on: &Cutting) -> Said {
    let turns = |(cut, record): (&CutFacts, &Record)| {
        let long = record.time.last()? - record.time.first()?;
        Some((long * cut.spindle_rad_s / TAU, record.time.len() as f64))
    };
    let cuts: Vec<(f64, f64)> = on.cuts().filter_map(turns).collect();
    let teeth = on.file.facts.teeth as f64;
    let longest = cuts.iter().map(|c| c.0).fold(0.0, f64::max);
    let densest = cuts.iter().map(|c| c.1 / c.0).fold(0.0, f64::max);
    let what = match () {
        () if longest * teeth < 1.0 => {
            format!(
                "the longest cut lasts {longest:.1e} turns of the spindle: not one tooth passes"
            )
        }
        () if densest < SAMPLES => format!("at most {densest:.1} samples per turn of the spindle"),
        () => return Vec::new(),
    };
    vec![(Weight::Fatal, what)]
}
