//! The noise that all set-ups of a test of force steps share: its size, how slow it is, how it grows with the load.

use super::force_rest::{Level, Rest};
use super::force_shapes::Shapes;
use super::force_steps::Line;
use super::noise_growth::growth;

/// Scatter this many times that of neighbours is shape.
const SHAPE: f64 = 2.0;
/// Degrees of freedom that the data sheet's noise is worth.
const LIKELY: f64 = 30.0;
/// Set-ups that bend to one side below which these say nothing of all.
const FEW: f64 = 4.0;
/// Degrees of freedom below which the scatter between cycles is not trusted.
const FREEDOM: f64 = 12.0;

impl Shapes {
    /// Every set-up gets the noise of all: thirty readings say little of their own scatter.
    pub(super) fn share_noise(&mut self) {
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
            let noise = match sum[1] >= FREEDOM {
                true => self.no_less(*sum, k, &sums),
                false => self.without_repeats((own / rows.max(1.0)).sqrt(), k),
            };
            self.noise[k] = noise.max(self.rounding(k));
        }
        (0..3).for_each(|k| self.grow(k, &left));
        self.wander = self.wandering();
        (0..3).for_each(|k| self.wander[k] = self.wander[k].max(self.drift(k)));
        for (rest, left) in self.rests.iter().zip(&left) {
            let own = rest.slope_scatter(left, self.noise[rest.component]);
            (0..2).for_each(|k| slopes[k] += own[k]);
        }
        let widen = match slopes[1] >= FREEDOM {
            true => (slopes[0] / slopes[1]).sqrt().max(1.0),
            false => self.slowness(),
        };
        self.widen = widen;
        let (slow, strayed) = (self.slow_bends(&left, widen), self.strayed());
        self.slow = [0, 1, 2].map(|k| slow[k].max(strayed[k]));
        let noise = self.noise;
        let lines = self.setups.iter_mut().flat_map(|s| s.lines.iter_mut());
        for (i, line) in lines.enumerate() {
            if let Some(line) = line {
                share(line, noise[i % 3], widen);
            }
        }
    }

    /// Noise that grows with the load (a target that turns away, speckle): its square over that of the force,
    /// where it does so beyond chance.
    fn grow(&mut self, component: usize, left: &[Vec<f64>]) {
        let own = self
            .rests
            .iter()
            .zip(left)
            .filter(|(rest, _)| rest.component == component);
        let seen: Vec<(f64, f64)> = own.flat_map(|(rest, left)| rest.noises(left)).collect();
        let largest = seen.iter().fold(f64::MIN_POSITIVE, |m: f64, s| m.max(s.0));
        let points = seen
            .iter()
            .map(|(force, square)| ((force / largest).powi(2), *square));
        let Some(growth) = growth(&points.collect::<Vec<_>>()) else {
            return;
        };
        for rest in self
            .rests
            .iter_mut()
            .filter(|rest| rest.component == component)
        {
            let rise = |level: &Level| growth.at((level.force / largest).powi(2));
            rest.rise = rest.levels().iter().map(rise).collect();
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

    /// How much more than independent readings would set-ups bend to the side to which none gives way: what drifts
    /// within a cycle bends its line to either side, what a joint does to one. A loop that gives work back is none; an
    /// even or a cubic part is the joint's on one side alone.
    fn strayed(&self) -> [f64; 3] {
        let mut sides = [[[0.0; 2]; 2]; 3];
        for rest in self
            .rests
            .iter()
            .filter(|rest| rest.component == rest.direction)
        {
            let noise = self.noise[rest.component];
            let (Some(slope), left) = rest.project(&rest.readings, noise) else {
                continue;
            };
            let bends = rest.bends(&left, noise);
            for (sides, bend) in sides.iter_mut().zip(bends) {
                let side = &mut sides[usize::from(bend * slope > 0.0)];
                (side[0], side[1]) = (side[0] + bend * bend, side[1] + 1.0);
            }
        }
        let [even, cubic, looped] = sides;
        let of = |[squares, count]: [f64; 2]| match count >= FEW {
            true => (squares / count).sqrt(),
            false => 0.0,
        };
        let less = |[a, b]: [[f64; 2]; 2]| of(a).min(of(b));
        [less(even), less(cubic), of(looped[1])]
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

    /// Error of one reading of a component by its resolution, m.
    fn rounding(&self, component: usize) -> f64 {
        let mut own = self.rests.iter().filter(|rest| rest.component == component);
        own.next().map_or(0.0, |rest| rest.rounding.error())
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
    fn drift(&self, component: usize) -> f64 {
        let short = self.short(component).max(self.stated.unwrap_or(0.0));
        match short > 0.0 {
            true => self.noise[component] / (2.0 * short),
            false => 0.0,
        }
    }
}

fn share(line: &mut Line, noise: f64, widen: f64) {
    let per_newton = line.stderr / line.scatter.max(f64::MIN_POSITIVE);
    if noise > 0.0 && per_newton.is_finite() && line.scatter > 0.0 {
        line.stderr = per_newton * noise * widen;
    }
    line.freedom = f64::INFINITY;
}
