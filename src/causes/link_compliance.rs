//! A link bends.

use super::contract::{Amount, Blame, Card, Cause, Sight};
use super::places::{Said, add_axes, added, drive_compliance, ends, number_in};
use super::turns::{SIX, TURNS, said_matrix, shared, sizes};
use crate::effects::Family;
use crate::ground::spatial::{V3, norm, sub, unit};
use crate::robot::Robot;

/// See the card.
pub struct LinkCompliance;

const CARD: Card = Card {
    name: "link_compliance",
    family: Family::Physics,
    summary: "A link bends or twists, and the model holds it rigid.",
    equation: "rotations about axes through one place along the link, from its near to its far end, compliance added: a symmetric matrix; or as a beam, half of it at each of two places",
    source: "virtual axes as in sources 000 and 002, Table 1; a beam integrated by two points (Gauss 1814)",
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

macro_rules! turns {
    ($name:expr, $place:expr) => {
        [
            added(concat!("x", $name), concat!("compliance about x", $place)),
            added(concat!("y", $name), concat!("compliance about y", $place)),
            added(concat!("z", $name), concat!("compliance about z", $place)),
            shared(
                concat!("yz", $name),
                concat!("compliance that y and z share", $place),
            ),
            shared(
                concat!("zx", $name),
                concat!("compliance that z and x share", $place),
            ),
            shared(
                concat!("xy", $name),
                concat!("compliance that x and y share", $place),
            ),
        ]
    };
}

macro_rules! turns_at {
    ($at:literal) => {
        turns!(concat!("_at_", $at), concat!(" at ", $at, " of the length"))
    };
}

static AMOUNTS: [Amount; BEHIND + 1] = flat([
    turns_at!("1/2"),
    turns_at!("0"),
    turns_at!("1"),
    turns_at!("1/4"),
    turns_at!("3/4"),
    turns_at!("1/8"),
    turns_at!("3/8"),
    turns_at!("5/8"),
    turns_at!("7/8"),
    turns!("_as_beam", " spread over the length"),
]);

const fn flat(places: [[Amount; SIX]; ALONG.len()]) -> [Amount; BEHIND + 1] {
    let mut all = [SHARE_BEHIND; BEHIND + 1];
    let mut i = 0;
    while i < BEHIND {
        all[i] = places[i / SIX][i % SIX];
        i += 1;
    }
    all
}

/// Place of the amount that tells how much of the link's body lies behind the bend.
const BEHIND: usize = SIX * ALONG.len();

const SHARE_BEHIND: Amount = Amount::new(
    "behind",
    "1",
    "share of the link's body behind where it bends",
    [0.0, 1.0],
    &[0.5],
);

/// Where along the link the matrices act, as shares of its length: at one place, or at the two that integrate a uniform beam
/// under end loads exactly.
const ALONG: [&[f64]; 10] = [
    &[0.5],
    &[0.0],
    &[1.0],
    &[0.25],
    &[0.75],
    &[0.125],
    &[0.375],
    &[0.625],
    &[0.875],
    &[0.5 - GAUSS, 0.5 + GAUSS],
];
/// 1 / √12.
const GAUSS: f64 = 0.288_675_134_594_812_9;

/// How likely each is: a flange or a hollow gives way between a third and two thirds of the length; at its ends sit bearings
/// that have causes of their own; a casting bends all along (as likely as the middle: no other value was tried).
const LIKELY: [f64; 10] = [1.0, 0.05, 0.05, 0.6, 0.6, 0.2, 1.0, 1.0, 0.2, 1.0];
/// The shortest of links is still blamed with this share of the readiness of the longest.
const SHORT: f64 = 0.1;

/// Length of link `i` (from 1), m.
fn length(robot: &Robot, i: usize) -> f64 {
    ends(robot, i).map_or(0.0, |[from, to]| norm(sub(to, from)))
}

/// Puts the share `behind` of the body of link `i` behind its last axis; `along`: the way of the link.
fn cut(robot: &mut Robot, i: usize, along: V3, behind: f64) {
    let (joint, axis) = (robot.joints.get_mut(i - 1), robot.elastic.last_mut());
    let (Some(joint), Some(axis), Some(along)) = (joint, axis, unit(along)) else {
        return;
    };
    let cut = joint.link.and_then(|body| body.cut(along, behind));
    if let Some([near, far]) = cut {
        (joint.link, axis.body) = (Some(near), Some(far));
    }
}

impl Cause for LinkCompliance {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        (1..robot.dof()).map(|i| format!("link{i}")).collect()
    }

    fn heard(&self) -> usize {
        SIX
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn scale(&self, robot: &Robot, site: &str) -> Vec<f64> {
        let i = number_in(site, "link").unwrap_or(1);
        let near = drive_compliance(robot, i);
        let far = drive_compliance(robot, i + 1);
        let turns = sizes((near * far).sqrt()).repeat(ALONG.len());
        [&turns[..], &[1.0]].concat()
    }

    fn behind(&self) -> Option<usize> {
        Some(BEHIND)
    }

    fn matrices(&self) -> Vec<usize> {
        (0..ALONG.len()).map(|at| SIX * at).collect()
    }

    fn next_to(&self, place: usize) -> Vec<usize> {
        let along = |place: usize| match ALONG[place] {
            [one] => Some(*one),
            _ => None,
        };
        let Some(own) = along(place) else {
            return Vec::new();
        };
        let next = |side: f64| {
            let away = |other: usize| Some((other, side * (along(other)? - own)));
            let beyond = (0..ALONG.len()).filter_map(away).filter(|o| o.1 > 0.0);
            beyond.min_by(|a, b| a.1.total_cmp(&b.1)).map(|o| o.0)
        };
        [-1.0, 1.0].into_iter().filter_map(next).collect()
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        let one = [vec![0], vec![1], vec![2]];
        let two = [vec![0, 1], vec![1, 2], vec![2, 0]];
        let all = [vec![0, 1, 2], (0..SIX).collect()];
        let own: Vec<Vec<usize>> = one.into_iter().chain(two).chain(all).collect();
        let moved = |at: usize| {
            let own = own
                .iter()
                .map(move |form| form.iter().map(move |k| SIX * at + k));
            own.map(Iterator::collect)
        };
        (0..ALONG.len()).flat_map(moved).collect()
    }

    /// Bending grows with length (Euler and Bernoulli): a long link is blamed before a short one.
    fn readiness(&self, robot: &Robot, site: &str) -> f64 {
        let all = (1..robot.dof()).map(|i| length(robot, i));
        let longest = all.fold(1e-9, f64::max);
        let own = length(robot, number_in(site, "link").unwrap_or(1));
        (own / longest).max(SHORT)
    }

    fn shares(&self) -> Vec<f64> {
        let of = |form: &Vec<usize>| LIKELY[form[0] / SIX];
        self.forms().iter().map(of).collect()
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let number = number_in(site, "link");
        let Some((i, [from, to])) = number.and_then(|i| Some((i, ends(robot, i)?))) else {
            return;
        };
        let before = robot.elastic.len();
        for (own, places) in amounts[..amounts.len().min(BEHIND)].chunks(SIX).zip(ALONG) {
            let each: Vec<f64> = own.iter().map(|a| a / places.len() as f64).collect();
            for along in places {
                let at = [0, 1, 2].map(|k| from[k] + along * (to[k] - from[k]));
                add_axes(robot, site, i, at, &each);
            }
        }
        let behind = amounts.get(BEHIND).copied().unwrap_or(0.0);
        if behind > 0.0 && robot.elastic.len() > before {
            cut(robot, i, sub(to, from), behind);
        }
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        // what bends at two places next to each other bends between them
        let mut whole = [0.0; SIX];
        for own in amounts[..amounts.len().min(BEHIND)].chunks(SIX) {
            whole.iter_mut().zip(own).for_each(|(sum, a)| *sum += a);
        }
        said_matrix(&whole, &TURNS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::builtin;

    /// What lies behind the bend moves with what follows; the link is as heavy as before.
    #[test]
    fn the_body_is_cut_where_a_share_lies_behind() {
        let whole = builtin::named("kr210").unwrap().unwrap();
        let mut robot = whole.clone();
        let mut amounts = [0.0; BEHIND + 1];
        (amounts[0], amounts[BEHIND]) = (1.0, 0.25);
        LinkCompliance.alter(&mut robot, "link2", &amounts);
        let mass = |body: Option<crate::robot::Body>| body.map_or(0.0, |b| b.mass);
        let before = mass(whole.joints[1].link);
        assert!((mass(robot.joints[1].link) / before - 0.75).abs() < 1e-12);
        assert!((mass(robot.link_body(1)) / before - 1.0).abs() < 1e-12);
        // a share without a bend cuts nothing
        let mut stiff = whole.clone();
        amounts[0] = 0.0;
        LinkCompliance.alter(&mut stiff, "link2", &amounts);
        assert_eq!(stiff, whole);
    }

    #[test]
    fn places_are_next_to_each_other_along_the_link() {
        // of the middle: three and five eighths; of an end: the first eighth; of a beam: none
        assert_eq!(LinkCompliance.next_to(0), [6, 7]);
        assert_eq!(LinkCompliance.next_to(1), [5]);
        assert!(LinkCompliance.next_to(ALONG.len() - 1).is_empty());
    }

    /// A cantilever of compliance c = L/EI under a force at its end sinks by F c L²/3 and turns by F c L/2 (Euler and Bernoulli).
    #[test]
    fn a_beam_sinks_and_turns_as_a_beam() {
        let mut robot = builtin::named("kr210").unwrap().unwrap();
        let [from, to] = ends(&robot, 2).unwrap();
        let before = robot.elastic.len();
        let mut amounts = [0.0; BEHIND];
        amounts[SIX * (ALONG.len() - 1)] = 1.0;
        LinkCompliance.alter(&mut robot, "link2", &amounts);
        let length = norm(sub(to, from));
        let hinges = robot.elastic[before..].iter();
        let hinges: Vec<[f64; 2]> = hinges
            .map(|h| [norm(sub(to, h.point)) / length, 1.0 / h.spring.stiffness])
            .collect();
        let moment = |power: i32| hinges.iter().map(|[x, c]| c * x.powi(power)).sum::<f64>();
        let whole = moment(0);
        assert_eq!(hinges.len(), 2);
        assert!((moment(1) / whole - 1.0 / 2.0).abs() < 1e-12);
        assert!((moment(2) / whole - 1.0 / 3.0).abs() < 1e-12);
    }
}
