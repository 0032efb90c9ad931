//! Which link of the robot a point of a survey rides on: as stated, else by geometry where that is certain.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, dot, norm, scale, sub};
use crate::measurement::survey::Survey;
use crate::motion::skeleton::Skeleton;

/// A point farther than this from every link is not on the robot, m.
const FAR: f64 = 0.6;
/// The nearest link counts if every other one is so many times as far.
const CLEAR: f64 = 2.0;
/// Nearer than this to two links, a point is at their joint, m: a housing is as thick.
const JOINT: f64 = 0.1;
/// Fewest points on links for a comparison.
pub const FEWEST: usize = 3;

/// How a point came to its link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum How {
    /// The fact `links`.
    Stated,
    /// The nearest link, by far.
    Nearest,
}

/// The points of a survey on the links of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    /// Per point of the survey: link (0: the foot, k: behind joint k) and how that was decided; none: not certain.
    pub links: Vec<Option<(usize, How)>>,
    /// Place of every point in the base frame, m.
    pub places: Vec<V3>,
    /// How it was decided, and what was left out.
    pub remarks: Vec<String>,
}

/// Decides; `robot` is the line of the robot at the pose of the survey.
///
/// # Errors
/// A link that the robot does not have, a survey whose place is not stated, fewer than [`FEWEST`] points on links.
pub fn assign(survey: &Survey, robot: &Skeleton) -> Outcome<Assignment> {
    let placement = &survey.placement;
    let origin = placement.origin.ok_or_else(unplaced)?;
    let points = &survey.geometry.points;
    let places: Vec<V3> = points
        .iter()
        .map(|point| add(origin, placement.turned(point.at)))
        .collect();
    let stated = |label: i64| placement.links.get(&label).map(|name| link(name, robot));
    let mut links = Vec::new();
    for (point, at) in points.iter().zip(&places) {
        links.push(match stated(point.label) {
            Some(found) => Some((found?, How::Stated)),
            None => nearest(*at, robot).map(|link| (link, How::Nearest)),
        });
    }
    unknown_labels(survey)?;
    let certain = links.iter().flatten().count();
    if certain < FEWEST {
        return Err(uncertain(certain, points.len()));
    }
    Ok(Assignment {
        remarks: remarks(survey, robot, &links),
        links,
        places,
    })
}

/// The link of this name: `foot`, or that behind the joint.
fn link(name: &str, robot: &Skeleton) -> Outcome<usize> {
    if name == "foot" {
        return Ok(0);
    }
    let found = robot.names.iter().position(|joint| joint == name);
    found.map(|i| i + 1).ok_or_else(|| {
        let known = robot.names.join(", ");
        Problem::new(
            format!("`{name}` is no link of the robot"),
            format!("write foot or the joint before the link: {known}"),
        )
        .in_column("links")
    })
}

/// Nodes that are named in `links` and not in the survey.
fn unknown_labels(survey: &Survey) -> Outcome<()> {
    let mut named = survey.placement.links.keys();
    match named.find(|label| survey.geometry.index(**label).is_none()) {
        None => Ok(()),
        Some(label) => Err(Problem::new(
            format!("node {label} is not in the survey"),
            "correct the number, or take it out",
        )
        .in_column("links")),
    }
}

/// The nearest link, if no other is nearly as near.
fn nearest(at: V3, robot: &Skeleton) -> Option<usize> {
    let mut found: Vec<(f64, usize)> = segments(robot)
        .into_iter()
        .map(|(link, from, to)| (distance(at, from, to), link))
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (least, link) = *found.first()?;
    let mut others = found.iter().filter(|other| other.1 != link);
    let clear = others.all(|other| other.0 >= CLEAR * least && other.0 > JOINT);
    (least <= FAR && clear).then_some(link)
}

/// Straight links: number, from, to; some are a point. The flange and the tool ride on the last one.
fn segments(robot: &Skeleton) -> Vec<(usize, V3, V3)> {
    let joints = robot.names.len();
    let pairs = robot.line.windows(2).enumerate();
    let all = pairs.map(|(k, pair)| (k.min(joints), pair[0], pair[1]));
    all.collect()
}

fn distance(at: V3, from: V3, to: V3) -> f64 {
    let along = sub(to, from);
    let share = dot(sub(at, from), along) / dot(along, along).max(f64::MIN_POSITIVE);
    norm(sub(at, add(from, scale(share.clamp(0.0, 1.0), along))))
}

fn unplaced() -> Problem {
    Problem::new(
        "how the survey lies to the robot is not stated",
        "write `survey_origin_mm = [0, 0, 0]` (its origin in the base frame; `survey_yaw_deg` where it is turned about z) into STEM.ident.toml beside the file",
    )
    .in_column("survey_origin_mm")
}

fn uncertain(certain: usize, of: usize) -> Problem {
    Problem::new(
        format!("on which link a point is was certain for {certain} of {of} points"),
        "state it: `links = { foot = [1, 2], A1 = [3, 4] }` in STEM.ident.toml; check survey_origin_mm and the joint angles",
    )
    .in_column("links")
}

fn remarks(survey: &Survey, robot: &Skeleton, links: &[Option<(usize, How)>]) -> Vec<String> {
    let count = |wanted: How| {
        links
            .iter()
            .flatten()
            .filter(|link| link.1 == wanted)
            .count()
    };
    let (stated, near) = (count(How::Stated), count(How::Nearest));
    let mut said = vec![format!(
        "links of the points: {stated} as stated, {near} by the nearest link of the drawn robot, {CLEAR:.0} times as near as any other"
    )];
    let name = |link: usize| match link {
        0 => "foot".to_string(),
        k => robot.names[k - 1].clone(),
    };
    let of = |link: usize| links.iter().flatten().filter(|one| one.0 == link).count();
    let told: Vec<String> = (0..=robot.names.len())
        .filter(|link| of(*link) > 0)
        .map(|link| format!("{} on {}", of(link), name(link)))
        .collect();
    said.push(told.join(", "));
    let lost = survey.geometry.points.iter().zip(links);
    let lost: Vec<String> = lost
        .filter(|(_, link)| link.is_none())
        .map(|(point, _)| point.label.to_string())
        .collect();
    if !lost.is_empty() {
        said.push(format!(
            "not certain for {} points, left out of the comparison: {} (state them in `links`)",
            lost.len(),
            lost.join(", ")
        ));
    }
    said
}
