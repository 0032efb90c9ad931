//! What naming a cause gains on data that were not fitted.

use crate::fit::parameter::Z95;
use serde::Serialize;

/// Rms error on held-out data before and after, with the interval of its reduction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Gain {
    /// Rms error on held-out data without the cause.
    #[serde(rename = "held_out_rms_before")]
    pub before: f64,
    /// With it.
    #[serde(rename = "held_out_rms_after")]
    pub after: f64,
    /// 1 − after/before in percent.
    pub reduction_percent: f64,
    /// Its 95 % interval.
    pub ci95_percent: [f64; 2],
}

impl Gain {
    /// Probability that there is a gain at all, from the interval of ln(before/after).
    pub fn probability(&self) -> f64 {
        let z = nats(self.reduction_percent) / self.ln_std().max(f64::MIN_POSITIVE);
        0.5 * statrs::function::erf::erfc(-z / std::f64::consts::SQRT_2)
    }

    /// Standard error of ln(before/after), from the interval.
    pub fn ln_std(&self) -> f64 {
        let [low, high] = self.ci95_percent.map(nats);
        (high - low) / (2.0 * Z95)
    }

    /// The same gain with room for a better law: the law that was fitted misses nature by some percent of
    /// its own size, and the cause itself may gain as much as the noise (rms) leaves to be gained.
    #[must_use]
    pub fn reachable(mut self, noise: f64) -> Self {
        if noise < self.after {
            let best = 100.0 * (1.0 - noise / self.before);
            let room = self.ci95_percent[1] - self.reduction_percent;
            self.ci95_percent[1] = self.ci95_percent[1].max((best + room).min(100.0));
        }
        self
    }

    /// Mean square of held-out readings that it explains.
    pub fn explained(&self) -> f64 {
        self.before * self.before - self.after * self.after
    }

    /// Whether the interval excludes no gain at all.
    pub fn is_real(&self) -> bool {
        self.ci95_percent[0] > 0.0
    }

    /// From rms errors on unseen data and the standard error of ln(before/after).
    pub fn of(before: f64, after: f64, ln_std: f64) -> Self {
        let middle = (before / after).ln();
        let half = Z95 * ln_std;
        let percent = |g: f64| 100.0 * (1.0 - (-g).exp());
        Self {
            before,
            after,
            reduction_percent: percent(middle),
            ci95_percent: [percent(middle - half), percent(middle + half)],
        }
    }
}

/// ln(before/after) of a reduction in percent.
fn nats(percent: f64) -> f64 {
    -(1.0 - percent.min(100.0 - 1e-9) / 100.0).ln()
}
