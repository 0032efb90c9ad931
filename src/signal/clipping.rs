//! Overload: a record that stands at its extreme instead of passing through it.

use super::outliers::median;
use super::pulse::spread;

/// Equal samples in a row that make a plateau.
const PLATEAU: usize = 3;

/// Whether `record` is cut off at its highest or lowest value. A smooth peak that is merely
/// quantised is not: beside a quantised peak the next level is held almost as long, beside a
/// plateau the record falls away steeply.
pub fn clipped(record: &[f64]) -> bool {
    clipped_above(record) || clipped_above(&negated(record))
}

/// Whether `record` is cut off at its highest value.
pub fn clipped_above(record: &[f64]) -> bool {
    let highest = record.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let middle = median(record);
    let height = highest - middle;
    let step = quantum(record, highest);
    let noise = spread(record, middle);
    // Nothing stands out: noise or an unused channel.
    if height <= 8.0 * noise.max(step) {
        return stands(record, highest, step) && height > 0.0 && many_levels(height, step);
    }
    stands(record, highest, step) || plateau(record, [highest, height], step)
}

/// Whether a single pulse is cut off at its top, be it of a few samples only.
pub fn pulse_clipped(record: &[f64]) -> bool {
    let highest = record.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let middle = median(record);
    let (height, noise) = (highest - middle, spread(record, middle));
    let few = height > 8.0 * noise && blunt(record, [highest, height, noise]);
    few || clipped_above(record)
}

fn negated(record: &[f64]) -> Vec<f64> {
    record.iter().map(|v| -v).collect()
}

fn many_levels(height: f64, step: f64) -> bool {
    height > 30.0 * step
}

/// Smallest difference between neighbouring values of the upper half: the step of the digitiser.
fn quantum(record: &[f64], highest: f64) -> f64 {
    let middle = 0.5 * (highest + median(record));
    let mut upper: Vec<f64> = record.iter().copied().filter(|v| *v > middle).collect();
    upper.sort_unstable_by(f64::total_cmp);
    let resolution = 1e-12 * highest.abs();
    let steps = upper.windows(2).map(|w| w[1] - w[0]);
    steps
        .filter(|d| *d > resolution)
        .fold(f64::INFINITY, f64::min)
}

/// Far more samples at the highest level than at each of the five below: seen when a fast
/// oscillation is cut off, one or two samples at a time.
fn stands(record: &[f64], highest: f64, step: f64) -> bool {
    let depth = |v: &f64| (highest - v) / step;
    let top = record.iter().filter(|v| depth(v) < 0.5).count();
    let below = record
        .iter()
        .filter(|v| (0.5..5.5).contains(&depth(v)))
        .count();
    top > PLATEAU && top as f64 > 8.0 * (below as f64 / 5.0).max(0.25)
}

/// A run of samples at the highest level from which the record falls by much more than a parabola
/// that rounds to such a run (there, half a run further out, 3 steps at most), and whose flanks pass above it.
fn plateau(record: &[f64], [highest, height]: [f64; 2], step: f64) -> bool {
    let top = |i: usize| highest - record[i] < 0.5 * step;
    let mut start = 0;
    while start < record.len() {
        let length = (start..record.len()).take_while(|i| top(*i)).count();
        if length >= PLATEAU
            && falls_steeply(record, start, length, highest, step)
            && is_below_its_flanks(record, start, length, height)
        {
            return true;
        }
        start += length.max(1);
    }
    false
}

fn falls_steeply(record: &[f64], start: usize, length: usize, highest: f64, step: f64) -> bool {
    let reach = length.div_ceil(2);
    let left = start.checked_sub(reach).map(|i| highest - record[i]);
    let right = record.get(start + length - 1 + reach).map(|v| highest - v);
    let fall = match (left, right) {
        (Some(left), Some(right)) => left.min(right),
        (left, right) => left.or(right).unwrap_or(0.0),
    };
    fall > 6.0 * step
}

/// Whether the parabola through three samples of either flank passes well above a run of equal ones: by a third of how far the record has
/// fallen one sample beyond where three of them are cut off, and more where more are. Of a peak that noise makes level it does not.
fn is_below_its_flanks(record: &[f64], start: usize, length: usize, height: f64) -> bool {
    let stride = (length / 6).max(1);
    let half = 0.5 * (length as f64 - 1.0);
    let flank = |k: usize| {
        let left = record.get(start.checked_sub(k * stride)?)?;
        let right = record.get(start + length - 1 + k * stride)?;
        Some([(half + (k * stride) as f64).powi(2), 0.5 * (left + right)])
    };
    let (Some(a), Some(b), Some(c)) = (flank(1), flank(2), flank(3)) else {
        return true;
    };
    // farther down a peak is no parabola
    if record[start] - c[1] > 0.5 * height {
        return true;
    }
    let middle = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
    let sum = |of: &dyn Fn([f64; 2]) -> f64| of(a) + of(b) + of(c);
    let slope =
        sum(&|p| (p[0] - middle[0]) * (p[1] - middle[1])) / sum(&|p| (p[0] - middle[0]).powi(2));
    let above = middle[1] - slope * middle[0] - record[start];
    above > CUT * (record[start] - a[1])
}

/// Half of that third: a choice.
const CUT: f64 = 1.0 / 6.0;

/// Equal samples on top of a pulse of few samples. Two of them a smooth peak has only where it lies midway
/// between them: then the record falls alike on both sides, and on the next step by no more than twice as
/// much (parabola) to half as much (sine squared) again; and noise of many digits makes no equal samples.
/// Three of them it never has.
fn blunt(record: &[f64], [highest, height, noise]: [f64; 3]) -> bool {
    let depths = record.iter().map(|v| highest - v);
    let upper: Vec<f64> = depths.filter(|depth| *depth < 0.5 * height).collect();
    let step = decimals(&upper, 1e-12 * highest.abs());
    let step = step.unwrap_or_else(|| quantum(record, highest));
    let top = |v: &f64| highest - v < 0.5 * step;
    let Some(at) = record.iter().position(top) else {
        return false;
    };
    let length = record[at..].iter().take_while(|v| top(v)).count();
    let around = at
        .checked_sub(2)
        .and_then(|from| record.get(from..at + length + 2));
    let Some([a, b, .., y, z]) = around else {
        return false;
    };
    let falls = [highest - b, highest - y];
    let further = [b - a, y - z];
    let uneven = (falls[0] - falls[1]).abs() > UNEVEN * height;
    let blunt = (0..2).any(|i| further[i] > BLUNT * falls[i]);
    let steep = falls.into_iter().chain(further).fold(0.0, f64::max) > MANY * step;
    let tied = noise > TIED * step;
    length >= 2 && steep && (length > 2 || uneven || blunt || tied)
}

/// The power of ten that all values are multiples of, if there is one well above `rounding`.
fn decimals(values: &[f64], rounding: f64) -> Option<f64> {
    let fits = |step: &f64| {
        let off = |v: &f64| (v / step - (v / step).round()).abs() * step;
        values.iter().all(|v| off(v) <= rounding)
    };
    let steps = (0..12).map(|k| 10.0_f64.powi(-k));
    let mut steps = steps.filter(|step| *step > 4.0 * rounding);
    steps.find(fits)
}

/// Equal samples above a fall of fewer steps than these are chance.
const MANY: f64 = 1000.0;
/// Difference of the falls on both sides, as a share of the height, that no smooth peak has.
const UNEVEN: f64 = 0.1;
/// How many times the first fall the next one may be.
const BLUNT: f64 = 2.5;

/// Noise of this many steps gives two samples the same value once in a hundred hits at most.
const TIED: f64 = 50.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn half_sine(samples: usize) -> Vec<f64> {
        let pulse = |i: usize| (std::f64::consts::PI * i as f64 / samples as f64).sin();
        let mut record = vec![0.0; 100];
        record.extend((0..=samples).map(|i| 100.0 * pulse(i)));
        record.extend(vec![0.0; 400]);
        record
    }

    fn quantised(record: &[f64], step: f64) -> Vec<f64> {
        record.iter().map(|v| (v / step).round() * step).collect()
    }

    #[test]
    fn a_quantised_soft_pulse_is_not_clipped() {
        for samples in [4, 8, 40, 128, 200] {
            for step in [1e-3, 0.05, 0.5, 2.0] {
                assert!(
                    !clipped_above(&quantised(&half_sine(samples), step)),
                    "{samples} {step}"
                );
            }
            assert!(!clipped_above(&half_sine(samples)));
        }
    }

    /// A half sine of `samples` samples that starts `phase` samples after a sample.
    fn shifted(samples: f64, phase: f64) -> Vec<f64> {
        let force = |i: u32| {
            let t = (f64::from(i) - 100.0 - phase) / samples;
            let inside = (0.0..=1.0).contains(&t);
            f64::from(inside) * 250.0 * (std::f64::consts::PI * t).sin()
        };
        (0..400).map(force).collect()
    }

    #[test]
    fn a_pulse_of_few_samples_is_judged_by_its_pair() {
        let phases = (0..20).map(|i| f64::from(i) / 20.0);
        for phase in phases.clone() {
            for samples in [4.0, 5.0, 6.5, 10.24] {
                assert!(!pulse_clipped(&quantised(&shifted(samples, phase), 0.01)));
                assert!(!pulse_clipped(&shifted(samples, phase)));
            }
        }
        let cut = |phase: f64, at: f64| -> Vec<f64> {
            let whole = shifted(5.0, phase).into_iter();
            quantised(&whole.map(|v| v.min(at)).collect::<Vec<_>>(), 0.01)
        };
        let found = |at: f64| {
            phases
                .clone()
                .filter(|p| pulse_clipped(&cut(*p, at)))
                .count()
        };
        assert_eq!(found(150.0), 20);
        assert!(found(200.0) >= 15, "{}", found(200.0));
    }

    #[test]
    fn a_peak_that_noise_makes_level_is_not_cut_off() {
        // two responses by a stranger, in steps of 4.2 and 4.3 mm/s²
        let level = [
            [
                0.16835, 0.25673, 0.30303, 0.34091, 0.37458, 0.37458, 0.37458, 0.34512, 0.30303,
                0.25252,
            ],
            [
                0.42567, 0.49447, 0.56756, 0.65356, 0.72235, 0.72235, 0.72235, 0.67075, 0.57186,
                0.42997,
            ],
        ];
        for peak in level {
            let mut record = vec![0.0; 100];
            record.extend(peak);
            record.extend(vec![0.0043; 100]);
            assert!(!clipped_above(&record), "{peak:?}");
        }
    }

    #[test]
    fn a_short_pulse_that_is_cut_low_is_clipped() {
        for (samples, at) in [(6, 60.0), (7, 70.0), (8, 88.0), (12, 50.0)] {
            // a slope beside it, since no two flanks are alike
            let sloped = half_sine(samples).into_iter().enumerate();
            let cut: Vec<f64> = sloped.map(|(i, v)| (v + 0.01 * i as f64).min(at)).collect();
            for record in [quantised(&cut, 0.01), cut] {
                assert!(clipped_above(&record), "{samples} {at}");
            }
        }
    }

    #[test]
    fn a_cut_pulse_is_clipped_on_either_side() {
        for samples in [16, 128] {
            let cut: Vec<f64> = half_sine(samples).iter().map(|v| v.min(80.0)).collect();
            for record in [cut.clone(), quantised(&cut, 0.05), quantised(&cut, 1.0)] {
                assert!(clipped_above(&record), "{samples}");
                assert!(clipped(&negated(&record)));
            }
        }
    }
}
