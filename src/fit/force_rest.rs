//! What the line of one component in one set-up leaves, level by level.

use super::force_steps::{Reading, SetupSteps, WILD, Weighted, spread, weighted};
use super::rounding::Rounding;

/// No mean of readings is known better, m: readings that are made may have no noise at all. Below every sensor; else a choice.
const EXACT: f64 = 1e-12;

/// What the line of one component in one set-up leaves.
pub(super) struct Rest {
    pub readings: Vec<Reading>,
    pub kept: Vec<f64>,
    /// Cell of each reading: forces of one level and one branch.
    pub cells: Vec<usize>,
    pub count: Vec<f64>,
    /// Noise of every cell in units of the common one.
    pub rise: Vec<f64>,
    /// Doubt of the model in every cell beside the noise, standard deviation, m.
    pub doubt: Vec<f64>,
    pub rounding: Rounding,
    pub cycles: usize,
    pub component: usize,
    pub point: usize,
    pub direction: usize,
}

/// One level and branch of one set-up and component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// Index of the point.
    pub point: usize,
    /// Direction of the force.
    pub direction: usize,
    /// Component of the displacement.
    pub component: usize,
    /// Mean force, N.
    pub force: f64,
    /// Readings averaged.
    pub count: f64,
    /// Whether the force rises there.
    pub rising: bool,
}

/// Levels of a half cycle that are told apart.
const LEVELS: f64 = 20.0;

impl Rest {
    pub fn new(
        readings: Vec<Reading>,
        residuals: &[f64],
        own: &SetupSteps,
        component: usize,
        rounding: Rounding,
    ) -> Self {
        let largest = readings.iter().fold(0.0_f64, |m, r| m.max(r.force.abs()));
        let level = |force: f64| (force / largest.max(f64::MIN_POSITIVE) * LEVELS).round() as i64;
        let rising = |i: usize| {
            let before = i
                .checked_sub(1)
                .filter(|j| readings[*j].cycle == readings[i].cycle);
            match before {
                Some(j) => readings[i].force > readings[j].force,
                None => readings
                    .get(i + 1)
                    .is_some_and(|next| next.force > readings[i].force),
            }
        };
        let keys: Vec<(i64, bool)> = (0..readings.len())
            .map(|i| (level(readings[i].force), rising(i)))
            .collect();
        let mut distinct = keys.clone();
        distinct.sort_unstable();
        distinct.dedup();
        let find = |key: &(i64, bool)| distinct.binary_search(key).unwrap_or(0);
        let cells: Vec<usize> = keys.iter().map(find).collect();
        let kept = tame(residuals, &cells, distinct.len(), rounding);
        let mut count = vec![0.0; distinct.len()];
        cells
            .iter()
            .zip(&kept)
            .for_each(|(cell, w)| count[*cell] += w);
        Self {
            readings,
            kept,
            cells,
            rise: vec![1.0; count.len()],
            doubt: vec![0.0; count.len()],
            count,
            rounding,
            cycles: own.cycles.len(),
            component,
            point: own.point,
            direction: own.direction,
        }
    }

    /// Squares of the change from one reading to the next beyond the line, and how many there are.
    pub fn steps(&self) -> (f64, f64) {
        let changes = self.changes(&self.left());
        (changes.iter().map(|c| c.1).sum(), changes.len() as f64)
    }

    /// Squares of the change from one reading to the next of its cycle, m², each with the force (N) between.
    fn changes(&self, left: &[f64]) -> Vec<(f64, f64)> {
        let kept = |i: &usize| {
            let same = self.readings[*i].cycle == self.readings[i - 1].cycle;
            same && self.kept[*i] * self.kept[i - 1] > 0.0
        };
        let change = |i: usize| {
            let force = 0.5 * (self.readings[i].force.abs() + self.readings[i - 1].force.abs());
            (force, (left[i] - left[i - 1]).powi(2))
        };
        (1..left.len()).filter(kept).map(change).collect()
    }

    /// Whether most readings are repeated: those at rest alone say nothing of the noise under load.
    fn repeats(&self) -> bool {
        let again: f64 = self.count.iter().filter(|n| **n > 1.0).sum();
        2.0 * again >= self.kept.iter().sum()
    }

    /// Squares of noise, m², each with the force (N) at which it was seen: readings about the mean of their
    /// cell, or where few are repeated half the square of the change to the next reading.
    pub fn noises(&self, left: &[f64]) -> Vec<(f64, f64)> {
        let means = self.means(|i| left[i]);
        let repeated = |i: &usize| self.kept[*i] > 0.0 && self.count[self.cells[*i]] > 1.0;
        let again = (0..left.len()).filter(repeated).map(|i| {
            let n = self.count[self.cells[i]];
            let square = (left[i] - means[self.cells[i]]).powi(2) * n / (n - 1.0);
            (self.readings[i].force.abs(), square)
        });
        if self.repeats() {
            return again.collect();
        }
        let changes = self.changes(left).into_iter();
        changes
            .map(|(force, square)| (force, 0.5 * square))
            .collect()
    }

    /// The line of what was used.
    pub fn line(&self) -> Option<(Weighted, Vec<f64>)> {
        weighted(&self.readings, &self.kept, self.cycles)
    }

    /// What the line leaves of every reading.
    pub fn left(&self) -> Vec<f64> {
        let line = self.line();
        line.map_or_else(|| vec![0.0; self.readings.len()], |line| line.1)
    }

    /// The zeros of the cycles that have readings, m, with their number.
    pub fn zeros(&self, slope: f64) -> Vec<(f64, f64)> {
        let mut sums = vec![[0.0; 2]; self.cycles];
        for (i, r) in self.readings.iter().enumerate() {
            let zero = r.displacement - slope * r.force;
            let own = &mut sums[r.cycle];
            own[0] += self.kept[i] * zero;
            own[1] += self.kept[i];
        }
        let each = sums.iter().enumerate().filter(|(_, s)| s[1] > 0.0);
        each.map(|(cycle, s)| (cycle as f64, s[0] / s[1])).collect()
    }

    /// Mean over the readings of every cell.
    pub fn means(&self, values: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.count.len()];
        for (i, (cell, w)) in self.cells.iter().zip(&self.kept).enumerate() {
            sums[*cell] += w * values(i);
        }
        let mean = |(sum, n): (&f64, &f64)| if *n > 0.0 { sum / n } else { 0.0 };
        sums.iter().zip(&self.count).map(mean).collect()
    }

    /// Slope, and what the line leaves in the cells in standard deviations.
    pub fn project(&self, readings: &[Reading], noise: f64) -> (Option<f64>, Vec<f64>) {
        let Some((fit, left)) = weighted(readings, &self.kept, self.cycles) else {
            return (None, vec![0.0; self.count.len()]);
        };
        let means = self.means(|i| left[i]);
        let weights = self.weights(noise);
        let scaled = means.iter().zip(&weights).map(|(m, w)| m * w);
        (Some(fit.slope), scaled.collect())
    }

    /// One over the standard deviation of the mean of every cell, 1/m; none without readings.
    pub fn weights(&self, noise: f64) -> Vec<f64> {
        let weight = |cell: usize| match self.count[cell] {
            n if n > 0.0 => {
                let own = noise * self.rise[cell] / n.sqrt();
                let rounding = self.rounding.shared(noise);
                let own = own.hypot(rounding).hypot(self.doubt[cell]);
                1.0 / own.max(EXACT)
            }
            _ => 0.0,
        };
        (0..self.count.len()).map(weight).collect()
    }

    /// Squares about the means of the cells, and their degrees of freedom; none where few readings are repeated.
    pub fn scatter(&self, left: &[f64]) -> [f64; 2] {
        if !self.repeats() {
            return [0.0; 2];
        }
        let means = self.means(|i| left[i]);
        let square = |(i, cell): (usize, &usize)| self.kept[i] * (left[i] - means[*cell]).powi(2);
        let squares: f64 = self.cells.iter().enumerate().map(square).sum();
        let freedom: f64 = self.count.iter().map(|n| (n - 1.0).max(0.0)).sum();
        [squares, (freedom - (self.cycles as f64 - 1.0)).max(0.0)]
    }

    /// Squares of the slopes of single cycles about the common one, in units of their variance from
    /// `noise`, and their degrees of freedom: slow noise moves slopes more than its scatter says.
    pub fn slope_scatter(&self, left: &[f64], noise: f64) -> [f64; 2] {
        let mut squares = 0.0;
        for cycle in 0..self.cycles {
            let own = |(i, r): (usize, &Reading)| {
                (r.cycle == cycle).then_some(Reading {
                    displacement: left[i],
                    ..*r
                })
            };
            let all = self.readings.iter().enumerate();
            let readings: Vec<Reading> = all.clone().filter_map(own).collect();
            let kept = all.filter(|(_, r)| r.cycle == cycle);
            let kept: Vec<f64> = kept.map(|(i, _)| self.kept[i]).collect();
            if let Some((fit, _)) = weighted(&readings, &kept, self.cycles) {
                let variance = (noise * noise / fit.force_squares).max(f64::MIN_POSITIVE);
                squares += fit.slope.powi(2) / variance;
            }
        }
        match self.cycles > 1 && noise > 0.0 {
            true => [squares, self.cycles as f64 - 1.0],
            false => [0.0; 2],
        }
    }

    pub fn levels(&self) -> Vec<Level> {
        let force = self.means(|i| self.readings[i].force);
        let mut rising = vec![false; self.count.len()];
        for (i, cell) in self.cells.iter().enumerate() {
            let next = self.readings.get(i + 1).map(|r| r.force);
            let before = i.checked_sub(1).map(|j| self.readings[j].force);
            let own = self.readings[i].force;
            rising[*cell] |= before.map_or(next.is_some_and(|n| n > own), |b| own > b);
        }
        let level = |(i, count): (usize, &f64)| Level {
            point: self.point,
            direction: self.direction,
            component: self.component,
            force: force[i],
            count: *count,
            rising: rising[i],
        };
        self.count.iter().enumerate().map(level).collect()
    }
}

/// Which readings are used: one that the other cycles do not repeat, and that lies off the line by
/// far, is wild. What all cycles repeat is shape, however far off.
fn tame(residuals: &[f64], cells: &[usize], count: usize, rounding: Rounding) -> Vec<f64> {
    let mut own: Vec<Vec<f64>> = vec![Vec::new(); count];
    residuals
        .iter()
        .zip(cells)
        .for_each(|(r, c)| own[*c].push(*r));
    let middle = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        match values.len() {
            0 | 1 => 0.0,
            2 if values[0].abs() < values[1].abs() => values[0],
            2 => values[1],
            n => values[n / 2],
        }
    };
    let middles: Vec<f64> = own.iter_mut().map(middle).collect();
    let scale = spread(residuals).max(rounding.error());
    let limit = WILD * scale.max(f64::MIN_POSITIVE);
    let off = |(r, c): (&f64, &usize)| r.abs() > limit && (r - middles[*c]).abs() > limit;
    let kept = |one| if off(one) { 0.0 } else { 1.0 };
    let kept: Vec<f64> = residuals.iter().zip(cells).map(kept).collect();
    match kept.iter().sum::<f64>() > 0.5 * kept.len() as f64 {
        true => kept,
        false => vec![1.0; kept.len()],
    }
}
