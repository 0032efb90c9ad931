//! Rival solutions: springs in series about nearly one axis leave two solutions for their dampings.

use super::frf_model::Kind;
use super::frf_tuning::{Parameter, Tuning};
use nalgebra::DMatrix;

/// Correlation of two dampings from which on they may be exchanged.
const EXCHANGED: f64 = -0.3;

/// Logarithms at which to look for rivals of `theta`, one for every pair of dampings that the data
/// hardly tell apart.
///
/// Springs in series about one axis have the compliance `Σ1/(K + sD)`. With `c = 1/K` and `τ = D/K` its
/// first two orders in s fix `Σcτ` and `Σcτ²`: two springs reflected about their mean `Σcτ/Σc` have the
/// same.
pub(super) fn rivals(task: &Tuning, theta: &[f64], covariance: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let springs: Vec<(usize, f64)> = (0..theta.len())
        .filter_map(|i| Some((i, stiffness(task, theta, i)?)))
        .collect();
    let pairs = springs
        .iter()
        .enumerate()
        .flat_map(|(k, one)| springs[k + 1..].iter().map(move |other| (*one, *other)));
    pairs
        .filter(|((i, _), (j, _))| correlation(covariance, *i, *j) < EXCHANGED)
        .map(|(one, other)| exchanged(task, theta, one, other))
        .collect()
}

/// The stiffness of the spring whose damping parameter `i` is.
fn stiffness(task: &Tuning, theta: &[f64], i: usize) -> Option<f64> {
    let damping = &task.parameters[i];
    let own = |p: &Parameter| p.kind == Kind::Stiffness && p.site == damping.site;
    let at = task.parameters.iter().position(own)?;
    (damping.kind == Kind::Damping).then(|| theta[at].exp())
}

fn correlation(covariance: &DMatrix<f64>, i: usize, j: usize) -> f64 {
    covariance[(i, j)] / (covariance[(i, i)] * covariance[(j, j)]).sqrt()
}

fn exchanged(
    task: &Tuning,
    theta: &[f64],
    (i, one): (usize, f64),
    (j, other): (usize, f64),
) -> Vec<f64> {
    let times = [theta[i].exp() / one, theta[j].exp() / other];
    let mean = (times[0] / one + times[1] / other) / (1.0 / one + 1.0 / other);
    let mut rival = theta.to_vec();
    for (p, stiffness, time) in [(i, one, times[0]), (j, other, times[1])] {
        let [low, high] = task.parameters[p].bounds;
        rival[p] = ((2.0 * mean - time) * stiffness).clamp(low, high).ln();
    }
    rival
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::frf_tuning::Residuals;

    fn parameter(site: &str, kind: Kind, start: f64) -> Parameter {
        Parameter {
            site: site.into(),
            kind,
            start,
            bounds: [1e-3, 1e9],
            prior_ln_std: None,
            nuisance: false,
        }
    }

    #[test]
    fn a_rival_keeps_the_first_two_orders() {
        let (stiffness, damping) = ([2e6, 5e6], [3e3, 9e3]);
        let mut parameters = vec![
            parameter("A4", Kind::Damping, damping[0]),
            parameter("A6", Kind::Damping, damping[1]),
            parameter("A4", Kind::Stiffness, stiffness[0]),
            parameter("A6", Kind::Stiffness, stiffness[1]),
        ];
        let theta: Vec<f64> = parameters.iter().map(|p| p.start.ln()).collect();
        parameters.iter_mut().for_each(|p| p.start = 1.0);
        let task = Tuning {
            parameters,
            poses: Vec::new(),
            residuals: Residuals::None,
            starts: 1,
        };
        let mut covariance = DMatrix::identity(4, 4);
        assert!(rivals(&task, &theta, &covariance).is_empty());
        (covariance[(0, 1)], covariance[(1, 0)]) = (-0.8, -0.8);
        let found = rivals(&task, &theta, &covariance);
        assert_eq!(found.len(), 1);
        let rival = [found[0][0].exp(), found[0][1].exp()];
        assert!((rival[0] / damping[0] - 1.0).abs() > 0.01);
        for order in 1..=2 {
            let of = |d: [f64; 2]| -> f64 {
                let part = |i: usize| d[i].powi(order) / stiffness[i].powi(order + 1);
                part(0) + part(1)
            };
            assert!((of(rival) / of(damping) - 1.0).abs() < 1e-12);
        }
    }
}
