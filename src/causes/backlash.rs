//! The drive of one axis has lost motion.

use super::contract::{Amount, Blame, Card, Cause, Sight};
use super::places::Said;
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct Backlash;

const CARD: Card = Card {
    name: "backlash",
    family: Family::Physics,
    summary: "The drive of an axis has lost motion that the model lacks.",
    equation: "δ = τ/k + ½ s·sgn τ, with τ from the force and the weight of what the axis carries",
    source: "source 004; dead zone: Nordin and Gutman 2002",
    shows: &[(
        Sight::Workspace,
        "a jump where the torque on that axis changes its sign; none while weight preloads it",
    )],
    amounts: &[
        gap("gap", "lost motion from stop to stop"),
        gap(
            "gap_held",
            "the same where friction holds the axis at the stop that it left last",
        ),
    ],
};

const fn gap(name: &'static str, meaning: &'static str) -> Amount {
    Amount {
        name,
        unit: "rad",
        meaning,
        bounds: [0.0, 0.02],
        starts: &[2e-4],
    }
}

impl Cause for Backlash {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        let elastic = robot.joints.iter().filter(|joint| joint.drive.is_some());
        elastic.map(|joint| joint.name.clone()).collect()
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        vec![vec![0], vec![1]]
    }

    fn remembers(&self, amounts: &[f64]) -> bool {
        amounts[1] > 0.0
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        vec![("gap", amounts.iter().sum(), "rad")]
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        if let Some((_, spring)) = robot.springs_mut().find(|(name, _)| name == site) {
            let gaps = amounts.iter().copied();
            spring.backlash.extend(gaps.filter(|gap| *gap > 0.0));
        }
    }
}
