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
}

/// 97.5 % point of the normal distribution.
pub const Z95: f64 = 1.959_963_984_540_054;

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
        }
    }

    /// The same parameter, said to be at its bound or unsupported: no number is printed.
    #[must_use]
    pub fn without_value(mut self, status: Status) -> Self {
        if status == Status::AtBound {
            self.limit95 = self.ci95.map(|ci| ci[0].abs().max(ci[1].abs()));
        }
        (self.value, self.stderr, self.ci95, self.status) = (None, None, None, status);
        self
    }

    /// A parameter that may be absent: no number is printed, only how large it may be at most.
    #[must_use]
    pub fn limited(mut self, status: Status, limit: f64) -> Self {
        self.limit95 = (limit.is_finite() && limit > 0.0).then_some(limit);
        (self.value, self.stderr, self.ci95, self.status) = (None, None, None, status);
        self
    }

    /// Whether the 95 % interval reaches down to zero or beyond.
    pub fn may_be_zero(&self) -> bool {
        self.ci95.is_some_and(|[low, _]| low <= 0.0)
    }
}
