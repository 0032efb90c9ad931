//! From raw force steps to stiffnesses: one line of displacement over force per set-up and
//! component, with an own intercept for every cycle, wild readings left out and counted.

use super::parameter::{Status, Z95};
use super::rounding::Rounding;
use crate::ground::stats::rms;
use crate::measurement::workspace_test::{Step, WorkspaceTest};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Displacement over force of one component in one set-up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Slope, m/N.
    pub slope: f64,
    /// Its standard error from the scatter of the readings, m/N.
    pub stderr: f64,
    /// Degrees of freedom behind it; infinite where the stated noise stands in.
    pub freedom: f64,
    /// Scatter about the line, m.
    pub scatter: f64,
    /// Readings used.
    pub rows: usize,
    /// Readings left out as wild.
    pub wild: usize,
}

/// One point, loaded in one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Index of the point, from 0.
    pub point: usize,
    /// Direction of the force: 0 x, 1 y, 2 z.
    pub direction: usize,
    /// Number of cycles.
    pub cycles: usize,
    /// Force steps.
    pub rows: usize,
    /// The line of each displacement component; `None` where it was not measured.
    pub lines: [Option<Line>; 3],
}

/// Force over displacement along the same direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// Value, N/m; `None` unless the readings support it.
    pub value: Option<f64>,
    /// Its standard error, N/m.
    pub stderr: Option<f64>,
    /// 95 % interval, N/m, repeatability of the set-up included.
    pub ci95: Option<[f64; 2]>,
    /// Whether the readings support it.
    pub status: Status,
}

/// Readings further from the line than this many robust standard deviations are wild.
pub(super) const WILD: f64 = 6.0;
/// Above this relative standard deviation a slope is no measurement.
const UNSUPPORTED: f64 = 0.5;

/// Every set-up of a file, by point and direction.
pub fn setups(test: &WorkspaceTest) -> Vec<Setup> {
    let known = known(test);
    let line = |own: &SetupSteps, component: usize| {
        let readings = own.readings(component);
        straight(&readings, own.cycles.len(), known[component]).map(|fit| fit.line)
    };
    let of = |own: SetupSteps| Setup {
        point: own.point,
        direction: own.direction,
        cycles: own.cycles.len(),
        rows: own.steps.len(),
        lines: [line(&own, 0), line(&own, 1), line(&own, 2)],
    };
    by_setup(test).into_iter().map(of).collect()
}

/// The steps of one set-up, in the order of the file.
pub(super) struct SetupSteps<'a> {
    pub point: usize,
    pub direction: usize,
    pub steps: Vec<&'a Step>,
    pub cycles: Vec<i64>,
}

/// The steps of a file by point and direction.
pub(super) fn by_setup(test: &WorkspaceTest) -> Vec<SetupSteps<'_>> {
    let mut found: std::collections::BTreeMap<(usize, usize), Vec<&Step>> = Default::default();
    for step in &test.steps {
        let key = (step.point, step.direction);
        found.entry(key).or_default().push(step);
    }
    let all = found.into_iter();
    all.map(|((point, direction), steps)| SetupSteps::new(point, direction, steps))
        .collect()
}

impl<'a> SetupSteps<'a> {
    fn new(point: usize, direction: usize, steps: Vec<&'a Step>) -> Self {
        let mut cycles: Vec<i64> = steps.iter().map(|s| s.cycle).collect();
        cycles.sort_unstable();
        cycles.dedup();
        Self {
            point,
            direction,
            steps,
            cycles,
        }
    }

    /// What was measured of one component.
    pub fn readings(&self, component: usize) -> Vec<Reading> {
        let reading = |step: &&Step| Reading::of(step, &self.cycles, component);
        self.steps.iter().filter_map(reading).collect()
    }
}

/// One reading of one component: index of its cycle, N, m.
#[derive(Clone, Copy)]
pub(super) struct Reading {
    pub cycle: usize,
    pub force: f64,
    pub displacement: f64,
}

impl Reading {
    fn of(step: &Step, cycles: &[i64], component: usize) -> Option<Self> {
        let displacement = step.displacement[component];
        (!displacement.is_nan()).then_some(())?;
        Some(Self {
            cycle: cycles.binary_search(&step.cycle).ok()?,
            force: step.force,
            displacement,
        })
    }
}

/// A line with what it leaves of every reading, m.
pub(super) struct Straight {
    pub line: Line,
    pub residuals: Vec<f64>,
}

/// What is known of the readings of one component.
#[derive(Clone, Copy)]
pub(super) struct Known {
    /// Noise of a reading that the data sheet states, m.
    pub noise: Option<f64>,
    pub rounding: Rounding,
}

/// The same of every component of a test.
pub(super) fn known(test: &WorkspaceTest) -> [Known; 3] {
    let noise = test.facts.sensor_noise;
    Rounding::of(test).map(|rounding| Known { noise, rounding })
}

/// Robust start, then least squares over what is not wild. No reading is nearer to the line than its resolution tells.
pub(super) fn straight(readings: &[Reading], cycles: usize, known: Known) -> Option<Straight> {
    let mut weights = vec![1.0; readings.len()];
    let mut scale = 0.0;
    for _ in 0..30 {
        let (_, residuals) = weighted(readings, &weights, cycles)?;
        scale = spread(&residuals).max(known.rounding.error());
        if scale == 0.0 {
            break;
        }
        let huber = |r: &f64| (1.345 * scale / r.abs().max(1e-300)).min(1.0);
        weights = residuals.iter().map(huber).collect();
    }
    let (_, residuals) = weighted(readings, &weights, cycles)?;
    let least = 0.2 * known.noise.unwrap_or(0.0);
    let limit = WILD * scale.max(least).max(f64::MIN_POSITIVE);
    let kept = |r: &f64| if r.abs() <= limit { 1.0 } else { 0.0 };
    let kept: Vec<f64> = residuals.iter().map(kept).collect();
    ordinary(readings, &kept, cycles, known)
        .or_else(|| ordinary(readings, &vec![1.0; kept.len()], cycles, known))
}

fn ordinary(readings: &[Reading], kept: &[f64], cycles: usize, known: Known) -> Option<Straight> {
    let (fit, residuals) = weighted(readings, kept, cycles)?;
    let used = kept.iter().filter(|w| **w > 0.0).count();
    let freedom = used as f64 - 1.0 - fit.cycles as f64;
    let squares: f64 = residuals.iter().zip(kept).map(|(r, w)| w * r * r).sum();
    let rounding = known.rounding;
    let (scatter, freedom) = match (freedom > 0.0, known.noise) {
        (true, _) => ((squares / freedom).sqrt().max(rounding.error()), freedom),
        (false, Some(noise)) => (noise, f64::INFINITY),
        (false, None) => return None,
    };
    Some(Straight {
        line: Line {
            slope: fit.slope,
            stderr: fit.stderr(scatter, rounding, readings),
            freedom,
            scatter,
            rows: used,
            wild: readings.len() - used,
        },
        residuals,
    })
}

pub(super) struct Weighted {
    pub slope: f64,
    pub force_squares: f64,
    cycles: usize,
}

impl Weighted {
    /// Standard error of the slope, m/N, of readings that scatter by `scatter`, m: rounding is the same for all that show
    /// the same number, be it in every cycle or at every load.
    pub fn stderr(&self, scatter: f64, rounding: Rounding, readings: &[Reading]) -> f64 {
        let mut shown: Vec<f64> = readings.iter().map(|r| r.displacement).collect();
        shown.sort_by(f64::total_cmp);
        shown.dedup();
        let again = readings.len() as f64 / shown.len().max(1) as f64 - 1.0;
        let shared = again.sqrt() * rounding.shared(scatter);
        scatter.hypot(shared) / self.force_squares.sqrt()
    }
}

/// Weighted least squares of one slope and an intercept per cycle; `None` without any change of force.
pub(super) fn weighted(
    readings: &[Reading],
    weights: &[f64],
    cycles: usize,
) -> Option<(Weighted, Vec<f64>)> {
    let mut sums = vec![[0.0; 3]; cycles];
    for (reading, w) in readings.iter().zip(weights) {
        let sum = &mut sums[reading.cycle];
        let terms = [*w, w * reading.force, w * reading.displacement];
        (0..3).for_each(|k| sum[k] += terms[k]);
    }
    let centre = |reading: &Reading| {
        let [w, f, d] = sums[reading.cycle];
        let w = if w > 0.0 { w } else { 1.0 };
        (reading.force - f / w, reading.displacement - d / w)
    };
    let (mut squares, mut product, mut largest) = (0.0, 0.0, 0.0_f64);
    for (reading, w) in readings.iter().zip(weights) {
        let (f, d) = centre(reading);
        squares += w * f * f;
        product += w * f * d;
        largest = largest.max(reading.force.abs());
    }
    (squares > 1e-18 * largest * largest && squares > 0.0).then_some(())?;
    let slope = product / squares;
    let residual = |reading: &Reading| {
        let (f, d) = centre(reading);
        d - slope * f
    };
    let fit = Weighted {
        slope,
        force_squares: squares,
        cycles: sums.iter().filter(|sum| sum[0] > 0.0).count(),
    };
    Some((fit, readings.iter().map(residual).collect()))
}

/// Standard deviation by the median of the magnitudes; the root mean square if that is zero.
pub(super) fn spread(residuals: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    match sizes.get(sizes.len() / 2) {
        Some(median) if *median > 0.0 => 1.4826 * median,
        _ => rms(&sizes),
    }
}

impl Setup {
    /// Force over displacement along the force. `repeatability`: relative standard deviation of the set-up.
    pub fn stiffness(&self, repeatability: f64) -> Stiffness {
        let unsupported = Stiffness {
            value: None,
            stderr: None,
            ci95: None,
            status: Status::NotIdentifiable,
        };
        let Some(line) = self.lines[self.direction] else {
            return unsupported;
        };
        let shared = repeatability * line.slope;
        let stderr = line.stderr.hypot(shared);
        let supported = line.slope > 0.0 && stderr < UNSUPPORTED * line.slope;
        let half = quantile(line.freedom * (stderr / line.stderr).powi(4)) * stderr;
        if !supported || half >= line.slope {
            return unsupported;
        }
        Stiffness {
            value: Some(1.0 / line.slope),
            stderr: Some(stderr / line.slope.powi(2)),
            ci95: Some([1.0 / (line.slope + half), 1.0 / (line.slope - half)]),
            status: Status::Identified,
        }
    }
}

/// 97.5 % point of Student's distribution (Welch and Satterthwaite's degrees of freedom).
pub fn quantile(freedom: f64) -> f64 {
    match StudentsT::new(0.0, 1.0, freedom) {
        Ok(student) if freedom.is_finite() && freedom < 1e6 => student.inverse_cdf(0.975),
        _ => Z95,
    }
}
