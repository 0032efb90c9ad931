//! Hammer tests: variance of the FRFs, from the scatter of the hits.

use super::hammer_frf::InputFrf;
use crate::ground::stats::mean;
use crate::signal::frf::Estimator;
use crate::signal::jackknife::frf_variance;
use std::ops::Range;

/// Half width, lines, over which variances are fitted: few hits give rough ones.
const SMOOTHING: usize = 10;
/// Passes of that fit, each weighing the lines by the last.
const PASSES: usize = 3;
/// Times the fitted variance above which the scatter of a line counts alone.
const OUTLYING: f64 = 4.0;
/// Determinant, over that of unlike columns, below which the two parts are not told apart.
const ALIKE: f64 = 1e-9;
/// Relative standard deviation taken for a single hit, which shows no scatter, beside the noise before
/// it.
const SINGLE: f64 = 0.01;
/// Least relative standard deviation, of the value and of its root mean square in the band: digits,
/// cables and the model of a record leave no less.
const FLOOR: f64 = 0.0006;

/// Variance of one value, ((m/s²)/N)², `var(Re) + var(Im)`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Parts {
    /// Noise of the response: other on every line.
    pub response: f64,
    /// What follows the power of the FRF: noise of the force, and hits that are not alike.
    pub hits: f64,
}

impl Parts {
    /// Both.
    pub fn sum(&self) -> f64 {
        self.response + self.hits
    }

    /// So many times as large.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self {
            response: factor * self.response,
            hits: factor * self.hits,
        }
    }

    /// Where no more than a share of what hits differ is alike on all lines ([`super::hammer_alike`]): the rest is other on every line, too.
    #[must_use]
    pub fn with_alike(self, share: f64) -> Self {
        Self {
            response: self.response + (1.0 - share) * self.hits,
            hits: share * self.hits,
        }
    }
}

/// Variance `var(Re) + var(Im)` of H1 of one output at `lines`, ((m/s²)/N)².
pub fn variance(input: &InputFrf, output: usize, lines: &[usize]) -> Vec<f64> {
    let parts = parts(input, output, lines);
    parts.iter().map(Parts::sum).collect()
}

/// The same in its parts.
pub fn parts(input: &InputFrf, output: usize, lines: &[usize]) -> Vec<Parts> {
    let power = |k: &usize| input.sums.lines[output][*k].h1().norm_sqr();
    let size: Vec<f64> = lines.iter().map(power).collect();
    let level = mean(&size);
    let smooth = if let Some(scatter) = &input.scatter {
        let scatter: Vec<f64> = lines.iter().map(|k| scatter[output][*k]).collect();
        smoothed(&scatter, &size)
    } else if input.hits.len() > 1 {
        let scatter = frf_variance(&input.sums, &input.hits, output, Estimator::H1, lines);
        smoothed(&scatter, &size)
    } else {
        let noise = |k: &usize| input.noise_power[output] / input.sums.lines[output][*k].ff;
        let near = |i: usize| SINGLE.powi(2) * mean(&size[around(i, size.len())]);
        let all = lines.iter().enumerate();
        all.map(|(i, k)| Parts {
            response: noise(k),
            hits: near(i),
        })
        .collect()
    };
    let floor = |s: &f64| FLOOR.powi(2) * (s + level) + f64::MIN_POSITIVE;
    let each = smooth.iter().zip(&size);
    each.map(|(v, s)| Parts {
        response: v.response,
        hits: v.hits + floor(s),
    })
    .collect()
}

/// The scatter as noise of the response, alike on neighbouring lines, and noise of the force, which
/// follows the power of the FRF: `a + b·|H|²` with `a` and `b` not negative, fitted around every line;
/// a line that scatters much more, such as one of hum, keeps its own.
fn smoothed(scatter: &[f64], size: &[f64]) -> Vec<Parts> {
    let mut model = vec![1.0; scatter.len()];
    let mut parts = Vec::new();
    for _ in 0..PASSES {
        let at = |i: usize| {
            let [response, b] = share(scatter, size, &model, around(i, scatter.len()));
            Parts {
                response,
                hits: b * size[i],
            }
        };
        parts = (0..scatter.len()).map(at).collect();
        model = parts.iter().map(Parts::sum).collect();
    }
    let raised = |(v, m): (&f64, &Parts)| match *v > OUTLYING * m.sum() {
        true => Parts {
            response: *v,
            hits: 0.0,
        },
        false => *m,
    };
    scatter.iter().zip(&parts).map(raised).collect()
}

/// The places around `i` of `count`.
fn around(i: usize, count: usize) -> Range<usize> {
    i.saturating_sub(SMOOTHING)..(i + SMOOTHING + 1).min(count)
}

/// Least squares of `v ≈ a + b·s`, each line in units of its `model`.
fn share(scatter: &[f64], size: &[f64], model: &[f64], range: Range<usize>) -> [f64; 2] {
    let [mut ww, mut ws, mut ss, mut wv, mut sv] = [0.0; 5];
    for i in range {
        let unit = 1.0 / model[i].max(f64::MIN_POSITIVE);
        let (w, s, v) = (unit, size[i] * unit, scatter[i] * unit);
        ww += w * w;
        ws += w * s;
        ss += s * s;
        wv += w * v;
        sv += s * v;
    }
    let both = ww * ss - ws * ws;
    if both.is_nan() || both <= ALIKE * ww * ss {
        return [wv / ww.max(f64::MIN_POSITIVE), 0.0];
    }
    let (a, b) = ((wv * ss - sv * ws) / both, (sv * ww - wv * ws) / both);
    match (a >= 0.0, b >= 0.0) {
        (true, true) => [a, b],
        (false, _) => [0.0, sv / ss.max(f64::MIN_POSITIVE)],
        _ => [wv / ww.max(f64::MIN_POSITIVE), 0.0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_of_the_force_stands_at_the_peak_only() {
        let peak = |k: usize| 1.0 / (0.02 + (k as f64 - 20.0).powi(2));
        let size: Vec<f64> = (0..41).map(peak).collect();
        let response = vec![3.0; 41];
        let force: Vec<f64> = size.iter().map(|s| 0.1 * s).collect();
        let both: Vec<f64> = force.iter().map(|f| f + 3.0).collect();
        for truth in [response, force, both] {
            for (found, truth) in smoothed(&truth, &size).iter().zip(&truth) {
                let found = found.sum();
                assert!((found / truth - 1.0).abs() < 1e-6, "{found} {truth}");
            }
        }
    }

    #[test]
    fn nothing_is_never_negative() {
        let found = smoothed(&[0.0, 1.0, 0.0], &[5.0, 0.0, 1.0]);
        assert!(
            found
                .iter()
                .all(|v| v.sum().is_finite() && v.response >= 0.0 && v.hits >= 0.0)
        );
        assert!(smoothed(&[], &[]).is_empty());
        assert_eq!(smoothed(&[2.0], &[3.0])[0].sum(), 2.0);
    }
}
