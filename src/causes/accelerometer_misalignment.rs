//! The accelerometer is mounted askew.

use super::contract::{Accelerance, Amount, Card, Cause, Sight};
use crate::effects::Family;
use crate::ground::spatial::{V3, cross};
use crate::ground::stats::length;
use nalgebra::Complex;

/// See the card.
pub struct AccelerometerMisalignment;

const CARD: Card = Card {
    name: "accelerometer_misalignment",
    family: Family::Measurement,
    summary: "The accelerometer is mounted askew: its axes are not those of the base frame.",
    equation: "a′ = Rᵀ(φ)·a, φ the rotation vector of the sensor",
    source: "Rodrigues 1840; mounting of triaxial sensors: ISO 5348",
    shows: &[(
        Sight::Hammer,
        "every reading carries a constant share of the others; H is no longer symmetric",
    )],
    amounts: &[
        angle("about_x", "rotation of the sensor about x of the base"),
        angle("about_y", "rotation of the sensor about y of the base"),
        angle("about_z", "rotation of the sensor about z of the base"),
    ],
};

const fn angle(name: &'static str, meaning: &'static str) -> Amount {
    Amount::new(name, "rad", meaning, [-1.6, 1.6], &[0.15])
}

impl Cause for AccelerometerMisalignment {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn read_accelerance(
        &self,
        _site: &str,
        amounts: &[f64],
        _s: Complex<f64>,
        frf: &mut Accelerance,
    ) {
        let turn = turned_back([amounts[0], amounts[1], amounts[2]]);
        let true_one = *frf;
        for (row, weights) in frf.iter_mut().zip(&turn) {
            for (k, entry) in row.iter_mut().enumerate() {
                *entry = (0..3).map(|j| true_one[j][k] * weights[j]).sum();
            }
        }
    }
}

/// Rows of Rᵀ for the rotation vector φ: R = 1 + sin φ/φ [φ]× + (1 − cos φ)/φ² [φ]×².
fn turned_back(phi: V3) -> [V3; 3] {
    let size = length(&phi);
    let (a, b) = match size > 1e-9 {
        true => (size.sin() / size, (1.0 - size.cos()) / (size * size)),
        false => (1.0, 0.5),
    };
    [0, 1, 2].map(|k| {
        let mut axis = [0.0; 3];
        axis[k] = 1.0;
        let once = cross(phi, axis);
        let twice = cross(phi, once);
        [0, 1, 2].map(|j| axis[j] + a * once[j] + b * twice[j])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_about_z_reads_y_as_x() {
        let rows = turned_back([0.0, 0.0, std::f64::consts::FRAC_PI_2]);
        let near = |a: V3, b: V3| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near(rows[0], [0.0, 1.0, 0.0]) && near(rows[1], [-1.0, 0.0, 0.0]));
    }
}
