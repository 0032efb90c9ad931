//! A number that is tuned or fitted along: what it multiplies, its first guess, bounds and prior.

use crate::motion::frf::C64;

/// What a parameter multiplies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A direction of the damping matrix.
    Damping,
    /// A direction of the stiffness matrix.
    Stiffness,
    /// A direction of the mass matrix.
    Mass,
    /// What weight does: `Weight`.
    Weight,
    /// A combination of uncertain numbers of the bodies, in standard deviations.
    Body,
    /// An uncertain number of the instruments, in standard deviations: first those that all poses share,
    /// then those of each pose.
    Instrument,
}

impl Kind {
    /// The factor of the direction in `Z(s) = s²M + sD + K`.
    pub(super) fn factor(self, s: C64) -> C64 {
        match self {
            Self::Damping => s,
            Self::Stiffness => C64::new(1.0, 0.0),
            Self::Mass => s * s,
            Self::Weight | Self::Body | Self::Instrument => C64::default(),
        }
    }

    /// Whether it may be of either sign: such a number is searched as it is, any other by its logarithm.
    pub fn is_signed(self) -> bool {
        matches!(self, Self::Body | Self::Instrument)
    }
}

/// One parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Where it acts, as in `A6`, `A6-tilt`, `base`.
    pub site: String,
    /// What it multiplies.
    pub kind: Kind,
    /// First guess, SI.
    pub start: f64,
    /// Lowest and highest value, SI, positive unless the kind is signed.
    pub bounds: [f64; 2],
    /// Standard deviation about `start`, where a prior is stated: of the logarithm, of a signed number
    /// itself.
    pub prior_ln_std: Option<f64>,
    /// Whether it is only fitted along, with its prior: what is said of the others holds its
    /// uncertainty, of itself nothing is said. Such parameters stand last.
    pub nuisance: bool,
}

impl Parameter {
    /// What is searched of a value: its logarithm, a signed number as it is.
    pub fn coordinate(&self, value: f64) -> f64 {
        match self.kind.is_signed() {
            true => value,
            false => value.ln(),
        }
    }

    /// The value from what is searched.
    pub fn value(&self, coordinate: f64) -> f64 {
        match self.kind.is_signed() {
            true => coordinate,
            false => coordinate.exp(),
        }
    }

    /// Change of the value with what is searched.
    pub(super) fn rate(&self, value: f64) -> f64 {
        match self.kind.is_signed() {
            true => 1.0,
            false => value,
        }
    }

    /// Bounds of what is searched.
    pub(super) fn ends(&self) -> [f64; 2] {
        self.bounds.map(|bound| self.coordinate(bound))
    }
}
