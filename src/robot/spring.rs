//! An elastic joint: spring, damper and lost motion between what is commanded and what moves.

use super::joint_effect::JointEffect;
use crate::effects::contract::Contact;
use crate::ground::stats::Z95;

/// A torsional spring-damper with the numbers' origin.
///
/// Torque on the link side, with δ the commanded minus the actual angle (source 000, eq. 2.2, and
/// 004 for the gap): τ = k·dead(δ, s/2) + d·δ̇, where dead(δ, h) is δ less at most h towards zero.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spring {
    /// k, N·m/rad.
    pub stiffness: f64,
    /// d, N·m·s/rad.
    pub damping: f64,
    /// Gaps s in series, rad, each the whole play from stop to stop. Lost motions add.
    pub backlash: Vec<f64>,
    /// What else it does, with a memory: hysteresis, friction. Acts in time simulation only.
    pub effects: Vec<JointEffect>,
    /// Who published or identified these numbers.
    pub source: Option<String>,
    /// 95 % intervals, where they are known.
    pub ci95: Intervals,
    /// How well the stiffness is known, standard deviation over its value, where it is only stated.
    pub stiffness_rel_std: Option<f64>,
}

/// 95 % confidence intervals of the numbers of a [`Spring`], in the same units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Intervals {
    /// Of the stiffness, N·m/rad.
    pub stiffness: Option<[f64; 2]>,
    /// Of the damping, N·m·s/rad.
    pub damping: Option<[f64; 2]>,
    /// Of the whole gap, rad.
    pub backlash: Option<[f64; 2]>,
}

impl Spring {
    /// A plain linear spring-damper: N·m/rad and N·m·s/rad.
    pub fn new(stiffness: f64, damping: f64) -> Self {
        Self {
            stiffness,
            damping,
            ..Self::default()
        }
    }

    /// The whole gap from stop to stop, rad.
    pub fn gap(&self) -> f64 {
        self.backlash.iter().fold(0.0, |sum, gap| sum + gap)
    }

    /// Relative standard deviation of the stiffness: by its interval, else as stated; none where nothing is
    /// known.
    pub fn relative_std(&self) -> Option<f64> {
        let of_interval = |[low, high]: [f64; 2]| (high - low) / (2.0 * Z95 * self.stiffness);
        let interval = self.ci95.stiffness.map(of_interval);
        interval.or(self.stiffness_rel_std)
    }

    /// The dry contacts of all its effects.
    pub fn contacts(&self) -> Vec<Contact> {
        self.effects
            .iter()
            .flat_map(JointEffect::contacts)
            .collect()
    }

    /// Why no passive spring has these numbers, if so.
    pub fn fault(&self) -> Option<String> {
        let refuse = |name: &str, value: f64, rule: &str| {
            Some(format!("has {name} = {value}, which must be {rule}"))
        };
        if !(self.stiffness > 0.0 && self.stiffness.is_finite()) {
            return refuse("stiffness_Nm_rad", self.stiffness, "positive and finite");
        }
        if !(self.damping >= 0.0 && self.damping.is_finite()) {
            return refuse("damping_Nms_rad", self.damping, "zero or positive");
        }
        if let Some(spread) = self.stiffness_rel_std.filter(|s| !(*s > 0.0 && *s < 10.0)) {
            return refuse("stiffness_rel_std", spread, "above zero, as 0.1 for 10 %");
        }
        let bad = self
            .backlash
            .iter()
            .find(|gap| !(**gap >= 0.0 && gap.is_finite()));
        bad.and_then(|gap| refuse("backlash_rad", *gap, "zero or positive"))
    }
}
