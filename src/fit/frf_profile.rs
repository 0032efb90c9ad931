//! Profile likelihood: how far a constant may go with all others following before the data object.
//! Springs in series about nearly one axis have dampings that the data fix only to second order; there
//! the curvature at the best fit does not tell how wide the interval is.

use super::frf_identifiability::Place;
use super::frf_linear::Frozen;
use super::frf_search::{SHARE, descend_by};
use crate::inference::descent::Stop;
use nalgebra::DMatrix;

/// Relative half width from which on the curvature is not trusted alone.
const DOUBTED: f64 = 0.08;
/// Trials per side.
const TRIALS: usize = 5;
/// Share of the wanted distance within which a trial is near enough.
const NEAR: f64 = 0.15;
/// Smallest and largest step outwards, times the last.
const FURTHER: [f64; 2] = [1.2, 2.0];
/// Steps of the search at every trial.
const STEPS: usize = 8;
/// Gain at which that search ends, in squared deviations.
const GAIN: f64 = 0.02;

/// Half widths below and above of the interval of constant `p`, relative to its value: `half` by
/// curvature, and further where the cost rises less than the curvature says. None on a side that has no
/// end within the bounds. `inverse`: of the normal matrix.
pub(super) fn widened(
    best: Place,
    (inverse, frozen): (&DMatrix<f64>, &Frozen),
    p: usize,
    half: f64,
) -> [Option<f64>; 2] {
    let profile = Profile {
        best,
        inverse,
        frozen,
        p,
    };
    [-1.0, 1.0].map(|side| match half < DOUBTED {
        true => Some(half),
        false => profile.side(side, half),
    })
}

/// The profile of one constant.
struct Profile<'a> {
    best: Place<'a>,
    inverse: &'a DMatrix<f64>,
    frozen: &'a Frozen,
    p: usize,
}

impl Profile<'_> {
    fn side(&self, side: f64, half: f64) -> Option<f64> {
        let (p, theta) = (self.p, self.best.theta);
        let wanted = half / self.inverse[(p, p)].sqrt();
        let bounds = self.best.task.parameters[p].bounds;
        let [low, high] = bounds.map(|b| b / theta[p].exp());
        let room = if side < 0.0 { 1.0 - low } else { high - 1.0 };
        let (mut at, mut inside) = (half, (0.0, 0.0));
        let mut start = theta.to_vec();
        for trial in 0..TRIALS {
            if at >= room {
                return None;
            }
            let (reached, rise) = self.rise(1.0 + side * at, &start)?;
            if rise >= (1.0 - NEAR) * wanted {
                return Some(if trial == 0 {
                    half
                } else {
                    between(inside, (at, rise), wanted)
                });
            }
            (inside, start) = ((at, rise), reached);
            at *= (wanted / rise.max(1e-3)).clamp(FURTHER[0], FURTHER[1]);
        }
        None
    }

    /// The best fit with the constant at `share` of its fitted value, and the root of what it costs.
    fn rise(&self, share: f64, start: &[f64]) -> Option<(Vec<f64>, f64)> {
        let p = self.p;
        let mut held = self.best.task.clone();
        let value = self.best.theta[p].exp() * share;
        held.parameters[p].bounds = [value; 2];
        let by = value.ln() - start[p];
        let follow = |i: usize| {
            let bounds = held.parameters[i].ends();
            let slope = self.inverse[(i, p)] / self.inverse[(p, p)];
            (start[i] + slope * by).clamp(bounds[0], bounds[1])
        };
        let guess = (0..start.len()).map(follow).collect();
        let stop = Stop {
            steps: STEPS,
            gain: GAIN,
            share: SHARE,
            promise: 0.0,
        };
        let near = |theta: &[f64]| self.frozen.linearise(&held, theta);
        let (reached, cost) = descend_by(&held, guess, stop, near)?;
        Some((reached, (cost - self.best.at.cost).max(0.0).sqrt()))
    }
}

/// Where a line from `inside` to `outside` rises to `wanted`.
fn between(inside: (f64, f64), outside: (f64, f64), wanted: f64) -> f64 {
    let share = (wanted - inside.1) / (outside.1 - inside.1).max(1e-9);
    inside.0 + share.clamp(0.0, 1.5) * (outside.0 - inside.0)
}
