//! The lines that all frequency responses of a file stand on.

use super::refuse;
use crate::ground::problem::Outcome;
use crate::measurement::uff::{Abscissa, Function, Quantity};
use std::f64::consts::TAU;

/// Relative error up to which spacings are the same: five digits are written.
const SAME: f64 = 1e-4;
/// Fewest lines of a frequency response.
const FEWEST: usize = 16;

/// Evenly spaced lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// First, Hz.
    pub start_hz: f64,
    /// Spacing, Hz.
    pub step_hz: f64,
    /// How many.
    pub count: usize,
}

impl Grid {
    /// The lines, Hz.
    pub fn frequency_hz(&self) -> Vec<f64> {
        let line = |k: usize| self.start_hz + k as f64 * self.step_hz;
        (0..self.count).map(line).collect()
    }

    /// What both hold.
    ///
    /// # Errors
    /// Another start or spacing.
    pub fn and(self, other: Self, line: usize) -> Outcome<Self> {
        let apart = |a: f64, b: f64| (a - b).abs() > SAME * self.step_hz;
        if apart(self.step_hz, other.step_hz) || apart(self.start_hz, other.start_hz) {
            let what = format!(
                "lines every {} Hz from {} Hz, others every {} Hz from {} Hz",
                other.step_hz, other.start_hz, self.step_hz, self.start_hz
            );
            return Err(refuse(line, what, "export all functions on the same lines"));
        }
        let count = self.count.min(other.count);
        Ok(Self { count, ..self })
    }
}

/// The lines of one function.
///
/// # Errors
/// Lines that are no frequencies, not even, or too few.
pub fn of(function: &Function, line: usize) -> Outcome<Grid> {
    let places = function.places();
    if places.len() < FEWEST {
        let what = format!("{} lines are no frequency response", places.len());
        return Err(refuse(line, what, "export the whole band"));
    }
    let to_hz = to_hz(function, line)?;
    let step = (places[places.len() - 1] - places[0]) / (places.len() - 1) as f64;
    let step = match function.abscissa {
        Abscissa::Even { .. } => places[1] - places[0],
        Abscissa::Uneven(_) => step,
    };
    let even = |(k, f): (usize, &f64)| (f - places[0] - k as f64 * step).abs() <= 0.05 * step;
    if !(step > 0.0 && places[0] >= 0.0 && places.iter().enumerate().all(even)) {
        let what = "the lines are not evenly spaced upwards from zero or above";
        return Err(refuse(
            line,
            what,
            "export with even spacing (1 in record 7)",
        ));
    }
    Ok(Grid {
        start_hz: places[0] * to_hz,
        step_hz: step * to_hz,
        count: places.len(),
    })
}

fn to_hz(function: &Function, line: usize) -> Outcome<f64> {
    let axis = &function.axes[0];
    let unit = axis.unit.to_lowercase().replace(' ', "");
    match (axis.quantity, unit.as_str()) {
        (_, "rad/s") => Ok(1.0 / TAU),
        (_, "rpm") => Ok(1.0 / 60.0),
        (Quantity::Frequency | Quantity::General | Quantity::Other(_), _) => Ok(1.0),
        (other, _) => {
            let what = format!(
                "the abscissa is no frequency (specific data type {})",
                other.code()
            );
            Err(refuse(
                line,
                what,
                "export over frequency (18 in record 8), in Hz",
            ))
        }
    }
}
