//! How a survey lies to a robot: facts beside its file.

use crate::ground::problem::Outcome;
use crate::ground::spatial::V3;
use crate::ground::units::DEGREE;
use crate::measurement::front::Front;
use std::collections::BTreeMap;
use toml::Value;

/// How a survey lies to a robot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Placement {
    /// Origin of the survey in the base frame, m; none: not stated.
    pub origin: Option<V3>,
    /// The survey's axes are those of the base turned about z by this, rad.
    pub yaw: f64,
    /// The link (name of the joint before it, or `foot`) of nodes that are named.
    pub links: BTreeMap<i64, String>,
}

const REMEDY: &str = "write for example `links = { foot = [1, 2], A1 = [3, 4, 5] }`";

impl Placement {
    /// Reads it.
    ///
    /// # Errors
    /// What is no place, no angle or no list of nodes.
    pub fn read(front: &Front) -> Outcome<Self> {
        let origin = front.numbers("survey_origin_mm")?;
        let origin = origin.map(|mm| match mm[..] {
            [x, y, z] => Ok([x, y, z].map(|v| 1e-3 * v)),
            _ => Err(front.problem(
                "survey_origin_mm",
                format!("has {} numbers", mm.len()),
                "write `survey_origin_mm = [0, 0, 0]`: the origin of the survey in the base frame",
            )),
        });
        Ok(Self {
            origin: origin.transpose()?,
            yaw: front.number("survey_yaw_deg")?.unwrap_or(0.0) * DEGREE,
            links: links(front)?,
        })
    }

    /// A place or a direction of the survey in the axes of the base.
    pub fn turned(&self, v: V3) -> V3 {
        let (sin, cos) = self.yaw.sin_cos();
        [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]]
    }

    /// A direction of the base in the axes of the survey.
    pub fn back(&self, v: V3) -> V3 {
        let (sin, cos) = self.yaw.sin_cos();
        [cos * v[0] + sin * v[1], cos * v[1] - sin * v[0], v[2]]
    }
}

fn links(front: &Front) -> Outcome<BTreeMap<i64, String>> {
    let wrong = |what: String| front.problem("links", what, REMEDY);
    let table = match front.facts.get("links") {
        None => return Ok(BTreeMap::new()),
        Some(Value::Table(table)) => table,
        Some(other) => return Err(wrong(format!("is {} instead of a table", other.type_str()))),
    };
    let mut found = BTreeMap::new();
    for (link, nodes) in table {
        let nodes = nodes.as_array().map(Vec::as_slice).unwrap_or_default();
        let labels: Option<Vec<i64>> = nodes.iter().map(Value::as_integer).collect();
        let labels = labels.filter(|all| !all.is_empty());
        let labels = labels.ok_or_else(|| wrong(format!("`{link}` is no list of nodes")))?;
        for label in labels {
            if let Some(other) = found.insert(label, link.clone()) {
                return Err(wrong(format!(
                    "node {label} is on `{other}` and on `{link}`"
                )));
            }
        }
    }
    Ok(found)
}
