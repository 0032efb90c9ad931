//! Intervals of the modes: by jackknife over hits to first order, never less than the rest of the
//! fit says.

use super::jackknife::{covariance, t95};
use super::modal_fit::{Fit, Normal, Task};
use super::modal_model::damping;
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// FRFs with one hit left out: `[input][output][hit][line]`; empty where the hits are not known.
pub type LeftOut = Vec<Vec<Vec<Vec<Complex64>>>>;

/// Half widths of the 95 % intervals of frequency (Hz) and damping ratio of every mode; not a number
/// where a direction has fewer than two hits. Where no hits are known, the rest of the fit speaks alone.
///
/// Leaving out a hit moves the parameters by one step of Gauss and Newton, `(JᵀJ)⁻¹·Jᵀ·Δ`; the
/// variance adds up over directions (jackknife of strata, Shao and Tu 1995). Fisher's information with
/// the variance of the rest sees what no hit differs in.
pub fn half_widths(task: &Task, fit: &Fit, left_out: &LeftOut) -> Vec<[f64; 2]> {
    let modes = fit.structure.modes();
    let normal = task.normal(&fit.structure, &task.rest(&fit.structure));
    let hits = |outputs: &Vec<Vec<Vec<Complex64>>>| outputs.first().map_or(0, Vec::len);
    let enough = left_out.iter().all(|outputs| hits(outputs) > 1);
    let Some(inverse) = normal.inverse().filter(|_| enough) else {
        return vec![[f64::NAN; 2]; modes];
    };
    let values = (task.values() - normal.matrix.nrows() as f64).max(1.0);
    let freedom = match left_out.is_empty() {
        true => values / task.correlated(),
        false => left_out
            .iter()
            .map(|outputs| hits(outputs) - 1)
            .sum::<usize>() as f64,
    };
    let jackknife = jackknife(task, fit, &inverse, left_out);
    let fisher = inverse * (fit.cost / values * task.correlated());
    let width = |r: usize| {
        let at = r * fit.structure.per_mode();
        gradients(fit.structure.poles[r]).map(|gradient| {
            let [a, b] = [&jackknife, &fisher].map(|matrix| spread(matrix, at, gradient));
            a.max(b).sqrt() * t95(freedom)
        })
    };
    (0..modes).map(width).collect()
}

/// Covariance of the parameters from the hits left out.
fn jackknife(task: &Task, fit: &Fit, inverse: &DMatrix<f64>, left_out: &LeftOut) -> DMatrix<f64> {
    let n = inverse.nrows();
    let mut of_slopes = DMatrix::zeros(n, n);
    for (input, outputs) in left_out.iter().enumerate() {
        of_slopes += covariance(&slopes(task, fit, input, outputs));
    }
    inverse * of_slopes * inverse
}

/// `Jᵀ·Δ` for every hit of a direction left out.
fn slopes(
    task: &Task,
    fit: &Fit,
    input: usize,
    outputs: &[Vec<Vec<Complex64>>],
) -> Vec<DVector<f64>> {
    let columns = task.columns(&fit.structure.poles);
    let hits = outputs.first().map_or(0, Vec::len);
    let mut slopes = vec![DVector::zeros(fit.structure.parameters()); hits];
    for (output, hits) in outputs.iter().enumerate() {
        let c = input * outputs.len() + output;
        let basis = task.basis(c, &columns, true);
        let rows = fit.structure.rows(c);
        for (hit, slope) in hits.iter().zip(&mut slopes) {
            let moved = task.weighted(c, hit) - &task.target[c];
            Normal::add_slope(slope, &rows, &basis.tr_mul(&moved));
        }
    }
    slopes
}

/// Gradients of frequency in Hz and damping ratio in `ln(−Re p)` and `Im p`.
fn gradients(pole: Complex64) -> [[f64; 2]; 2] {
    let (size, ratio) = (pole.norm(), damping(pole));
    let frequency = [pole.re * pole.re / size, pole.im / size];
    let share = pole.re * pole.re / (size * size);
    [
        frequency.map(|v| v / std::f64::consts::TAU),
        [ratio * (1.0 - share), -ratio * pole.im / (size * size)],
    ]
}

fn spread(covariance: &DMatrix<f64>, at: usize, gradient: [f64; 2]) -> f64 {
    let block = covariance.fixed_view::<2, 2>(at, at);
    let gradient = nalgebra::Vector2::from(gradient);
    gradient.dot(&(block * gradient))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::modal_model::frequency;

    #[test]
    fn gradients_are_differences() {
        let pole = Complex64::new(-3.0, 40.0);
        let moved = |d: [f64; 2]| Complex64::new(pole.re * d[0].exp(), pole.im + d[1]);
        let h = 1e-6;
        let [f, d] = gradients(pole);
        for k in 0..2 {
            let step =
                |sign: f64| moved(std::array::from_fn(|i| if i == k { sign * h } else { 0.0 }));
            let slope = |of: fn(Complex64) -> f64| (of(step(1.0)) - of(step(-1.0))) / (2.0 * h);
            assert!((slope(frequency) - f[k]).abs() < 1e-8 && (slope(damping) - d[k]).abs() < 1e-8);
        }
    }
}
