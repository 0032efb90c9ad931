//! Something hangs at the tool by springs of its own: a cable, a chip guard, a tuned absorber.

use super::contract::{Amount, Card, Cause, Sight};
use super::places::{Said, add_shift};
use crate::effects::Family;
use crate::ground::spatial::{V3, norm, scale};
use crate::robot::{Body, Robot, Spring};
use std::f64::consts::TAU;

/// See the card. No cause of the library, nor of the contract of the files: it is sought so that no other cause is named in its place, and
/// told as unknown.
pub struct HungBody;

/// Name of the coordinate in which the body swings; the tool does not sit behind it.
pub const HUNG: &str = "what hangs at the tool";
/// Damping ratio of the swing; that of an axis which is added is uncertain by its own.
const DAMPING: f64 = 0.02;
/// Its shift is a turn about an axis this far away, m: a point does not see the turn, its weight hardly, and farther away mass matrices lose
/// digits.
const FAR: f64 = 100.0;
/// Mass that is tried first, kg, and the largest.
const MASS: f64 = 3.0;
const MOST: f64 = 60.0;

/// Frequencies from which a search starts, Hz: over the band of a hammer test, each 15 % above the one before.
const FREQUENCIES: [f64; 22] = [
    2.5, 2.9, 3.3, 3.8, 4.4, 5.0, 5.8, 6.7, 7.7, 8.8, 10.1, 11.6, 13.4, 15.4, 17.7, 20.3, 23.4,
    26.9, 30.9, 35.6, 40.9, 47.0,
];
const COUNT: usize = 3 * FREQUENCIES.len();

/// The mass along one direction in the starts: there for its own, none for the others.
const fn masses(own: usize) -> [f64; COUNT] {
    let mut all = [0.0; COUNT];
    let mut i = 0;
    while i < FREQUENCIES.len() {
        all[own * FREQUENCIES.len() + i] = MASS;
        i += 1;
    }
    all
}

const fn frequencies() -> [f64; COUNT] {
    let mut all = [0.0; COUNT];
    let mut i = 0;
    while i < COUNT {
        all[i] = FREQUENCIES[i % FREQUENCIES.len()];
        i += 1;
    }
    all
}

static MASSES: [[f64; COUNT]; 3] = [masses(0), masses(1), masses(2)];
static ALL_FREQUENCIES: [f64; COUNT] = frequencies();

const fn along(name: &'static str, starts: &'static [f64]) -> Amount {
    let meaning = "mass times the direction in which it swings, base axes, every joint at zero";
    Amount::new(name, "kg", meaning, [-MOST, MOST], starts)
}

static AMOUNTS: [Amount; 4] = [
    along("mass_x", &MASSES[0]),
    along("mass_y", &MASSES[1]),
    along("mass_z", &MASSES[2]),
    Amount::new(
        "frequency",
        "Hz",
        "at which it swings at a tool that stands",
        [2.0, 55.0],
        &ALL_FREQUENCIES,
    ),
];

static CARD: Card = Card {
    name: "hung_body",
    family: Family::Physics,
    summary: "Something hangs at the tool by springs of its own, and the model does not have it.",
    equation: "a point mass at the tool centre point that slides along one direction, on a spring",
    source: "Den Hartog 1956, 3.2",
    shows: &[(
        Sight::Hammer,
        "one more peak beside a dip, at the tool alone",
    )],
    amounts: &AMOUNTS,
};

impl Cause for HungBody {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, _robot: &Robot) -> Vec<String> {
        vec!["tool".to_string()]
    }

    fn is_size(&self, index: usize) -> bool {
        index < 3
    }

    fn is_outside(&self) -> bool {
        true
    }

    fn alter(&self, robot: &mut Robot, _site: &str, amounts: &[f64]) {
        let &[x, y, z, frequency] = amounts else {
            return;
        };
        let mass = norm([x, y, z]);
        if mass < 1e-9 || frequency <= 0.0 {
            return;
        }
        stand_before(robot);
        let omega = TAU * frequency;
        let spring = Spring::new(mass * omega * omega, 2.0 * DAMPING * omega * mass);
        let direction: V3 = scale(1.0 / mass, [x, y, z]);
        let (after, tcp) = (robot.dof(), robot.tool.tcp);
        add_shift(robot, HUNG, (after, tcp, FAR), (direction, spring));
        robot.tool.body = Some(Body {
            mass,
            com: tcp,
            inertia: [0.0; 6],
        });
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        match amounts {
            &[x, y, z, frequency] => vec![
                ("mass", norm([x, y, z]), "kg"),
                ("frequency", frequency, "Hz"),
            ],
            _ => Vec::new(),
        }
    }
}

/// Makes the body of the tool a part of what it stands on: what hangs at it comes behind.
fn stand_before(robot: &mut Robot) {
    let last = robot.dof();
    let Some(tool) = robot.tool.body.take() else {
        return;
    };
    let axis = robot.elastic.iter_mut().rfind(|axis| axis.after == last);
    let before = match axis {
        Some(axis) => Some(&mut axis.body),
        None => robot.joints.last_mut().map(|joint| &mut joint.link),
    };
    if let Some(body) = before {
        *body = Some(body.unwrap_or(Body::NOTHING).with(&tool));
    }
}
