//! Force steps to their last shape: the line of every set-up with the noise that all set-ups share,
//! and what the line leaves, averaged over the cycles level by level. A clearance or a loop shows there.

pub use super::force_rest::Level;
use super::force_rest::Rest;
use super::force_steps::{Line, Reading, Setup, by_setup, setups, straight};
use crate::ground::spatial::V3;
use crate::measurement::workspace_test::WorkspaceTest;

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
    /// Slow noise moves the even part, the cubic part and the loop of a line so many times as much as the
    /// scatter says.
    slow: [f64; 3],
    /// Noise that the data sheet states, m.
    stated: Option<f64>,
    rests: Vec<Rest>,
}

/// Scatter this many times that of neighbours is shape.
const SHAPE: f64 = 2.0;
/// Degrees of freedom that the data sheet's noise is worth.
const LIKELY: f64 = 30.0;
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
            slow: [1.0; 3],
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
                true => self.no_less(*sum, k, &sums),
                false => self.without_repeats((own / rows.max(1.0)).sqrt(), k),
            };
        }
        self.wander = self.wandering();
        (0..3).for_each(|k| self.wander[k] = self.wander[k].max(self.growth(k)));
        for (rest, left) in self.rests.iter().zip(&left) {
            let own = rest.slope_scatter(left, self.noise[rest.component]);
            (0..2).for_each(|k| slopes[k] += own[k]);
        }
        let widen = match slopes[1] >= FREEDOM {
            true => (slopes[0] / slopes[1]).sqrt().max(1.0),
            false => self.slowness(),
        };
        self.widen = widen;
        self.slow = self.slow_bends(&left, widen);
        let noise = self.noise;
        let lines = self.setups.iter_mut().flat_map(|s| s.lines.iter_mut());
        for (i, line) in lines.enumerate() {
            if let Some(line) = line {
                share(line, noise[i % 3], widen);
            }
        }
    }

    /// How much more than independent readings would the cycles of a line differ in their bends; where
    /// too few repeat one, as much as in their slopes.
    fn slow_bends(&self, left: &[Vec<f64>], widen: f64) -> [f64; 3] {
        let (mut sums, mut freedom) = ([0.0; 3], 0.0);
        for (rest, left) in self.rests.iter().zip(left) {
            let (own, free) = rest.bend_scatter(left, self.noise[rest.component]);
            (0..3).for_each(|k| sums[k] += own[k]);
            freedom += free;
        }
        match freedom >= FREEDOM {
            true => sums.map(|s| (s / freedom).sqrt().max(1.0)),
            false => [widen; 3],
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

    /// Noise of a component whose levels are repeated; where few are, no less than the data sheet or
    /// the other components make likely: few repetitions agree by chance.
    fn no_less(&self, [squares, freedom]: [f64; 2], component: usize, all: &[[f64; 2]; 3]) -> f64 {
        let others = (0..3).filter(|k| *k != component && all[*k][1] >= FREEDOM);
        let others = others.map(|k| all[k][0] / all[k][1]);
        let others = others.fold(f64::INFINITY, f64::min);
        let stated = self.stated.unwrap_or(0.0).powi(2);
        let likely = stated.max(if others.is_finite() { others } else { 0.0 });
        let own = squares / freedom;
        let drawn = (squares + LIKELY * likely) / (freedom + LIKELY);
        own.max(drawn).sqrt()
    }

    /// Noise of a component whose levels are not repeated: the scatter about the lines, unless
    /// neighbours agree so much better, and the data sheet with them, that the rest is shape.
    fn without_repeats(&self, scatter: f64, component: usize) -> f64 {
        let short = self.short(component).max(self.stated.unwrap_or(scatter));
        match scatter > SHAPE * short {
            true => short,
            false => scatter,
        }
    }

    /// Noise of a component by the change from one reading to the next, m.
    fn short(&self, component: usize) -> f64 {
        let own = self.rests.iter().filter(|rest| rest.component == component);
        let (squares, count) = own.fold((0.0, 0.0), |(s, n), rest| {
            let (own, rows) = rest.steps();
            (s + own, n + rows)
        });
        (0.5 * squares / f64::max(count, 1.0)).sqrt()
    }

    /// How far repeated levels of one component drift apart within a cycle, in the units of
    /// [`Shapes::wander`]: readings that repeat far worse than their neighbours agree grow with time.
    fn growth(&self, component: usize) -> f64 {
        let short = self.short(component).max(self.stated.unwrap_or(0.0));
        match short > 0.0 {
            true => self.noise[component] / (2.0 * short),
            false => 0.0,
        }
    }

    /// Bends of simple form in what the lines leave (in the units of [`Shapes::left`]): the squares of
    /// the even part, of the cubic part and of the loop, in variances of the noise, and their number.
    pub fn bends(&self, left: &[f64]) -> ([f64; 3], f64) {
        let (mut sums, mut at) = ([0.0; 3], 0);
        let mean = self.slow.iter().sum::<f64>() / 3.0;
        for rest in &self.rests {
            let noise = self.slow_noise(rest);
            let own = rest.bends(&left[at..at + rest.count.len()], noise);
            (0..3).for_each(|k| sums[k] += (own[k] * mean / self.slow[k]).powi(2));
            at += rest.count.len();
        }
        (sums, self.rests.len() as f64)
    }

    /// What counts as the noise of a reading where levels are compared, m: bends are what tells laws.
    fn slow_noise(&self, rest: &Rest) -> f64 {
        let mean = self.slow.iter().sum::<f64>() / 3.0;
        self.noise[rest.component] * mean
    }

    /// Puts up with a deviation of the model at every level beside the noise, m, in the order of [`Shapes::levels`].
    pub fn doubt(&mut self, levels: &[f64]) {
        let mut first = 0;
        for rest in &mut self.rests {
            let last = first + rest.count.len();
            rest.doubt = levels[first..last].to_vec();
            first = last;
        }
    }

    /// Whether what the lines leave (in the units of [`Shapes::left`]) is hardly noise.
    pub fn is_bent(&self, left: &[f64]) -> bool {
        let (sums, count) = self.bends(left);
        let most = |freedom: f64| freedom + 4.0 * (2.0 * freedom).sqrt();
        let squares: f64 = left.iter().map(|l| l * l).sum();
        let freedom = self.freedom();
        squares > most(freedom) || sums.iter().any(|sum| *sum > most(count))
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
        let own = |rest: &Rest| rest.project(&rest.readings, self.slow_noise(rest)).1;
        self.rests.iter().flat_map(own).collect()
    }

    /// A displacement over force (m, by point, direction and the forces in N in their order) seen in the
    /// same way: the slopes that its lines would have, m/N, and what they would leave, in the units of
    /// [`Shapes::left`].
    pub fn seen(
        &self,
        of: impl Fn(usize, usize, &[f64]) -> Vec<V3>,
    ) -> (Vec<[Option<f64>; 3]>, Vec<f64>) {
        let mut slopes = vec![[None; 3]; self.setups.len()];
        let mut left = Vec::new();
        for rest in &self.rests {
            let forces: Vec<f64> = rest.readings.iter().map(|r| r.force).collect();
            let moved = of(rest.point, rest.direction, &forces);
            let moved = moved.iter().zip(&rest.readings).map(|(m, r)| Reading {
                displacement: m[rest.component],
                ..*r
            });
            let readings: Vec<Reading> = moved.collect();
            let (slope, own) = rest.project(&readings, self.slow_noise(rest));
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

fn share(line: &mut Line, noise: f64, widen: f64) {
    let per_newton = line.stderr / line.scatter.max(f64::MIN_POSITIVE);
    if noise > 0.0 && per_newton.is_finite() && line.scatter > 0.0 {
        line.stderr = per_newton * noise * widen;
    }
    line.freedom = f64::INFINITY;
}
