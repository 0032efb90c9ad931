//! Quantisation: what a finer converter would gain.

use crate::findings::gain::Gain;
use crate::fit::parameter::Z95;
use crate::ground::stats::mean;

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
/// Rms of what `part` moves readings by otherwise than digits that are cut off do: those shift all of them, or each towards zero.
pub(super) fn beside_cutting(part: &[f64], reading: &[f64]) -> f64 {
    let of = |side: f64| -> Vec<f64> {
        let own = part.iter().zip(reading);
        let own = own.filter(|(_, r)| (**r >= 0.0) == (side > 0.0));
        own.map(|(p, _)| *p).collect()
    };
    // a shift on either side of zero is any mix of both
    let each = [1.0, -1.0].map(|side| {
        let own = of(side);
        let middle = mean(&own);
        own.iter().map(|p| (p - middle).powi(2)).sum::<f64>()
    });
    (each.iter().sum::<f64>() / part.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::beside_cutting;

    #[test]
    fn a_shift_towards_zero_is_what_cutting_does_and_a_ramp_over_time_is_not() {
        let reading: Vec<f64> = (0..400).map(|i| (f64::from(i) * 0.05).sin()).collect();
        let shift: Vec<f64> = reading.iter().map(|r| 0.3 - 0.5 * r.signum()).collect();
        assert!(beside_cutting(&shift, &reading) < 1e-12);
        let ramp: Vec<f64> = (0..400).map(|i| f64::from(i) / 400.0 - 0.5).collect();
        assert!((beside_cutting(&ramp, &reading) - 12f64.sqrt().recip()).abs() < 0.01);
    }
}
