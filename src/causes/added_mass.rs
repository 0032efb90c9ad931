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
    equation: "a point mass m at the tool, or at the mass centre of a link",
    source: "rigid-body mechanics; hammer tests with a known added mass: Ewins 2000",
    shows: &[(
        Sight::Hammer,
        "all peaks fall together, anti-resonances move; static stiffness stays",
    )],
    amounts: &[Amount {
        name: "mass",
        unit: "kg",
        meaning: "mass added, negative if the model has too much",
        bounds: [-200.0, 400.0],
        starts: &[5.0, 40.0, -10.0],
    }],
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
                let joint = robot.joints.get_mut(i.wrapping_sub(1));
                if let Some(link) = joint.and_then(|joint| joint.link.as_mut()) {
                    *link = loaded(link, link.com, amounts[0]);
                }
            }
            None => {
                let body = robot.tool.body.unwrap_or(Body::NOTHING);
                robot.tool.body = Some(loaded(&body, robot.tool.tcp, amounts[0]));
            }
        }
    }
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
