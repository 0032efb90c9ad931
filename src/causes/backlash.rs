//! The drive of one axis has lost motion.

use super::contract::{Amount, Blame, Card, Cause, Sight};
use super::places::{Said, drives};
use crate::effects::Family;
use crate::experiments::drive_law::Law;
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
        gap("gap", "lost motion from stop to stop, crossed within 1 N·m"),
        gap("gap_stiff", "the same, crossed within 3 N·m"),
        gap(
            "gap_held",
            "the same where friction of 2.5 N·m holds the axis where it was left last",
        ),
        gap("gap_held_5", "the same with friction of 5 N·m"),
        gap("gap_held_8", "the same with friction of 8 N·m"),
        gap("gap_held_12", "the same with friction of 12 N·m"),
        gap("gap_held_18", "the same with friction of 18 N·m"),
    ],
};

/// How the gap of each amount is crossed.
const LAWS: [Law; 7] = [
    Law::Free(1.0),
    Law::Free(3.0),
    Law::Held(2.5),
    Law::Held(5.0),
    Law::Held(8.0),
    Law::Held(12.0),
    Law::Held(18.0),
];

const fn gap(name: &'static str, meaning: &'static str) -> Amount {
    Amount::new(name, "rad", meaning, [0.0, 0.02], &[2e-4])
}

impl Cause for Backlash {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        drives(robot)
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        (0..LAWS.len()).map(|k| vec![k]).collect()
    }

    fn law(&self, amounts: &[f64]) -> Law {
        let own = amounts.iter().zip(LAWS).find(|(gap, _)| **gap > 0.0);
        own.map_or(LAWS[0], |(_, law)| law)
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
