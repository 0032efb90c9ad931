//! How a drive turns beyond its spring: across a gap, or by a spring that is not straight.

/// The law of a drive whose lost motion, or size of whatever the law says, is one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// A gap crossed evenly within this torque to either side, N·m: no drive moves without any.
    Free(f64),
    /// The same where no weight presses it.
    Unpressed(f64),
    /// A gap crossed at once, and only under more torque than this, N·m: friction holds the axis where
    /// it was left last.
    Held(f64),
    /// More compliance by its own size under load of one sign (1 or -1).
    OneSided(f64),
    /// Compliance that grows by its own size up to this torque, N·m, with the square of the torque.
    Softening(f64),
}

/// A gap of the model is crossed within this torque to either side, N·m.
pub const STOP: f64 = 5.0;

/// What presses a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// Torque of the force, N·m.
    pub load: f64,
    /// Torque of the weight, N·m.
    pub weight: f64,
    /// Compliance of the drive, rad/(N·m).
    pub soft: f64,
}

impl Law {
    /// Angle per size, rad, where it was `last` before.
    pub fn angle(self, press: Press, last: f64) -> f64 {
        let torque = press.load + press.weight;
        match self {
            Self::Free(within) => 0.5 * (torque / within).clamp(-1.0, 1.0),
            Self::Unpressed(within) => 0.5 * (press.load / within).clamp(-1.0, 1.0),
            Self::Held(by) if torque.abs() > by => 0.5 * torque.signum(),
            Self::Held(_) => last,
            Self::OneSided(sign) => press.soft * sign * (sign * press.load).max(0.0),
            Self::Softening(at) => {
                let law = |t: f64| t * (t / at).powi(2);
                press.soft * (law(torque) - law(press.weight))
            }
        }
    }
}
