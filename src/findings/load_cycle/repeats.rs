//! A fine pattern that comes back at the same loads: a laser that is not linear within a fringe, teeth that mesh. Noise of any colour has
//! another sign as often as not the next time; neighbouring bins of it may agree, which makes chance a little wider than the test takes it to be
//! (never wide enough in sixty walks that keep 0.94, below).

use crate::ground::stats::mean;

/// Equal parts of the range of loads in which readings are compared.
const BINS: usize = 96;
/// Part of a half cycle over whose mean what is fine stands: what laws miss is broader.
const FINE: usize = 8;
/// Rows of a half cycle that show a fine pattern.
const ROWS: usize = 48;
/// Standard deviations of what chance agrees by from one time to the next, and rms of what agrees, deviations of one reading.
const SURE: f64 = 6.0;
const LEAST: f64 = 0.3;

/// Whether `own` (deviations of one reading) agrees with itself over half cycles of a load, of which every row tells the number: there
/// and back.
pub(super) fn repeats(own: &[f64], load: &[f64], half_cycle: &[usize]) -> bool {
    let passes: Vec<Vec<Option<f64>>> = passes(own, load, half_cycle);
    let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
    // there and back: a hum would agree with itself on the same way again if that comes after a whole number of its periods
    let pairs = passes.iter().zip(passes.iter().skip(1));
    for (a, b) in pairs.flat_map(|(a, b)| a.iter().zip(b)) {
        if let (Some(a), Some(b)) = (a, b) {
            sum += a * b;
            squares += (a * b).powi(2);
            count += 1.0;
        }
    }
    count > 0.0 && sum > SURE * squares.sqrt() && (sum / count).sqrt() > LEAST
}

/// Per half cycle that is long enough: what is fine in it, mean of every bin of the load.
fn passes(own: &[f64], load: &[f64], half_cycle: &[usize]) -> Vec<Vec<Option<f64>>> {
    let mut all = Vec::new();
    let mut from = 0;
    for rows in half_cycle.chunk_by(|a, b| a == b) {
        let to = from + rows.len();
        if rows.len() >= ROWS {
            all.push(binned(&fine(&own[from..to]), &load[from..to]));
        }
        from = to;
    }
    all
}

/// Less the mean of the readings around each.
fn fine(own: &[f64]) -> Vec<f64> {
    let wide = own.len() / (2 * FINE);
    let around = |i: usize| mean(&own[i.saturating_sub(wide)..(i + wide + 1).min(own.len())]);
    (0..own.len()).map(|i| own[i] - around(i)).collect()
}

fn binned(fine: &[f64], load: &[f64]) -> Vec<Option<f64>> {
    let mut sums = vec![(0.0, 0.0); BINS];
    for (value, u) in fine.iter().zip(load) {
        let at = (0.5 * (u + 1.0) * BINS as f64).clamp(0.0, BINS as f64 - 1.0) as usize;
        sums[at].0 += value;
        sums[at].1 += 1.0;
    }
    let each = sums.into_iter();
    each.map(|(sum, count)| (count > 0.0).then(|| sum / count))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;
    use std::f64::consts::TAU;

    #[test]
    fn a_ripple_over_the_load_comes_back_and_a_walk_does_not() {
        let load: Vec<f64> = (0..2400).map(|i| (i as f64 * TAU / 600.0).sin()).collect();
        let half_cycle: Vec<usize> = (0..2400).map(|i| (i + 150) / 300).collect();
        let found = |of: &dyn Fn(&mut Random, usize) -> f64| {
            let told = (0..60).filter(|seed| {
                let mut random = Random::new(*seed);
                let own: Vec<f64> = (0..2400).map(|i| of(&mut random, i)).collect();
                repeats(&own, &load, &half_cycle)
            });
            told.count()
        };
        let ripple = |random: &mut Random, i: usize| (60.0 * load[i]).sin() + random.normal();
        assert_eq!(found(&ripple), 60);
        // mains, and what bends slowly with the load
        let none = |random: &mut Random, i: usize| {
            (0.7 * i as f64).sin() + 2.0 * load[i].powi(3) + random.normal()
        };
        assert_eq!(found(&none), 0);
        let at = std::cell::Cell::new(0.0);
        let walk = |random: &mut Random, _: usize| {
            at.set(0.94 * at.get() + random.normal());
            at.get()
        };
        assert_eq!(found(&walk), 0);
    }
}
