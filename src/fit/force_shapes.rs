//! Force steps to their last shape: the line of every set-up with the noise that all set-ups share,
//! and what the line leaves, averaged over the cycles level by level. A clearance or a loop shows there.

use super::force_steps::{
    Line, Reading, Setup, SetupSteps, WILD, Weighted, by_setup, setups, spread, straight, weighted,
};
use crate::ground::spatial::V3;
use crate::measurement::workspace_test::WorkspaceTest;

/// What the line of one component in one set-up leaves.
struct Rest {
    readings: Vec<Reading>,
    kept: Vec<f64>,
    /// Cell of each reading: forces of one level and one branch.
    cells: Vec<usize>,
    count: Vec<f64>,
    cycles: usize,
    component: usize,
    point: usize,
    direction: usize,
}

/// A workspace test, reduced.
pub struct Shapes {
    /// The line of every set-up, with the noise that all set-ups share.
    pub setups: Vec<Setup>,
    /// Standard deviation of a reading by component, m.
    pub noise: [f64; 3],
    /// Slow noise moves slopes and bends so many times as much as the scatter says.
    pub widen: f64,
    /// How far the zero of a component wanders from cycle to cycle, in standard deviations of a reading.
    pub wander: [f64; 3],
    /// Noise that the data sheet states, m.
    stated: Option<f64>,
    rests: Vec<Rest>,
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
/// Scatter this many times that of neighbours is shape.
const SHAPE: f64 = 2.0;
/// Degrees of freedom below which the scatter between cycles is not trusted.
const FREEDOM: f64 = 12.0;

impl Shapes {
    /// Of a test.
    pub fn of(test: &WorkspaceTest) -> Self {
        let noise = test.facts.sensor_noise;
        let mut rests = Vec::new();
        for own in by_setup(test) {
            for component in 0..3 {
                let readings = own.readings(component);
                let Some(fit) = straight(&readings, own.cycles.len(), noise) else {
                    continue;
                };
                rests.push(Rest::new(readings, &fit.residuals, &own, component));
            }
        }
        let mut shapes = Self {
            setups: setups(test),
            noise: [0.0; 3],
            widen: 1.0,
            stated: noise,
            wander: [0.0; 3],
            rests,
        };
        shapes.take_lines();
        shapes.share_noise();
        shapes
    }

    /// Every set-up gets the noise of all: thirty readings say little of their own scatter.
    fn share_noise(&mut self) {
        let left: Vec<Vec<f64>> = self.rests.iter().map(Rest::left).collect();
        let mut sums = [[0.0; 2]; 3];
        let mut slopes = [0.0; 2];
        for (rest, left) in self.rests.iter().zip(&left) {
            let own = rest.scatter(left);
            (0..2).for_each(|k| sums[rest.component][k] += own[k]);
        }
        let lines = |k: usize| self.setups.iter().filter_map(move |s| s.lines[k]);
        for (k, sum) in sums.iter().enumerate() {
            let own: f64 = lines(k).map(|l| l.rows as f64 * l.scatter.powi(2)).sum();
            let rows: f64 = lines(k).map(|l| l.rows as f64).sum();
            self.noise[k] = match sum[1] >= FREEDOM {
                true => (sum[0] / sum[1]).sqrt(),
                false => self.without_repeats((own / rows.max(1.0)).sqrt(), k),
            };
        }
        self.wander = self.wandering();
        for (rest, left) in self.rests.iter().zip(&left) {
            let own = rest.slope_scatter(left, self.noise[rest.component]);
            (0..2).for_each(|k| slopes[k] += own[k]);
        }
        let widen = match slopes[1] >= FREEDOM {
            true => (slopes[0] / slopes[1]).sqrt().max(1.0),
            false => self.slowness(),
        };
        self.widen = widen;
        let noise = self.noise;
        let lines = self.setups.iter_mut().flat_map(|s| s.lines.iter_mut());
        for (i, line) in lines.enumerate() {
            if let Some(line) = line {
                share(line, noise[i % 3], widen);
            }
        }
    }

    /// The lines of the readings that were used here.
    fn take_lines(&mut self) {
        for rest in &self.rests {
            let here = |s: &&mut Setup| s.point == rest.point && s.direction == rest.direction;
            let line = self.setups.iter_mut().find(here);
            let line = line.and_then(|setup| setup.lines[rest.component].as_mut());
            if let (Some(line), Some((fit, left))) = (line, rest.line()) {
                let used: f64 = rest.kept.iter().sum();
                let squares: f64 = left.iter().zip(&rest.kept).map(|(l, w)| w * l * l).sum();
                let freedom = (used - 1.0 - rest.cycles as f64).max(1.0);
                line.slope = fit.slope;
                line.scatter = (squares / freedom).sqrt();
                line.stderr = line.scatter / fit.force_squares.sqrt();
                line.rows = used as usize;
                line.wild = rest.kept.len() - used as usize;
            }
        }
    }

    /// How much more than its scatter says noise moves a slope when each reading takes after the one
    /// before it (first-order autoregression), where no repetition shows it.
    fn slowness(&self) -> f64 {
        let (mut steps, mut count) = (0.0, 0.0);
        for rest in &self.rests {
            let variance = self.noise[rest.component].powi(2).max(f64::MIN_POSITIVE);
            let (own, rows) = rest.steps();
            steps += own / variance;
            count += rows;
        }
        let alike = (1.0 - 0.5 * steps / f64::max(count, 1.0)).clamp(0.0, 0.9);
        match count > 0.0 {
            true => ((1.0 + alike) / (1.0 - alike)).sqrt(),
            false => 1.0,
        }
    }

    /// Noise of a component whose levels are not repeated: the scatter about the lines, unless
    /// neighbours agree so much better, and the data sheet with them, that the rest is shape.
    fn without_repeats(&self, scatter: f64, component: usize) -> f64 {
        let own = self.rests.iter().filter(|rest| rest.component == component);
        let (squares, count) = own.fold((0.0, 0.0), |(s, n), rest| {
            let (own, rows) = rest.steps();
            (s + own, n + rows)
        });
        let short = (0.5 * squares / f64::max(count, 1.0)).sqrt();
        let short = short.max(self.stated.unwrap_or(scatter));
        match scatter > SHAPE * short {
            true => short,
            false => scatter,
        }
    }

    /// Bends of simple form in what the lines leave (in the units of [`Shapes::left`]): the squares of
    /// the even part, of the cubic part and of the loop, in variances of the noise, and their number.
    pub fn bends(&self, left: &[f64]) -> ([f64; 3], f64) {
        let (mut sums, mut at) = ([0.0; 3], 0);
        for rest in &self.rests {
            let own = rest.bends(&left[at..at + rest.count.len()]);
            (0..3).for_each(|k| sums[k] += (own[k] / self.widen).powi(2));
            at += rest.count.len();
        }
        (sums, self.rests.len() as f64)
    }

    fn wandering(&self) -> [f64; 3] {
        let mut sums = [[0.0; 2]; 3];
        for rest in &self.rests {
            if let Some((fit, _)) = rest.line() {
                let own = rest.zeros(fit.slope);
                (0..2).for_each(|k| sums[rest.component][k] += own[k]);
            }
        }
        let rms = |k: usize| match sums[k][1] > 0.0 && self.noise[k] > 0.0 {
            true => (sums[k][0] / sums[k][1]).sqrt() / self.noise[k],
            false => 0.0,
        };
        [rms(0), rms(1), rms(2)]
    }

    /// Every level, set-up by set-up.
    pub fn levels(&self) -> Vec<Level> {
        self.rests.iter().flat_map(Rest::levels).collect()
    }

    /// What the lines leave at every level, in standard deviations of the mean there.
    pub fn left(&self) -> Vec<f64> {
        let own = |rest: &Rest| rest.project(&rest.readings, self.noise[rest.component]).1;
        self.rests.iter().flat_map(own).collect()
    }

    /// A displacement over force (m, by point, direction, force in N and the force before it in the
    /// same cycle) seen in the same way: the slopes that its lines would have, m/N, and what they would leave, in the units of [`Shapes::left`].
    pub fn seen(
        &self,
        of: impl Fn(usize, usize, f64, Option<f64>) -> V3,
    ) -> (Vec<[Option<f64>; 3]>, Vec<f64>) {
        let mut slopes = vec![[None; 3]; self.setups.len()];
        let mut left = Vec::new();
        for rest in &self.rests {
            let moved = |(i, r): (usize, &Reading)| Reading {
                displacement: of(rest.point, rest.direction, r.force, rest.before(i))
                    [rest.component],
                ..*r
            };
            let readings: Vec<Reading> = rest.readings.iter().enumerate().map(moved).collect();
            let (slope, own) = rest.project(&readings, self.noise[rest.component]);
            let here = |s: &Setup| s.point == rest.point && s.direction == rest.direction;
            if let Some(i) = self.setups.iter().position(here) {
                slopes[i][rest.component] = slope;
            }
            left.extend(own);
        }
        (slopes, left)
    }

    /// Degrees of freedom of [`Shapes::left`]: every line and every intercept has taken one.
    pub fn freedom(&self) -> f64 {
        let own =
            |rest: &Rest| (rest.count.iter().filter(|n| **n > 0.0).count() as f64 - 2.0).max(0.0);
        self.rests.iter().map(own).sum()
    }

    /// Readings left out as wild.
    pub fn wild(&self) -> usize {
        let lines = self.setups.iter().flat_map(|s| s.lines);
        lines.flatten().map(|line| line.wild).sum()
    }
}

/// Which readings are used: one that the other cycles do not repeat, and that lies off the line by
/// far, is wild. What all cycles repeat is shape, however far off.
fn tame(residuals: &[f64], cells: &[usize], count: usize) -> Vec<f64> {
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
    let limit = WILD * spread(residuals).max(f64::MIN_POSITIVE);
    let off = |(r, c): (&f64, &usize)| r.abs() > limit && (r - middles[*c]).abs() > limit;
    let kept = |one| if off(one) { 0.0 } else { 1.0 };
    let kept: Vec<f64> = residuals.iter().zip(cells).map(kept).collect();
    match kept.iter().sum::<f64>() > 0.5 * kept.len() as f64 {
        true => kept,
        false => vec![1.0; kept.len()],
    }
}

fn share(line: &mut Line, noise: f64, widen: f64) {
    let per_newton = line.stderr / line.scatter.max(f64::MIN_POSITIVE);
    if noise > 0.0 && per_newton.is_finite() && line.scatter > 0.0 {
        line.stderr = per_newton * noise * widen;
    }
    line.freedom = f64::INFINITY;
}

impl Rest {
    fn new(readings: Vec<Reading>, residuals: &[f64], own: &SetupSteps, component: usize) -> Self {
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
        let kept = tame(residuals, &cells, distinct.len());
        let mut count = vec![0.0; distinct.len()];
        cells
            .iter()
            .zip(&kept)
            .for_each(|(cell, w)| count[*cell] += w);
        Self {
            readings,
            kept,
            cells,
            count,
            cycles: own.cycles.len(),
            component,
            point: own.point,
            direction: own.direction,
        }
    }

    /// Squares of the change from one reading to the next beyond the line, and how many there are.
    fn steps(&self) -> (f64, f64) {
        let left = self.left();
        let kept = |i: &usize| {
            let same = self.readings[*i].cycle == self.readings[i - 1].cycle;
            same && self.kept[*i] * self.kept[i - 1] > 0.0
        };
        let changes = (1..left.len()).filter(kept);
        let changes: Vec<f64> = changes.map(|i| (left[i] - left[i - 1]).powi(2)).collect();
        (changes.iter().sum(), changes.len() as f64)
    }

    /// Shares of the even part, of the cubic part and of the loop in what the line leaves.
    fn bends(&self, left: &[f64]) -> [f64; 3] {
        let levels = self.levels();
        let largest = levels.iter().fold(1e-300, |m: f64, l| m.max(l.force.abs()));
        let root: Vec<f64> = self.count.iter().map(|n| n.sqrt()).collect();
        let shape = |of: fn(f64, f64) -> f64| -> Vec<f64> {
            let side = |l: &Level| if l.rising { 1.0 } else { -1.0 };
            let value = |(l, n): (&Level, &f64)| n * of(l.force / largest, side(l));
            levels.iter().zip(&root).map(value).collect()
        };
        let wanted = [
            shape(|_, _| 1.0),
            shape(|f, _| f),
            shape(|f, _| f.abs()),
            shape(|f, _| f * f * f),
            shape(|_, side| side),
        ];
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for mut own in wanted {
            let size = dot(&own, &own).sqrt();
            for before in &basis {
                let share = dot(&own, before);
                own.iter_mut()
                    .zip(before)
                    .for_each(|(o, b)| *o -= share * b);
            }
            let rest = dot(&own, &own).sqrt();
            let scale = if rest > 1e-6 * size { 1.0 / rest } else { 0.0 };
            basis.push(own.iter().map(|o| o * scale).collect());
        }
        [2, 3, 4].map(|k| dot(&basis[k], left))
    }

    /// The line of what was used.
    fn line(&self) -> Option<(Weighted, Vec<f64>)> {
        weighted(&self.readings, &self.kept, self.cycles)
    }

    /// What the line leaves of every reading.
    fn left(&self) -> Vec<f64> {
        let line = self.line();
        line.map_or_else(|| vec![0.0; self.readings.len()], |line| line.1)
    }

    /// The force before a reading in its cycle.
    fn before(&self, i: usize) -> Option<f64> {
        let before = i.checked_sub(1).map(|j| self.readings[j]);
        before
            .filter(|b| b.cycle == self.readings[i].cycle)
            .map(|b| b.force)
    }

    /// Squares of the zeros of the cycles about their mean, m², and how many are free.
    fn zeros(&self, slope: f64) -> [f64; 2] {
        let mut sums = vec![[0.0; 2]; self.cycles];
        for (i, r) in self.readings.iter().enumerate() {
            let zero = r.displacement - slope * r.force;
            let own = &mut sums[r.cycle];
            own[0] += self.kept[i] * zero;
            own[1] += self.kept[i];
        }
        let means: Vec<f64> = sums
            .iter()
            .filter(|s| s[1] > 0.0)
            .map(|s| s[0] / s[1])
            .collect();
        let n = means.len() as f64;
        let mean = means.iter().sum::<f64>() / n.max(1.0);
        let squares = means.iter().map(|m| (m - mean).powi(2)).sum();
        [squares, (n - 1.0).max(0.0)]
    }

    /// Mean over the readings of every cell.
    fn means(&self, values: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.count.len()];
        for (i, (cell, w)) in self.cells.iter().zip(&self.kept).enumerate() {
            sums[*cell] += w * values(i);
        }
        let mean = |(sum, n): (&f64, &f64)| if *n > 0.0 { sum / n } else { 0.0 };
        sums.iter().zip(&self.count).map(mean).collect()
    }

    /// Slope, and what the line leaves in the cells in standard deviations.
    fn project(&self, readings: &[Reading], noise: f64) -> (Option<f64>, Vec<f64>) {
        let Some((fit, left)) = weighted(readings, &self.kept, self.cycles) else {
            return (None, vec![0.0; self.count.len()]);
        };
        let means = self.means(|i| left[i]);
        let scaled = means.iter().zip(&self.count);
        let noise = noise.max(f64::MIN_POSITIVE);
        (
            Some(fit.slope),
            scaled.map(|(m, n)| m * n.sqrt() / noise).collect(),
        )
    }

    /// Squares about the means of the cells, and their degrees of freedom.
    fn scatter(&self, left: &[f64]) -> [f64; 2] {
        let means = self.means(|i| left[i]);
        let square = |(i, cell): (usize, &usize)| self.kept[i] * (left[i] - means[*cell]).powi(2);
        let squares: f64 = self.cells.iter().enumerate().map(square).sum();
        let freedom: f64 = self.count.iter().map(|n| (n - 1.0).max(0.0)).sum();
        [squares, (freedom - (self.cycles as f64 - 1.0)).max(0.0)]
    }

    /// Squares of the slopes of single cycles about the common one, in units of their variance from
    /// `noise`, and their degrees of freedom: slow noise moves slopes more than its scatter says.
    fn slope_scatter(&self, left: &[f64], noise: f64) -> [f64; 2] {
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

    fn levels(&self) -> Vec<Level> {
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

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
