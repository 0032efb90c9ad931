//! Time must advance, evenly at best.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight};
use crate::signal::outliers::{median, robust_std};

/// Creep, drift and delay are told from each other by time.
pub const RULE: Rule = Rule {
    name: "clock",
    remedy: "record the time of every row",
    look,
};

/// Share of rows with the time of the row before that is odd.
const REPEATED: f64 = 0.02;
/// Intervals that tell the usual one; of longer records every second, third ... is taken.
const ENOUGH: usize = 1 << 16;
/// Spread of the sampling interval that is odd.
const UNEVEN: f64 = 0.2;

fn look(on: &Course) -> Said {
    let file = on.file;
    let rows = file.time.len();
    let step = |w: &[f64]| w[1] - w[0];
    let equal = file.time.windows(2).filter(|w| w[0] == w[1]).count();
    if equal + 1 == rows {
        let what = "all times are equal: the clock stands still";
        return vec![(Weight::Fatal, what.into())];
    }
    let mut found = Vec::new();
    if equal as f64 > REPEATED * rows as f64 {
        let what = format!("{equal} of {rows} rows have the time of the row before");
        found.push((Weight::Odd, what));
    }
    let some = file.time.windows(2).step_by((rows / ENOUGH).max(1));
    let steps: Vec<f64> = some.map(step).collect();
    let step = median(&steps);
    let jitter = if step > 0.0 {
        robust_std(&steps) / step
    } else {
        0.0
    };
    if jitter > UNEVEN {
        let what = format!("sampling is uneven (spread {:.0} %)", 100.0 * jitter);
        found.push((Weight::Note, what));
    }
    found
}
