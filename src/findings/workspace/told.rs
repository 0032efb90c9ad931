//! What naming a cause gains, as a reader would compute it from the file: root mean square of readings less
//! predictions, in metres, on rows that were not fitted. Whether there is a gain at all is decided in standard
//! deviations ([`Case::helps`]), where each set-up counts by how well it is known; that number is no error in metres. But
//! what makes the error in metres worse beyond chance is named by nobody.

use super::case::Case;
use super::set::Set;
use super::unseen::gain;
use crate::findings::gain::Gain;
use std::collections::BTreeMap;

/// Squares of readings without and with a cause, m², and how many readings.
type Sums = [f64; 3];

impl Case<'_> {
    /// The gain of one seat in metres; its interval by leaving out one point after another.
    pub(super) fn told_gain(&self, set: &Set, seat: usize) -> Gain {
        let (before, after) = self.left_without_and_with(set, seat);
        self.told(&before, &after)
    }

    /// The same of what is left without and with a cause, in standard deviations of the rows.
    pub(super) fn told(&self, before: &Vec<f64>, after: &Vec<f64>) -> Gain {
        let mut points: BTreeMap<usize, Sums> = BTreeMap::new();
        self.add_slopes(&mut points, [before, after]);
        self.add_levels(&mut points, [before, after]);
        let all: Vec<Sums> = points.into_values().collect();
        let total = |left_out: usize| -> Sums {
            let others = all.iter().enumerate().filter(|(i, _)| *i != left_out);
            others.fold([0.0; 3], |sum, (_, own)| [0, 1, 2].map(|k| sum[k] + own[k]))
        };
        let whole = total(usize::MAX);
        let decided = gain(before, after, self.unit());
        if !whole.iter().all(|sum| *sum > 0.0 && sum.is_finite()) {
            return decided;
        }
        let chance = Some(decided.ln_std()).filter(|std| std.is_finite());
        let ln = |s: Sums| 0.5 * (s[0] / s[1]).ln();
        let parts: Vec<f64> = (0..all.len()).map(|i| ln(total(i))).collect();
        let parts: Vec<f64> = parts.into_iter().filter(|x| x.is_finite()).collect();
        let rms = |k: usize| (whole[k] / whole[2]).sqrt();
        // the noise of the readings, and that another choice of points would have gained otherwise
        let std = jackknife(&parts).hypot(chance.unwrap_or(0.0));
        Gain::of(rms(0), rms(1), std)
    }

    /// Readings along the lines: what a slope is off, times the forces, and the noise about it.
    fn add_slopes(&self, points: &mut BTreeMap<usize, Sums>, left: [&Vec<f64>; 2]) {
        let n = self.slopes();
        if left.iter().any(|rows| rows.len() < n) {
            return;
        }
        let raw = left.map(|rows| self.weighing.colour(&rows[..n]));
        let squares = self.force_squares();
        for (row, (point, direction, k)) in self.weighing.places().into_iter().enumerate() {
            let Some((force, count)) = squares.get(&(point, direction)) else {
                continue;
            };
            if raw.iter().all(|rows| rows[row].is_finite()) {
                let noise = count * self.shapes.noise[k].powi(2);
                let own = points.entry(point).or_default();
                own[0] += raw[0][row].powi(2) * force + noise;
                own[1] += raw[1][row].powi(2) * force + noise;
                own[2] += count;
            }
        }
    }

    /// Readings beyond the lines.
    fn add_levels(&self, points: &mut BTreeMap<usize, Sums>, left: [&Vec<f64>; 2]) {
        let first = self.slopes();
        for (i, (level, spread)) in self
            .shapes
            .levels()
            .iter()
            .zip(self.shapes.spreads())
            .enumerate()
        {
            let [Some(before), Some(after)] = left.map(|rows| rows.get(first + i).copied()) else {
                return;
            };
            if before.is_finite() && after.is_finite() {
                let own = points.entry(level.point).or_default();
                own[0] += level.count * (before * spread).powi(2);
                own[1] += level.count * (after * spread).powi(2);
            }
        }
    }

    /// Sum of the squares of the forces of every set-up, N², and the number of steps.
    fn force_squares(&self) -> BTreeMap<(usize, usize), (f64, f64)> {
        let mut found: BTreeMap<(usize, usize), (f64, f64)> = BTreeMap::new();
        for step in &self.test.steps {
            let own = found.entry((step.point, step.direction)).or_default();
            own.0 += step.force * step.force;
            own.1 += 1.0;
        }
        found
    }
}

/// Standard error by leaving out one after another (Tukey 1958).
fn jackknife(parts: &[f64]) -> f64 {
    let n = parts.len() as f64;
    let mean = parts.iter().sum::<f64>() / n.max(1.0);
    let squares: f64 = parts.iter().map(|x| (x - mean).powi(2)).sum();
    ((n - 1.0).max(0.0) / n.max(1.0) * squares).sqrt()
}
