//! The noise of the three channels, from what a fit leaves.

use super::CutData;
use crate::ground::spatial::V3;
use crate::signal::autoregression::Autoregression;

/// Most past samples that the colour of the noise spans.
const MOST_ORDER: usize = 12;

/// The noise of each channel.
#[derive(Debug, Clone)]
pub struct Whitening(pub [Autoregression; 3]);

impl Whitening {
    /// White noise of this standard deviation, N.
    pub fn white(deviation: f64) -> Self {
        Self(std::array::from_fn(|_| Autoregression::white(deviation)))
    }

    /// From the residuals of all cuts.
    pub fn of(cuts: &[CutData], residuals: &[Vec<V3>]) -> Self {
        let most = if cuts.iter().all(|cut| cut.scene.step_s().is_some()) {
            MOST_ORDER
        } else {
            0
        };
        Self(std::array::from_fn(|k| {
            let pieces = residuals.iter().map(|r| r.iter().map(|v| v[k]).collect());
            let pieces: Vec<Vec<f64>> = pieces.collect();
            Autoregression::fit(&pieces, most)
        }))
    }

    /// One channel after the other, whitened and put behind each other.
    pub fn apply(&self, wave: &[V3]) -> Vec<f64> {
        let of = |(k, noise): (usize, &Autoregression)| {
            let mut channel: Vec<f64> = wave.iter().map(|v| v[k]).collect();
            noise.whiten(&mut channel);
            channel
        };
        self.0.iter().enumerate().flat_map(of).collect()
    }
}
