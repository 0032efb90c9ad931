//! Quantisation: what a finer converter would gain.

use crate::findings::gain::Gain;
use crate::fit::parameter::Z95;

/// Probability that a lattice which was found is one: by chance each of at least ten distances would
/// lie within a tenth of a multiple with probability 0.2, at four steps tried.
pub const CERTAINTY: f64 = 1.0 - 4.0 * 1.024e-7;

/// What a finer converter would gain: error `rms` with its rounding, variance step²/12 (Widrow and
/// Kollár 2008), and without. The interval follows from the relative standard error of rms².
pub fn gain(step: f64, rms: f64, relative_error: f64) -> Gain {
    let left = |variance: f64| (1.0 - step * step / 12.0 / variance).max(0.0).sqrt();
    let square = rms * rms;
    let percent = |variance: f64| 100.0 * (1.0 - left(variance));
    let half = (Z95 * relative_error).min(0.9);
    Gain {
        before: rms,
        after: rms * left(square),
        reduction_percent: percent(square),
        ci95_percent: [
            percent(square * (1.0 + half)),
            percent(square * (1.0 - half)),
        ],
    }
}
