//! Joints that are no springs: what turns beyond torque over stiffness.

use super::poses::Angles;

#[derive(Clone)]
pub enum Law {
    /// A gap of this width, rad. Held: friction of so many N·m keeps the joint where it was;
    /// free: it is crossed within about as many N·m, the same way back and forth.
    Gap {
        site: String,
        width: f64,
        torque: f64,
        held: bool,
    },
    /// Compliance grows with the square of the torque: by `share` at `scale` N·m.
    Softening {
        site: String,
        share: f64,
        scale: f64,
    },
    /// Compliance is larger by `share` for torques of one sign.
    OneSided { site: String, share: f64 },
    /// Compliance waves with the joint angle, `waves` to a turn.
    Wavy {
        site: String,
        joint: usize,
        share: f64,
        waves: f64,
    },
}

impl Law {
    pub fn site(&self) -> &str {
        match self {
            Self::Gap { site, .. }
            | Self::Softening { site, .. }
            | Self::OneSided { site, .. }
            | Self::Wavy { site, .. } => site,
        }
    }

    /// Angles beyond the spring under `torques` on top of the weight, since the unloaded start.
    pub fn angles(&self, torques: &[f64], weight: f64, soft: f64, pose: &Angles) -> Vec<f64> {
        match self {
            Self::Gap {
                width,
                torque,
                held: false,
                ..
            } => {
                let side = |t: f64| 0.5 * width * (t / torque).tanh();
                torques
                    .iter()
                    .map(|t| side(weight + t) - side(weight))
                    .collect()
            }
            Self::Gap { width, torque, .. } => held_gap(torques, weight, *width, *torque),
            Self::Softening { share, scale, .. } => {
                let law = |t: f64| soft * share * t * (t / scale).powi(2);
                torques
                    .iter()
                    .map(|t| law(weight + t) - law(weight))
                    .collect()
            }
            Self::OneSided { share, .. } => {
                torques.iter().map(|t| soft * share * t.max(0.0)).collect()
            }
            Self::Wavy {
                joint,
                share,
                waves,
                ..
            } => {
                let factor = share * (waves * pose[*joint].to_radians()).sin();
                torques.iter().map(|t| soft * factor * t).collect()
            }
        }
    }
}

/// The side of the gap on which the joint rests, moved only by more torque than holds it.
fn held_gap(torques: &[f64], weight: f64, width: f64, hold: f64) -> Vec<f64> {
    let side = |torque: f64, last: f64| match torque.abs() > hold {
        true => 0.5 * width * torque.signum(),
        false => last,
    };
    let start = side(weight, 0.0);
    let mut now = start;
    let step = |t: &f64| {
        now = side(weight + t, now);
        now - start
    };
    torques.iter().map(step).collect()
}
