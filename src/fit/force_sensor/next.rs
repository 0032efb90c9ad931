//! Which orientations to measure next: greedily those that lower the uncertainty of the physical model most.

use super::fitted::{Fitted, System};
use super::poses::Pose;
use super::statics::{N, sizes, slopes};
use crate::measurement::force_sensor::quaternion;
use nalgebra::{DMatrix, DVector};

/// An orientation worth measuring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proposal {
    /// A, B, C of the sensor, degrees: R = Rz(a) Ry(b) Rx(c).
    pub abc_deg: [f64; 3],
    /// Unit quaternion w, x, y, z.
    pub quaternion: [f64; 4],
    /// Information it brings, bits.
    pub bits: f64,
}

/// How many are proposed.
const COUNT: usize = 5;
/// Step of the candidates, degrees.
const STEP: f64 = 45.0;

/// The best next orientations, each after the ones before it.
pub fn proposals(fitted: &Fitted, poses: &[Pose]) -> Vec<Proposal> {
    let mut prior = fitted.prior;
    let natural = sizes(fitted.p[0]);
    for j in 0..N {
        // what is to be learned: nothing is known beyond natural sizes, angles as mounted
        prior[j] = prior[j].min(natural[j]);
    }
    let mut covariance = System::new(poses, &prior, fitted.noise, &fitted.p).covariance();
    let candidates = candidates();
    let mut found = Vec::new();
    for _ in 0..COUNT {
        let gains = candidates
            .iter()
            .map(|c| (gain(fitted, &covariance, c.quaternion), c));
        // the first of equal ones: tiny differences of rounding must not choose
        let best = gains.reduce(|best, next| if next.0 > best.0 + 1e-6 { next } else { best });
        let Some((bits, candidate)) = best else { break };
        covariance = learned(fitted, &covariance, candidate.quaternion);
        found.push(Proposal { bits, ..*candidate });
    }
    found
}

fn candidates() -> Vec<Proposal> {
    let angles = |n: i32, from: f64| (0..n).map(move |i| from + STEP * f64::from(i));
    let mut all = Vec::new();
    for b in angles(5, -90.0) {
        for c in angles(8, -135.0) {
            for a in angles(8, -135.0) {
                let rad = std::f64::consts::PI / 180.0;
                all.push(Proposal {
                    abc_deg: [a, b, c],
                    quaternion: quaternion(a * rad, b * rad, c * rad),
                    bits: 0.0,
                });
            }
        }
    }
    all
}

fn whitened(fitted: &Fitted, q: [f64; 4]) -> DMatrix<f64> {
    let slopes = slopes(&fitted.p, q);
    DMatrix::from_fn(6, N, |c, j| slopes[c][j] / fitted.noise[c / 3])
}

/// Half of ln det(1 + J C Jᵀ), in bits.
fn gain(fitted: &Fitted, covariance: &DMatrix<f64>, q: [f64; 4]) -> f64 {
    let j = whitened(fitted, q);
    let seen = &j * covariance * j.transpose() + DMatrix::identity(6, 6);
    let diagonal = seen.cholesky().map(|c| c.l().diagonal());
    diagonal.map_or(0.0, |d: DVector<f64>| d.iter().map(|x| x.log2()).sum())
}

fn learned(fitted: &Fitted, covariance: &DMatrix<f64>, q: [f64; 4]) -> DMatrix<f64> {
    let j = whitened(fitted, q);
    let gain = covariance * j.transpose();
    let seen = &j * &gain + DMatrix::identity(6, 6);
    match seen.cholesky() {
        Some(factor) => covariance - &gain * factor.solve(&gain.transpose()),
        None => covariance.clone(),
    }
}
