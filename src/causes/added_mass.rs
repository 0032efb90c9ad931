//! A mass that the model does not know.

use super::contract::{Amount, Card, Cause, Sight};
use crate::effects::Family;
use crate::ground::spatial::V3;
use crate::robot::{Body, Robot};

/// See the card.
pub struct AddedMass;

const CARD: Card = Card {
    name: "added_mass",
    family: Family::Physics,
    summary: "A mass is mounted that the model does not know, or one of its masses is wrong.",
    equation: "a point mass m on the link or the tool, between its mass centre and its outer end",
    source: "rigid-body mechanics; hammer tests with a known added mass: Ewins 2000",
    shows: &[(
        Sight::Hammer,
        "all peaks fall together, anti-resonances move; static stiffness stays",
    )],
    amounts: &[
        Amount {
            name: "mass",
            unit: "kg",
            meaning: "mass added, negative if the model has too much",
            bounds: [-200.0, 400.0],
            starts: &[5.0, 40.0, -10.0],
        },
        Amount {
            name: "place",
            unit: "1",
            meaning: "where it sits: 0 at the mass centre, 1 at the outer end (the next axis, the tool centre point)",
            bounds: [-1.0, 1.0],
            starts: &[0.01, 0.01, 0.5],
        },
    ],
};

impl Cause for AddedMass {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        let links = (1..=robot.dof()).filter(|i| robot.joints[i - 1].link.is_some());
        let links = links.map(|i| format!("link{i}"));
        links.chain(["tool".to_string()]).collect()
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let number: Option<usize> = site.strip_prefix("link").and_then(|n| n.parse().ok());
        match number {
            Some(i) => {
                let end = robot
                    .joints
                    .get(i)
                    .map_or(robot.tool.flange, |next| next.point);
                let joint = robot.joints.get_mut(i.wrapping_sub(1));
                if let Some(link) = joint.and_then(|joint| joint.link.as_mut()) {
                    *link = loaded(link, between(link.com, end, amounts[1]), amounts[0]);
                }
            }
            None => {
                let body = robot.tool.body.unwrap_or(Body::NOTHING);
                let centre = if body.mass > 0.0 {
                    body.com
                } else {
                    robot.tool.flange
                };
                let at = between(centre, robot.tool.tcp, amounts[1]);
                robot.tool.body = Some(loaded(&body, at, amounts[0]));
            }
        }
    }
}

/// A share of the way from one point to another.
fn between(from: V3, to: V3, share: f64) -> V3 {
    [0, 1, 2].map(|k| from[k] + share * (to[k] - from[k]))
}

/// A body with a point mass; a negative one never takes more than nine tenths.
fn loaded(body: &Body, at: V3, mass: f64) -> Body {
    if mass >= 0.0 {
        return body.with(&Body {
            mass,
            com: at,
            inertia: [0.0; 6],
        });
    }
    let share = (1.0 + mass / body.mass.max(1e-9)).max(0.1);
    Body {
        mass: body.mass * share,
        com: body.com,
        inertia: body.inertia.map(|i| i * share),
    }
}
