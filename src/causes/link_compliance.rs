//! A link bends.

use super::contract::{Amount, Blame, Card, Cause, Sight};
use super::places::{Said, add_axes, added, drive_compliance, ends, number_in, said_axes};
use crate::effects::Family;
use crate::ground::spatial::{norm, sub};
use crate::robot::Robot;

/// See the card.
pub struct LinkCompliance;

const CARD: Card = Card {
    name: "link_compliance",
    family: Family::Physics,
    summary: "A link bends or twists, and the model holds it rigid.",
    equation: "rotations about three axes at one place along the link, from its near to its far end, compliance added",
    source: "virtual axes as in sources 000 and 002, Table 1",
    shows: &[
        (
            Sight::Workspace,
            "error that turns with that link and grows with the distance from where it bends",
        ),
        (
            Sight::Hammer,
            "modes in which the parts before and behind the bend of the link move apart",
        ),
    ],
    amounts: &AMOUNTS,
};

macro_rules! turns_at {
    ($at:literal) => {
        [
            added(
                concat!("x_at_", $at),
                concat!("compliance about x at ", $at, " of the length"),
            ),
            added(
                concat!("y_at_", $at),
                concat!("compliance about y at ", $at, " of the length"),
            ),
            added(
                concat!("z_at_", $at),
                concat!("compliance about z at ", $at, " of the length"),
            ),
        ]
    };
}

static AMOUNTS: [Amount; 3 * ALONG.len()] = flat([
    turns_at!("1/2"),
    turns_at!("0"),
    turns_at!("1"),
    turns_at!("1/4"),
    turns_at!("3/4"),
    turns_at!("1/8"),
    turns_at!("3/8"),
    turns_at!("5/8"),
    turns_at!("7/8"),
]);

const fn flat(triples: [[Amount; 3]; ALONG.len()]) -> [Amount; 3 * ALONG.len()] {
    let mut all = [triples[0][0]; 3 * ALONG.len()];
    let mut i = 0;
    while i < all.len() {
        all[i] = triples[i / 3][i % 3];
        i += 1;
    }
    all
}

/// Where along the link the triples of amounts act, as a share of its length.
const ALONG: [f64; 9] = [0.5, 0.0, 1.0, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875];

/// How likely each is: a beam under end loads turns as if hinged between a third and the middle of its
/// length; at its ends sit bearings that have causes of their own.
const LIKELY: [f64; 9] = [1.0, 0.05, 0.05, 0.6, 0.6, 0.2, 1.0, 1.0, 0.2];
/// The shortest of links is still blamed with this share of the readiness of the longest.
const SHORT: f64 = 0.1;

/// Length of link `i` (from 1), m.
fn length(robot: &Robot, i: usize) -> f64 {
    ends(robot, i).map_or(0.0, |[from, to]| norm(sub(to, from)))
}

impl Cause for LinkCompliance {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        (1..robot.dof()).map(|i| format!("link{i}")).collect()
    }

    fn heard(&self) -> usize {
        3
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn scale(&self, robot: &Robot, site: &str) -> Vec<f64> {
        let i = number_in(site, "link").unwrap_or(1);
        let near = drive_compliance(robot, i);
        let far = drive_compliance(robot, i + 1);
        vec![(near * far).sqrt(); 3 * ALONG.len()]
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        let count = 3 * ALONG.len();
        let one = (0..count).map(|k| vec![k]);
        let two = (0..count).map(|k| vec![k, 3 * (k / 3) + (k + 1) % 3]);
        let all = (0..ALONG.len()).map(|at| (3 * at..3 * at + 3).collect());
        one.chain(two).chain(all).collect()
    }

    /// Bending grows with length (Euler and Bernoulli): a long link is blamed before a short one.
    fn readiness(&self, robot: &Robot, site: &str) -> f64 {
        let all = (1..robot.dof()).map(|i| length(robot, i));
        let longest = all.fold(1e-9, f64::max);
        let own = length(robot, number_in(site, "link").unwrap_or(1));
        (own / longest).max(SHORT)
    }

    fn shares(&self) -> Vec<f64> {
        let of = |form: &Vec<usize>| LIKELY[form[0] / 3];
        self.forms().iter().map(of).collect()
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let number = number_in(site, "link");
        let Some((i, [from, to])) = number.and_then(|i| Some((i, ends(robot, i)?))) else {
            return;
        };
        for (own, along) in amounts.chunks(3).zip(ALONG) {
            let at = [0, 1, 2].map(|k| from[k] + along * (to[k] - from[k]));
            add_axes(robot, site, i, at, own);
        }
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        amounts.chunks(3).flat_map(said_axes).collect()
    }
}
