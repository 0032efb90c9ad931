//! `[limits]`: how the tool may move along its path, and what the part allows.

use crate::ground::problem::Outcome;
use crate::measurement::keys::Keys;

/// Limits of the motion along the path, and of the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest acceleration along the path, m/s²; 1 if not stated.
    pub path_acceleration: f64,
    /// Largest jerk along the path, m/s³; 20 if not stated.
    pub path_jerk: f64,
    /// Largest deviation that the part allows, m.
    pub tolerance: Option<f64>,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            path_acceleration: 1.0,
            path_jerk: 20.0,
            tolerance: None,
        }
    }
}

const KEYS: &[&str] = &["path_acceleration_m_s2", "path_jerk_m_s3", "tolerance_mm"];

impl Limits {
    pub(super) fn of(job: &Keys<'_>) -> Outcome<Self> {
        let Some(keys) = job.table("limits", KEYS)? else {
            return Ok(Self::default());
        };
        let left_out = Self::default();
        let acceleration = keys.positive("path_acceleration_m_s2")?;
        let jerk = keys.positive("path_jerk_m_s3")?;
        Ok(Self {
            path_acceleration: acceleration.unwrap_or(left_out.path_acceleration),
            path_jerk: jerk.unwrap_or(left_out.path_jerk),
            tolerance: keys.positive("tolerance_mm")?.map(|mm| mm * 1e-3),
        })
    }
}
