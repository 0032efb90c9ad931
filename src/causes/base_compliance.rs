//! The foundation gives way.

use super::contract::{Amount, Blame, Card, Cause, Sight};
use super::places::{Said, add_axes, add_shift, added, added_spring, drive_compliance};
use super::turns::{Names, SIX, TURNS, axes, said_matrix, shared, sizes};
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct BaseCompliance;

const CARD: Card = Card {
    name: "base_compliance",
    family: Family::Physics,
    summary: "The foundation gives way, and the model holds it rigid.",
    equation: "rotations about axes of the base frame through its origin, and shifts along them, compliance added: symmetric matrices",
    source: "source 004; knowledge of foot bolts: Worden and Tomlinson 2001",
    shows: &[
        (
            Sight::Workspace,
            "error whose pattern is fixed in the base frame, not in the arm",
        ),
        (
            Sight::Hammer,
            "low modes in which the whole robot rocks; a sensor on the foot moves in phase",
        ),
    ],
    amounts: &[
        added("about_x", "compliance of the foundation about x"),
        added("about_y", "compliance of the foundation about y"),
        added("about_z", "compliance of the foundation about z"),
        shared(
            "about_yz",
            "compliance of the foundation that y and z share",
        ),
        shared(
            "about_zx",
            "compliance of the foundation that z and x share",
        ),
        shared(
            "about_xy",
            "compliance of the foundation that x and y share",
        ),
        shift("along_x", "compliance of the foundation along x"),
        shift("along_y", "compliance of the foundation along y"),
        shift("along_z", "compliance of the foundation along z"),
        both(
            "along_yz",
            "compliance of the foundation along y and z that both share",
        ),
        both(
            "along_zx",
            "compliance of the foundation along z and x that both share",
        ),
        both(
            "along_xy",
            "compliance of the foundation along x and y that both share",
        ),
    ],
};

/// A compliance against shifting, in 1e-7 m/N.
const fn shift(name: &'static str, meaning: &'static str) -> Amount {
    Amount::new(name, "1e-7 m/N", meaning, [0.0, 100.0], &[1.0])
}

/// What two axes share of a compliance against shifting, in 1e-7 m/N.
const fn both(name: &'static str, meaning: &'static str) -> Amount {
    Amount {
        unit: "1e-7 m/N",
        ..shared(name, meaning)
    }
}

/// Of shifts.
const SHIFTS: Names = Names {
    straight: [
        "stiffness_along_x",
        "stiffness_along_y",
        "stiffness_along_z",
    ],
    principal: [
        "stiffness_along_softest",
        "stiffness_along_second",
        "stiffness_along_third",
    ],
    softest: ["softest_along_x", "softest_along_y", "softest_along_z"],
};

/// A shift is a turn about an axis this far away, m: over the reach of a robot the difference is below a tenth of a percent.
const FAR: f64 = 5000.0;

impl Cause for BaseCompliance {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, _robot: &Robot) -> Vec<String> {
        vec!["base".to_string()]
    }

    fn heard(&self) -> usize {
        2 * SIX
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn scale(&self, robot: &Robot, _site: &str) -> Vec<f64> {
        let own = sizes(drive_compliance(robot, 1));
        [own, own].concat()
    }

    fn matrices(&self) -> Vec<usize> {
        vec![0, SIX]
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        let turns = [vec![0], vec![1], vec![2], vec![0, 1], vec![0, 1, 2]];
        let shifts = [6, 7, 8];
        let straight = [shifts.to_vec(), [&[0, 1, 2][..], &shifts].concat()];
        let level = vec![0, 1, 5];
        let oblique = [level, (0..SIX).collect(), (0..2 * SIX).collect()];
        turns.into_iter().chain(straight).chain(oblique).collect()
    }

    /// Foot bolts stretch: a foundation rocks or heaves rather than that it turns about the vertical.
    fn shares(&self) -> Vec<f64> {
        vec![1.0, 1.0, 0.3, 1.0, 1.0, 0.5, 1.0, 1.0, 1.0, 1.0]
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let (turns, shifts) = amounts.split_at(SIX.min(amounts.len()));
        add_axes(robot, site, 0, [0.0; 3], turns);
        for (k, (along, amount)) in axes(shifts).into_iter().enumerate() {
            let name = format!("{site}-along-{}", ["x", "y", "z"][k]);
            if let Some(spring) = added_spring(amount) {
                add_shift(robot, &name, (0, [0.0; 3], FAR), (along, spring));
            }
        }
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        let (turns, shifts) = amounts.split_at(SIX.min(amounts.len()));
        let along = said_matrix(shifts, &SHIFTS).into_iter();
        let unit = |unit: &'static str| if unit == "1" { unit } else { "N/m" };
        let along = along.map(|(name, value, own)| (name, value, unit(own)));
        said_matrix(turns, &TURNS)
            .into_iter()
            .chain(along)
            .collect()
    }
}
