//! The force does not point where it is said to.

use super::contract::{Amount, Card, Cause, Sight, StepSeen};
use crate::effects::Family;
use crate::ground::spatial::{V3, cross, rotate};

/// See the card. Its site is the sensor: the direction is that of the load cell and its rig, and no
/// part of the robot is blamed.
pub struct LoadMisalignment;

const CARD: Card = Card {
    name: "load_misalignment",
    family: Family::Measurement,
    summary: "The force is tilted against the direction it is said to have.",
    equation: "d = C·(F + θ × F), θ fixed in the base frame, in that of the tool, or for one direction of the force",
    source: "rotation of the force sensor's frame: w′ = R·w",
    shows: &[(
        Sight::Workspace,
        "cross-components that compliance alone, being symmetric, cannot have",
    )],
    amounts: &[
        angle("about_x", "angle about x of the base frame"),
        angle("about_y", "angle about y of the base frame"),
        angle("about_z", "angle about z of the base frame"),
        angle("tool_x", "angle about x of the tool frame"),
        angle("tool_y", "angle about y of the tool frame"),
        angle("tool_z", "angle about z of the tool frame"),
        angle("x_to_y", "tilt of the force in x towards y, in x alone"),
        angle("x_to_z", "tilt of the force in x towards z"),
        angle("y_to_z", "tilt of the force in y towards z"),
        angle("y_to_x", "tilt of the force in y towards x"),
        angle("z_to_x", "tilt of the force in z towards x"),
        angle("z_to_y", "tilt of the force in z towards y"),
    ],
};

const fn angle(name: &'static str, meaning: &'static str) -> Amount {
    Amount::new(name, "rad", meaning, [-0.8, 0.8], &[0.12, -0.12])
}

impl Cause for LoadMisalignment {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        let one = (0..6).map(|k| vec![k]);
        let turned = [vec![0, 1, 2], vec![3, 4, 5]];
        let single = [vec![6, 7], vec![8, 9], vec![10, 11], (6..12).collect()];
        one.chain(turned).chain(single).collect()
    }

    fn read_step(&self, _site: &str, amounts: &[f64], compliance: &[V3; 3], step: &mut StepSeen) {
        let base: V3 = std::array::from_fn(|k| amounts[k]);
        let tool = rotate(&step.tool, std::array::from_fn(|k| amounts[3 + k]));
        let turned: V3 = std::array::from_fn(|k| base[k] + tool[k]);
        let mut force = [0.0; 3];
        force[step.direction] = step.force;
        let mut across = cross(turned, force);
        let own = 6 + 2 * step.direction;
        across[(step.direction + 1) % 3] += amounts[own] * step.force;
        across[(step.direction + 2) % 3] += amounts[own + 1] * step.force;
        for (column, f) in compliance.iter().zip(across) {
            (0..3).for_each(|k| step.displacement[k] += column[k] * f);
        }
    }
}
