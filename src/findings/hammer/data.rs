//! The measured accelerances as a diagnosis weighs them.

use crate::experiments::hammer_alike::alike;
use crate::experiments::hammer_frf::HammerFrf;
use crate::experiments::hammer_variance::{Parts, parts};
use crate::motion::frf::C64;
use crate::signal::frf::CrossSpectra;
use crate::signal::mains::MAINS_HZ;
use crate::signal::window::Exponential;

/// The rows of a 3×3 accelerance by name.
pub const AXES: [&str; 3] = ["x", "y", "z"];
/// A linear model of a robot misses its accelerance by this share of it, and of its root mean square
/// in the band: hits unlike each other, a sensor beside its point, bodies that are not quite rigid. A guess before the data
/// ([`Data::doubting`]).
const MODEL_ERROR: [f64; 2] = [0.0045, 0.002];

/// How far a line of the mains reaches: lines of the record (the main lobe without a window), but at least so many Hz, since
/// a declared window spreads it (skirts of 1 Hz stood above the scatter of three hits in files of `tests/judge/hammer`,
/// seeds 41 and 43), and at most so many: of a record of half a second three lines would be fifteen hertz of the band.
const MAINS_LINES: f64 = 1.6;
const MAINS_REACH_HZ: [f64; 2] = [1.25, 2.5];

/// Which band, and how dense.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Lowest line, Hz.
    pub from_hz: f64,
    /// Highest line, Hz.
    pub to_hz: f64,
    /// Least distance of two lines, Hz.
    pub step_hz: f64,
}

/// One measured pair: output, input, values, and the weight of either part of each (one over its
/// standard deviation).
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// Direction of the acceleration, 0 to 2.
    pub output: usize,
    /// Direction of the force, 0 to 2.
    pub input: usize,
    /// Accelerance, (m/s²)/N.
    pub frf: Vec<C64>,
    /// Weights, N/(m/s²).
    pub weight: Vec<f64>,
    /// Variance of each by the scatter of the hits.
    pub scatter: Vec<Parts>,
}

/// Pairs on common lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Data {
    /// `s = jω + σ` of every line, declared windows included.
    pub s: Vec<C64>,
    /// The pairs.
    pub pairs: Vec<Pair>,
    /// How many lines carry the information of one: a window correlates its neighbours.
    pub correlated: f64,
    /// The share that counts of what the model misses and of what the hits differ.
    pub doubt: f64,
}

impl Data {
    /// All hits that were used.
    pub fn of(frf: &HammerFrf, grid: Grid) -> Self {
        let sums: Vec<CrossSpectra> = frf.inputs.iter().map(|i| i.sums.clone()).collect();
        Self::with(frf, &sums, grid, 1.0)
    }

    /// One hit of every direction left out, and those hits alone: fold `k` of `folds`.
    pub fn fold(frf: &HammerFrf, grid: Grid, k: usize, folds: usize) -> Option<[Self; 2]> {
        let part = |mine: bool| -> Option<Vec<CrossSpectra>> {
            let of = |input: &crate::experiments::hammer_frf::InputFrf| {
                let some = input.hits.iter().enumerate();
                let some = some.filter(|(i, _)| (i % folds == k) == mine);
                let hits: Vec<_> = some.map(|(_, hit)| hit).collect();
                (!hits.is_empty()).then(|| CrossSpectra::of(hits))
            };
            frf.inputs.iter().map(of).collect()
        };
        let share = 1.0 / folds as f64;
        let fitted = Self::with(frf, &part(false)?, grid, 1.0 - share);
        Some([fitted, Self::with(frf, &part(true)?, grid, share)])
    }

    /// Every so many lines left out, and those alone: part `k` of `folds`, in stretches that share no window. For tests of which
    /// no hit can be left out.
    pub fn stretches(&self, k: usize, folds: usize) -> [Self; 2] {
        let wide = self.correlated.ceil().max(1.0) as usize;
        [false, true].map(|mine| self.only(|line| (line / wide % folds == k) == mine))
    }

    fn only(&self, kept: impl Fn(usize) -> bool) -> Self {
        fn of<T: Copy>(all: &[T], kept: impl Fn(usize) -> bool) -> Vec<T> {
            let own = all.iter().enumerate().filter(|(line, _)| kept(*line));
            own.map(|(_, value)| *value).collect()
        }
        let pair = |pair: &Pair| Pair {
            frf: of(&pair.frf, &kept),
            weight: of(&pair.weight, &kept),
            scatter: of(&pair.scatter, &kept),
            ..*pair
        };
        Self {
            s: of(&self.s, &kept),
            pairs: self.pairs.iter().map(pair).collect(),
            ..*self
        }
    }

    /// The same where model and hits are wrong by a share of what is put up with before the data.
    pub fn doubting(&self, share: f64) -> Self {
        let pair = |pair: &Pair| Pair {
            weight: weights(&pair.frf, &pair.scatter, self.correlated, share),
            ..pair.clone()
        };
        Self {
            s: self.s.clone(),
            pairs: self.pairs.iter().map(pair).collect(),
            doubt: share,
            ..*self
        }
    }

    /// What a linear model misses of an accelerance, as a share of it.
    pub fn model_error(&self) -> f64 {
        self.doubt * MODEL_ERROR[0]
    }

    fn with(frf: &HammerFrf, sums: &[CrossSpectra], grid: Grid, share: f64) -> Self {
        let lines = lines(frf, grid);
        let all = every_line(frf, grid);
        let row = |name: &str| AXES.iter().position(|axis| *axis == name);
        let mut pairs = Vec::new();
        let correlated = independent(frf, &lines);
        for (input, sums) in sums.iter().enumerate() {
            let Some(from) = row(&frf.inputs[input].input) else {
                continue;
            };
            for (o, scatter) in scatter(frf, input, [&all, &lines], share) {
                let to = row(&frf.outputs[o]);
                pairs.extend(to.map(|to| {
                    let values = lines.iter().map(|k| sums.lines[o][all[*k]].h1());
                    let frf: Vec<C64> = values.collect();
                    Pair {
                        output: to,
                        input: from,
                        weight: weights(&frf, &scatter, correlated, 1.0),
                        frf,
                        scatter,
                    }
                }));
            }
        }
        let line =
            |k: &usize| C64::new(frf.rate, std::f64::consts::TAU * frf.frequency_hz[all[*k]]);
        Self {
            s: lines.iter().map(line).collect(),
            pairs,
            correlated,
            doubt: 1.0,
        }
    }

    /// Frequencies of the lines, Hz.
    pub fn hz(&self) -> Vec<f64> {
        self.s
            .iter()
            .map(|s| s.im / std::f64::consts::TAU)
            .collect()
    }

    /// Real rows: two per value.
    pub fn rows(&self) -> usize {
        2 * self.s.len() * self.pairs.len()
    }

    /// Real rows that are independent of each other.
    pub fn freedom(&self) -> f64 {
        self.rows() as f64 / self.correlated
    }

    /// Name of a pair, output before input: `zx` is the acceleration along z under a force along x.
    pub fn name(&self, pair: usize) -> String {
        let pair = &self.pairs[pair];
        format!("{}{}", AXES[pair.output], AXES[pair.input])
    }
}

/// Per output along x, y or z the variance at `lines`, places in `all`, from a `share` of the hits of `input`.
fn scatter(
    frf: &HammerFrf,
    input: usize,
    [all, lines]: [&[usize]; 2],
    share: f64,
) -> Vec<(usize, Vec<Parts>)> {
    let of = |output: usize| {
        let every = parts(&frf.inputs[input], output, all);
        let fewer = lines.iter().map(|k| every[*k].times(1.0 / share));
        (output, fewer.collect())
    };
    let known = (0..frf.outputs.len()).filter(|o| AXES.contains(&frf.outputs[*o].as_str()));
    let mut scatter: Vec<(usize, Vec<Parts>)> = known.map(of).collect();
    let own: Vec<usize> = lines.iter().map(|k| all[*k]).collect();
    let alike = alike(&frf.inputs, input, &scatter, &own, independent(frf, lines));
    for part in scatter.iter_mut().flat_map(|s| &mut s.1) {
        *part = part.with_alike(alike);
    }
    scatter
}

fn every_line(frf: &HammerFrf, grid: Grid) -> Vec<usize> {
    let inside = |k: &usize| (grid.from_hz..=grid.to_hz).contains(&frf.frequency_hz[*k]);
    (1..frf.frequency_hz.len()).filter(inside).collect()
}

/// Places in [`every_line`] at the step of the grid, without those of the mains.
fn lines(frf: &HammerFrf, grid: Grid) -> Vec<usize> {
    let stride = (grid.step_hz * frf.length_s).round().max(1.0) as usize;
    let [least, most] = MAINS_REACH_HZ;
    let reach = (MAINS_LINES / frf.length_s).clamp(least, most);
    let all = every_line(frf, grid);
    let humming = |k: &usize| {
        let hz = frf.frequency_hz[all[*k]];
        MAINS_HZ.iter().any(|mains| (hz - mains).abs() < reach)
    };
    let lines = (0..all.len()).step_by(stride);
    lines.filter(|k| !humming(k)).collect()
}

/// How many of the lines carry the information of one.
fn independent(frf: &HammerFrf, lines: &[usize]) -> f64 {
    let stride = lines.windows(2).map(|w| w[1] - w[0]).next().unwrap_or(1);
    let window = Exponential { rate: frf.rate };
    let all = window.lines_per_independent_one(frf.length_s);
    (all / stride as f64).max(1.0)
}

/// Of the parts of a variance that of the response is noise, other on every line. What the model misses, and what one hit differs
/// from another, is alike on many and may be taken by what is uncertain anyway: of these a share counts.
fn weights(values: &[C64], scatter: &[Parts], independent: f64, doubt: f64) -> Vec<f64> {
    let mean = values.iter().map(|h| h.norm_sqr()).sum::<f64>() / values.len().max(1) as f64;
    let [own, all] = MODEL_ERROR.map(|share| share.powi(2));
    let error = |h: &C64| own * h.norm_sqr() + all * mean;
    let of = |(h, v): (&C64, &Parts)| v.response + doubt.powi(2) * (v.hits + error(h));
    let each = values.iter().zip(scatter).map(of);
    let variance = each.map(|v| v * independent);
    variance.map(|v| (2.0 / v).sqrt()).collect()
}

#[cfg(test)]
mod tests {
    use super::{C64, MODEL_ERROR, Parts, weights};

    /// Noise of the response stays, of what lines share a share counts.
    #[test]
    fn doubt_leaves_the_noise_of_the_response() {
        let scatter = Parts {
            response: 3e-6,
            hits: 1e-4,
        };
        let variance = |doubt: f64| {
            let all = weights(&[C64::new(0.6, 0.8)], &[scatter], 1.0, doubt);
            2.0 / all[0].powi(2)
        };
        let shared = 1e-4 + MODEL_ERROR[0].powi(2) + MODEL_ERROR[1].powi(2);
        for doubt in [1.0, 0.5, 0.125] {
            let right = 3e-6 + doubt * doubt * shared;
            assert!((variance(doubt) / right - 1.0).abs() < 1e-12);
        }
    }
}
