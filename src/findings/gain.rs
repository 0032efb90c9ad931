//! What naming a cause gains on data that were not fitted.

use crate::fit::parameter::Z95;
use crate::ground::stats::{above, quantile};
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
        above(-z)
    }

    /// Standard error of ln(before/after), from the interval.
    pub fn ln_std(&self) -> f64 {
        let [low, high] = self.ci95_percent.map(nats);
        (high - low) / (2.0 * Z95)
    }

    /// The same with an interval from draws of ln(before/after); it holds the gain itself.
    #[must_use]
    pub fn drawn(mut self, mut nats: Vec<f64>) -> Self {
        nats.retain(|g| g.is_finite());
        if !nats.is_empty() {
            let end = |q: f64| percent(quantile(&nats, q));
            self.ci95_percent = [
                end(0.025).min(self.reduction_percent),
                end(0.975).max(self.reduction_percent),
            ];
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
        Self {
            before,
            after,
            reduction_percent: percent(middle),
            ci95_percent: [percent(middle - half), percent(middle + half)],
        }
    }
}

/// Reduction in percent of ln(before/after).
fn percent(nats: f64) -> f64 {
    100.0 * (1.0 - (-nats).exp())
}

/// ln(before/after) of a reduction in percent.
fn nats(percent: f64) -> f64 {
    -(1.0 - percent.min(100.0 - 1e-9) / 100.0).ln()
}
