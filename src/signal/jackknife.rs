//! Jackknife over hits: what the scatter of the hits says about anything computed from all of them.

use super::frf::{CrossSpectra, Estimator, HitSpectra};
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Jackknife variance `(n−1)/n · Σ|θ₋ₖ − mean|²` of values computed with each of n hits left out
/// (Efron and Tibshirani 1993, eq. 11.5). Not a number below two values.
pub fn variance(left_out: &[f64]) -> f64 {
    let n = left_out.len() as f64;
    if n < 2.0 {
        return f64::NAN;
    }
    let mean = left_out.iter().sum::<f64>() / n;
    let spread: f64 = left_out.iter().map(|v| (v - mean).powi(2)).sum();
    (n - 1.0) / n * spread
}

/// Jackknife covariance `(n−1)/n·Σ(v − mean)(v − mean)ᵀ` of vectors computed with each of n hits left
/// out; those of several strata add up (Shao and Tu 1995).
pub fn covariance(left_out: &[DVector<f64>]) -> DMatrix<f64> {
    let n = left_out.first().map_or(0, DVector::len);
    let count = left_out.len() as f64;
    let mean = left_out.iter().fold(DVector::zeros(n), |sum, v| sum + v) / count;
    let mut sum = DMatrix::zeros(n, n);
    for vector in left_out {
        let off = vector - &mean;
        sum.ger((count - 1.0) / count, &off, &off, 1.0);
    }
    sum
}

/// Half width of the 95 % interval of Student's t with `freedom` degrees, in standard errors.
pub fn t95(freedom: f64) -> f64 {
    if freedom < 1.0 {
        return f64::INFINITY;
    }
    StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |t| t.inverse_cdf(0.975))
}

/// The FRF of one output at `lines` with each of the hits left out in turn.
pub fn left_out(
    sums: &CrossSpectra,
    hits: &[HitSpectra],
    output: usize,
    estimator: Estimator,
    lines: &[usize],
) -> Vec<Vec<Complex64>> {
    let without = |hit: &HitSpectra| {
        let one = |k: &usize| {
            let line = sums.lines[output][*k].without(hit.force[*k], hit.responses[output][*k]);
            line.estimate(estimator)
        };
        lines.iter().map(one).collect()
    };
    hits.iter().map(without).collect()
}

/// Jackknife variance of the complex FRF of one output at `lines`, `var(Re) + var(Im)`, in the square
/// of the FRF's unit. Not a number below two hits.
pub fn frf_variance(
    sums: &CrossSpectra,
    hits: &[HitSpectra],
    output: usize,
    estimator: Estimator,
    lines: &[usize],
) -> Vec<f64> {
    let left_out = left_out(sums, hits, output, estimator, lines);
    let at = |i: usize| -> Vec<Complex64> { left_out.iter().map(|frf| frf[i]).collect() };
    (0..lines.len()).map(|i| complex_variance(&at(i))).collect()
}

fn complex_variance(left_out: &[Complex64]) -> f64 {
    let re: Vec<f64> = left_out.iter().map(|h| h.re).collect();
    let im: Vec<f64> = left_out.iter().map(|h| h.im).collect();
    variance(&re) + variance(&im)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_mean_is_the_standard_error_squared() {
        let x = [1.0, 2.0, 4.0, 9.0];
        let sum: f64 = x.iter().sum();
        let left_out: Vec<f64> = x.iter().map(|v| (sum - v) / 3.0).collect();
        let mean = sum / 4.0;
        let s2 = x.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 3.0;
        assert!((variance(&left_out) - s2 / 4.0).abs() < 1e-12);
    }

    #[test]
    fn students_t() {
        assert!((t95(4.0) - 2.776).abs() < 1e-3);
    }
}
