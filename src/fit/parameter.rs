//! A parameter as it is reported: value, interval, and whether the data support it at all.

use serde::{Deserialize, Serialize};

/// What the data say about a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// The data fix it.
    Identified,
    /// The best value lies on a bound.
    AtBound,
    /// The data do not fix it.
    NotIdentifiable,
}

/// One identified parameter. Value and interval are `None` unless the data fix it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Identified {
    /// Its name.
    pub name: String,
    /// Where in the robot.
    pub site: String,
    /// Value, in `unit`.
    pub value: Option<f64>,
    /// Unit, as printed.
    pub unit: String,
    /// Standard error.
    pub stderr: Option<f64>,
    /// 95 % interval.
    pub ci95: Option<[f64; 2]>,
    /// Whether the data support it.
    pub status: Status,
    /// What it means, one sentence.
    pub meaning: String,
    /// For a parameter at its bound, or whose interval reaches zero: the largest magnitude that the
    /// data allow (95 %).
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub limit95: Option<f64>,
    /// What the standard error is made of, where the readings are not all of it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub parts: Option<Parts>,
}

/// The parts of a standard error, in the parameter's unit; their squares add up.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Parts {
    /// By the scatter of the readings.
    pub readings: f64,
    /// By the stated uncertainty of the levers, which no repetition takes away.
    pub levers: f64,
}

pub use crate::ground::stats::Z95;

impl Identified {
    /// A parameter the data fix, with its standard error.
    pub fn new(name: &str, site: &str, value: f64, unit: &str, stderr: f64, meaning: &str) -> Self {
        Self {
            name: name.into(),
            site: site.into(),
            value: Some(value),
            unit: unit.into(),
            stderr: Some(stderr),
            ci95: Some([value - Z95 * stderr, value + Z95 * stderr]),
            status: Status::Identified,
            meaning: meaning.into(),
            limit95: None,
            parts: None,
        }
    }

    /// The same parameter, said to be at its bound or unsupported: no number is printed.
    #[must_use]
    pub fn without_value(mut self, status: Status) -> Self {
        if status == Status::AtBound {
            self.limit95 = self.ci95.map(|ci| ci[0].abs().max(ci[1].abs()));
        }
        (self.value, self.stderr, self.ci95, self.status) = (None, None, None, status);
        self.parts = None;
        self
    }

    /// A parameter that may be absent: no number is printed, only how large it may be at most.
    #[must_use]
    pub fn limited(mut self, status: Status, limit: f64) -> Self {
        self.limit95 = (limit.is_finite() && limit > 0.0).then_some(limit);
        (self.value, self.stderr, self.ci95, self.status) = (None, None, None, status);
        self.parts = None;
        self
    }

    /// The same parameter with an independent relative standard deviation of the levers added.
    #[must_use]
    pub fn with_levers(mut self, relative: f64) -> Self {
        if let (Some(value), Some(readings), Some([low, high])) =
            (self.value, self.stderr, self.ci95)
        {
            let levers = relative * value.abs();
            let half = |own: f64| own.hypot(Z95 * levers);
            self.stderr = Some(readings.hypot(levers));
            self.ci95 = Some([value - half(value - low), value + half(high - value)]);
            self.parts = Some(Parts { readings, levers });
        }
        self
    }

    /// Whether the 95 % interval reaches down to zero or beyond.
    pub fn may_be_zero(&self) -> bool {
        self.ci95.is_some_and(|[low, _]| low <= 0.0)
    }
}
