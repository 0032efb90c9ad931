//! Patterns that no cause of the library has, kept beside it so that they take no neighbour's name:
//! where one of them explains the error best, the cause is unknown, and this is what is seen.

use crate::causes::contract::{Blame, Card, Cause, Sight};
use crate::causes::places::{UNIT_COMPLIANCE, added, number_in};
use crate::effects::Family;
use crate::ground::spatial::V3;
use crate::robot::model::ElasticAxis;
use crate::robot::{Robot, Spring};

/// All of them.
pub const STRANGERS: &[&dyn Cause] = &[&Shift];

/// Whether a cause is none of the library.
pub fn is_stranger(cause: &dyn Cause) -> bool {
    STRANGERS.iter().any(|s| s.card().name == cause.card().name)
}

/// A body that gives way along an axis instead of about one.
struct Shift;

const CARD: Card = Card {
    name: "shift",
    family: Family::Physics,
    summary: "moves along an axis of its own without turning",
    equation: "C = C₀ + Σ c·R eₖ eₖᵀ Rᵀ",
    source: "prismatic virtual axes",
    shows: &[(Sight::Workspace, "compliance that no lever changes")],
    amounts: &[
        added("along_x", "compliance along x, with every joint at zero"),
        added("along_y", "compliance along y, with every joint at zero"),
        added("along_z", "compliance along z, with every joint at zero"),
    ],
};

/// A turn about an axis this far away is a shift, m.
const FAR: f64 = 5000.0;

impl Cause for Shift {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        (1..=robot.dof()).map(|i| format!("link{i}")).collect()
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn scale(&self, _robot: &Robot, _site: &str) -> Vec<f64> {
        vec![3.0; 3]
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        vec![vec![0], vec![1], vec![2], vec![0, 1, 2]]
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let after = number_in(site, "link").unwrap_or(0);
        for (k, amount) in amounts.iter().enumerate().filter(|(_, a)| **a > 0.0) {
            let unit = |at: usize| -> V3 { std::array::from_fn(|i| f64::from(u8::from(i == at))) };
            robot.elastic.push(ElasticAxis {
                name: format!("{site}-along-{k}"),
                after,
                axis: unit((k + 1) % 3),
                point: unit((k + 2) % 3).map(|x| x * FAR),
                spring: Spring::new(FAR * FAR / (amount * UNIT_COMPLIANCE), 0.0),
            });
        }
    }
}
