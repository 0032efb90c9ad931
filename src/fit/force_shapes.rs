//! Force steps to their last shape: the line of every set-up with the noise that all set-ups share,
//! and what the line leaves, averaged over the cycles level by level. A clearance or a loop shows there.

pub use super::force_rest::Level;
use super::force_rest::Rest;
use super::force_steps::{Reading, Setup, by_setup, known, setups, straight};
use super::shared_errors::SharedErrors;
use crate::ground::spatial::V3;
use crate::measurement::workspace_test::WorkspaceTest;

/// A workspace test, reduced.
pub struct Shapes {
    /// The line of every set-up, by point and direction, with the noise that all set-ups share.
    pub setups: Vec<Setup>,
    /// Standard deviation of a reading by component, m.
    pub noise: [f64; 3],
    /// Slow noise moves slopes and bends so many times as much as the scatter says.
    pub widen: f64,
    /// How far the zero of a component wanders from cycle to cycle, in standard deviations of a reading.
    pub wander: [f64; 3],
    /// Slow noise moves the even part, the cubic part and the loop of a line so many times as much as the
    /// scatter says.
    pub(super) slow: [f64; 3],
    /// Noise that the data sheet states, m.
    pub(super) stated: Option<f64>,
    pub(super) rests: Vec<Rest>,
    /// Errors that levels of many set-ups share.
    shared: Option<SharedErrors>,
}

impl Shapes {
    /// Of a test.
    pub fn of(test: &WorkspaceTest) -> Self {
        let known = known(test);
        let mut rests = Vec::new();
        for own in by_setup(test) {
            for (component, known) in known.into_iter().enumerate() {
                let readings = own.readings(component);
                let Some(fit) = straight(&readings, own.cycles.len(), known) else {
                    continue;
                };
                let rest = Rest::new(readings, &fit.residuals, &own, component, known.rounding);
                rests.push(rest);
            }
        }
        let mut shapes = Self {
            setups: setups(test),
            noise: [0.0; 3],
            widen: 1.0,
            slow: [1.0; 3],
            stated: test.facts.sensor_noise,
            wander: [0.0; 3],
            rests,
            shared: None,
        };
        shapes.take_lines();
        shapes.share_noise();
        shapes
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
                let freedom = used - 1.0 - rest.cycles as f64;
                line.slope = fit.slope;
                // no more readings than unknowns do not scatter: only a stated noise made a line of them
                let scatter = match freedom > 0.0 {
                    true => (squares / freedom).sqrt(),
                    false => self.stated.unwrap_or(line.scatter),
                };
                line.scatter = scatter.max(rest.rounding.error());
                line.stderr = fit.stderr(line.scatter, rest.rounding, &rest.readings);
                line.rows = used as usize;
                line.wild = rest.kept.len() - used as usize;
            }
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

    /// Puts up with errors that many levels share: what one standard deviation of each does, in the units of
    /// [`Shapes::left`].
    pub fn share(&mut self, errors: &[Vec<f64>]) {
        self.shared = SharedErrors::of(errors);
    }

    fn whitened(&self, left: Vec<f64>) -> Vec<f64> {
        match &self.shared {
            Some(shared) => shared.whiten(left),
            None => left,
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

    /// The set-up at a point that was loaded along a direction.
    pub fn setup(&self, point: usize, direction: usize) -> Option<usize> {
        let key = |s: &Setup| (s.point, s.direction);
        let found = self.setups.binary_search_by_key(&(point, direction), key);
        found.ok()
    }

    /// Every level, set-up by set-up.
    pub fn levels(&self) -> Vec<Level> {
        self.rests.iter().flat_map(Rest::levels).collect()
    }

    /// Standard deviation of what is left at every level, m, in the order of [`Shapes::levels`].
    pub fn spreads(&self) -> Vec<f64> {
        let own = |rest: &Rest| {
            rest.weights(self.slow_noise(rest))
                .into_iter()
                .map(f64::recip)
        };
        self.rests.iter().flat_map(own).collect()
    }

    /// What the lines leave at every level, in standard deviations of the mean there, less what errors that
    /// they share may do.
    pub fn left(&self) -> Vec<f64> {
        let own = |rest: &Rest| rest.project(&rest.readings, self.slow_noise(rest)).1;
        self.whitened(self.rests.iter().flat_map(own).collect())
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
        // the components of a set-up mostly share their forces
        let mut last: Option<(usize, usize, Vec<f64>, Vec<V3>)> = None;
        for rest in &self.rests {
            let forces: Vec<f64> = rest.readings.iter().map(|r| r.force).collect();
            let (point, direction) = (rest.point, rest.direction);
            let again =
                |(p, d, f, _): &(_, _, Vec<f64>, _)| (*p, *d, f) == (point, direction, &forces);
            let moved = match last.take().filter(again) {
                Some((.., moved)) => moved,
                None => of(point, direction, &forces),
            };
            let (_, _, _, moved) = last.insert((point, direction, forces, moved));
            let moved = moved.iter().zip(&rest.readings).map(|(m, r)| Reading {
                displacement: m[rest.component],
                ..*r
            });
            let readings: Vec<Reading> = moved.collect();
            let (slope, own) = rest.project(&readings, self.slow_noise(rest));
            if let Some(i) = self.setup(rest.point, rest.direction) {
                slopes[i][rest.component] = slope;
            }
            left.extend(own);
        }
        (slopes, self.whitened(left))
    }

    /// Degrees of freedom of [`Shapes::left`]: every line and every intercept has taken one.
    pub fn freedom(&self) -> f64 {
        let own =
            |rest: &Rest| (rest.count.iter().filter(|n| **n > 0.0).count() as f64 - 2.0).max(0.0);
        self.rests.iter().map(own).sum()
    }
}
