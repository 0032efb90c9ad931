//! Data set 58: a function at a degree of freedom.

use super::axis::{Axis, Quantity};
use rustfft::num_complex::Complex64;

/// What kind of function; the code is kept for those without a name here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// 1: time record.
    Time,
    /// 4: frequency response function.
    FrequencyResponse,
    /// 6: coherence.
    Coherence,
    /// Any other code.
    Other(i64),
}

impl Kind {
    /// The kind with this code.
    pub fn of(code: i64) -> Self {
        match code {
            1 => Self::Time,
            4 => Self::FrequencyResponse,
            6 => Self::Coherence,
            other => Self::Other(other),
        }
    }

    /// Its code in the file.
    pub fn code(self) -> i64 {
        match self {
            Self::Time => 1,
            Self::FrequencyResponse => 4,
            Self::Coherence => 6,
            Self::Other(code) => code,
        }
    }
}

/// A degree of freedom.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dof {
    /// Name of the entity, at most 10 characters; some analysers hide the node here.
    pub entity: String,
    /// Node.
    pub node: i64,
    /// 0 scalar, ±1 ±2 ±3 translation along ±X ±Y ±Z, ±4 ±5 ±6 rotation.
    pub direction: i64,
}

/// The places at which the function is given.
#[derive(Debug, Clone, PartialEq)]
pub enum Abscissa {
    /// `start + i·step`
    Even {
        /// First place.
        start: f64,
        /// Distance.
        step: f64,
    },
    /// One place per value.
    Uneven(Vec<f64>),
}

/// The values.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Real.
    Real(Vec<f64>),
    /// Complex.
    Complex(Vec<Complex64>),
}

impl Values {
    /// How many.
    pub fn len(&self) -> usize {
        match self {
            Self::Real(values) => values.len(),
            Self::Complex(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All of them times `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Real(values) => Self::Real(values.iter().map(|v| v * factor).collect()),
            Self::Complex(values) => Self::Complex(values.iter().map(|v| v * factor).collect()),
        }
    }
}

/// A function of one variable with its labels.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// Records 1 to 5.
    pub id: [String; 5],
    /// What kind.
    pub kind: Kind,
    /// Number of the function, version, load case.
    pub numbers: [i64; 3],
    /// Where the response was taken.
    pub response: Dof,
    /// Where the force acted.
    pub reference: Dof,
    /// The places.
    pub abscissa: Abscissa,
    /// The values.
    pub values: Values,
    /// Whether they are stored with 8 bytes.
    pub double: bool,
    /// Third coordinate.
    pub z: f64,
    /// Abscissa, ordinate, denominator of the ordinate, third axis.
    pub axes: [Axis; 4],
}

impl Function {
    /// The places, one per value. An even step that is within 1e-5 of one over a whole number is
    /// taken as that: six digits do not hold 1/2048.
    pub fn places(&self) -> Vec<f64> {
        match &self.abscissa {
            Abscissa::Uneven(places) => places.clone(),
            Abscissa::Even { start, step } => {
                let step = snapped(*step);
                let places = 0..self.values.len();
                places.map(|i| start + i as f64 * step).collect()
            }
        }
    }

    /// The quantity of the ordinate (numerator), by its code, else by its unit label.
    pub fn quantity(&self) -> Quantity {
        match self.axes[1].quantity {
            Quantity::Other(0) | Quantity::General => labelled(&self.axes[1].unit),
            known => known,
        }
    }
}

/// Snaps a step to one over a whole number, or to a whole number, within 1e-5.
fn snapped(step: f64) -> f64 {
    let whole = |v: f64| (v - v.round()).abs() <= 1e-5 * v.abs() && v.round() != 0.0;
    let rate = 1.0 / step;
    if rate.is_finite() && rate.abs() >= 1.0 && whole(rate) {
        1.0 / rate.round()
    } else if whole(step) {
        step.round()
    } else {
        step
    }
}

fn labelled(unit: &str) -> Quantity {
    let unit = unit.replace(['(', ')', ' '], "").to_lowercase();
    match unit.as_str() {
        "n" => Quantity::ExcitationForce,
        "m/s^2" | "m/s2" | "m/s²" | "m/s**2" => Quantity::Acceleration,
        _ => Quantity::Other(0),
    }
}
