//! One axis is damped more or less than the model says.

use super::contract::{Amount, Card, Cause, Sight};
use super::places::Said;
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct JointDamping;

const CARD: Card = Card {
    name: "joint_damping",
    family: Family::Physics,
    summary: "An axis is damped more or less than the model says; `ident damping` identifies all of them together.",
    equation: "d = d₀·eˣ",
    source: "source 000, eq. 2.2: τ = K(θ − q) + D(θ̇ − q̇)",
    shows: &[(
        Sight::Hammer,
        "peaks of the modes in which that axis turns are higher or lower; frequencies stay",
    )],
    amounts: &[Amount {
        name: "logarithm",
        unit: "1",
        meaning: "logarithm of the damping over that of the model",
        bounds: [-4.0, 4.0],
        starts: &[-1.2, 1.2],
    }],
};

impl Cause for JointDamping {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        let damped = robot.springs().filter(|(_, spring)| spring.damping > 0.0);
        damped.map(|(site, _)| site).collect()
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        if let Some((_, spring)) = robot.springs_mut().find(|(name, _)| name == site) {
            spring.damping *= amounts[0].exp();
        }
    }

    fn said(&self, robot: &Robot, site: &str, amounts: &[f64]) -> Said {
        let own = robot.springs().find(|(name, _)| name == site);
        let value = own.map(|(_, spring)| spring.damping * amounts[0].exp());
        value
            .map(|d| ("damping", d, "N·m·s/rad"))
            .into_iter()
            .collect()
    }
}
