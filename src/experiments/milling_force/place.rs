//! Where an angle lies in a revolution that is known at even samples.

use crate::ground::spatial::V3;
use std::f64::consts::TAU;

/// The samples about it and their weights.
pub(super) struct Place {
    around: [usize; 4],
    weight: [f64; 4],
}

impl Place {
    pub(super) fn of(angle: f64, grid: usize) -> Self {
        let at = angle.rem_euclid(TAU) / TAU * grid as f64;
        let (first, u) = (at.floor() as usize, at.fract());
        Self {
            around: [grid - 1, 0, 1, 2].map(|k| (first + k) % grid),
            // Catmull and Rom 1974
            weight: [
                0.5 * u * (-1.0 + u * (2.0 - u)),
                0.5 * (2.0 + u * u * (3.0 * u - 5.0)),
                0.5 * u * (1.0 + u * (4.0 - 3.0 * u)),
                0.5 * u * u * (u - 1.0),
            ],
        }
    }

    pub(super) fn read(&self, wave: &[V3]) -> V3 {
        let part = |k: usize, i: usize| self.weight[k] * wave[self.around[k]][i];
        std::array::from_fn(|i| (0..4).map(|k| part(k, i)).sum())
    }
}
