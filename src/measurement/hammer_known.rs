//! What a hammer test states of how well its robot and its instruments are known.

use super::front::Front;
use crate::ground::problem::Outcome;

/// How well bodies, dampings and gains are known, one standard deviation each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// Of every mass of the robot file, relative.
    pub mass_rel_std: f64,
    /// Of every coordinate of its centres of mass, m.
    pub com_std_m: f64,
    /// Of its inertias about the centres, relative.
    pub inertia_rel_std: f64,
    /// Of its dampings, relative; none: nothing is said of them.
    pub damping_rel_std: Option<f64>,
    /// Of the calibration of the hammer, and of each axis of the sensor, relative.
    pub gain_rel_std: f64,
}

impl Default for Known {
    /// What holds where a file states nothing: bodies as a maker of robots draws them, a calibration of
    /// the year before.
    fn default() -> Self {
        Self {
            mass_rel_std: 0.02,
            com_std_m: 0.005,
            inertia_rel_std: 0.05,
            damping_rel_std: None,
            gain_rel_std: 0.01,
        }
    }
}

impl Known {
    /// Reads the facts; those that are not stated keep their default.
    ///
    /// # Errors
    /// A fact that is no number, negative, or 100 % and more.
    pub fn read(front: &Front) -> Outcome<Self> {
        let default = Self::default();
        let share = |key: &str| front.fraction(key);
        Ok(Self {
            mass_rel_std: share("mass_rel_std")?.unwrap_or(default.mass_rel_std),
            com_std_m: front
                .not_negative("com_std_m")?
                .unwrap_or(default.com_std_m),
            inertia_rel_std: share("inertia_rel_std")?.unwrap_or(default.inertia_rel_std),
            damping_rel_std: front.positive("damping_rel_std")?,
            gain_rel_std: share("gain_rel_std")?.unwrap_or(default.gain_rel_std),
        })
    }

    /// Whether the bodies are stated to be as the robot file has them.
    pub fn is_exact(&self) -> bool {
        self.mass_rel_std == 0.0 && self.com_std_m == 0.0 && self.inertia_rel_std == 0.0
    }

    /// The less certain of two statements.
    #[must_use]
    pub fn or_worse(self, other: Self) -> Self {
        let damping = self.damping_rel_std.zip(other.damping_rel_std);
        Self {
            mass_rel_std: self.mass_rel_std.max(other.mass_rel_std),
            com_std_m: self.com_std_m.max(other.com_std_m),
            inertia_rel_std: self.inertia_rel_std.max(other.inertia_rel_std),
            damping_rel_std: damping.map(|(a, b)| a.max(b)),
            gain_rel_std: self.gain_rel_std.max(other.gain_rel_std),
        }
    }
}
