//! What causes do to the places of a robot.

use super::contract::Amount;
use super::turns::axes;
use crate::ground::spatial::{IDENTITY, M3, V3, add, dot, norm, normals, scale, sub};
use crate::robot::model::ElasticAxis;
use crate::robot::{Robot, Spring};

/// What is reported of a cause: name, value SI, unit.
pub type Said = Vec<(&'static str, f64, &'static str)>;

/// An added compliance of one is one radian per 10⁷ N·m, that of a stout bearing.
pub const UNIT_COMPLIANCE: f64 = 1e-7;
/// Damping of an added spring, of its stiffness, s: as light as that of the bearings of Table 3.1.
pub const ADDED_DAMPING: f64 = 4e-4;

/// Name of the relative excess of a compliance.
pub const EXCESS: &str = "excess";
/// Its least: no spring is ten times as stiff as it is stated.
pub const LEAST_EXCESS: f64 = -0.9;
/// Its largest start: the unit in which it is fitted where it is one of many causes.
pub const LARGEST_START: f64 = 2.0;

/// The relative excess x of a compliance: c = c₀(1 + x).
pub const fn excess(meaning: &'static str) -> Amount {
    Amount::new(
        EXCESS,
        "1",
        meaning,
        [LEAST_EXCESS, 20.0],
        &[-0.6, -0.3, 0.5, LARGEST_START],
    )
}

/// An added compliance in units of [`UNIT_COMPLIANCE`].
pub const fn added(name: &'static str, meaning: &'static str) -> Amount {
    Amount::new(
        name,
        "1e-7 rad/(N·m)",
        meaning,
        [0.0, 100.0],
        &[0.3, 1.0, 4.0],
    )
}

/// Makes the spring of `site` softer by the relative excess of its compliance.
pub fn soften(robot: &mut Robot, site: &str, excess: f64) {
    if let Some((_, spring)) = robot.springs_mut().find(|(name, _)| name == site) {
        spring.stiffness /= (1.0 + excess).max(1e-3);
    }
}

/// The stiffness of `site` with that excess.
pub fn softened(robot: &Robot, site: &str, excess: f64) -> Said {
    let own = robot.springs().find(|(name, _)| name == site);
    let value = own.map(|(_, spring)| spring.stiffness / (1.0 + excess).max(1e-3));
    value
        .map(|k| ("stiffness", k, "N·m/rad"))
        .into_iter()
        .collect()
}

/// A spring of that many [`UNIT_COMPLIANCE`]; none for none.
pub fn added_spring(amount: f64) -> Option<Spring> {
    let stiffness = 1.0 / (amount * UNIT_COMPLIANCE);
    (amount > 1e-9).then(|| Spring::new(stiffness, ADDED_DAMPING * stiffness))
}

/// The stiffness of an added compliance.
pub fn said_added(name: &'static str, amount: f64) -> Said {
    let spring = added_spring(amount);
    spring
        .map(|s| (name, s.stiffness, "N·m/rad"))
        .into_iter()
        .collect()
}

/// The joints whose drive is elastic.
pub fn drives(robot: &Robot) -> Vec<String> {
    let elastic = robot.joints.iter().filter(|joint| joint.drive.is_some());
    elastic.map(|joint| joint.name.clone()).collect()
}

/// Compliance of the drive of joint `i` (from 1), else of its bearing, in units of
/// [`UNIT_COMPLIANCE`]: the measure for what is added near it.
pub fn drive_compliance(robot: &Robot, i: usize) -> f64 {
    let joint = robot.joints.get(i.wrapping_sub(1));
    let spring = joint.and_then(|joint| joint.drive.as_ref().or(joint.tilt.as_ref()));
    spring.map_or(1.0, |s| 1.0 / (s.stiffness * UNIT_COMPLIANCE))
}

/// Both ends of link `i` (from 1): the bearing of its joint and where the next one sits. A bearing along the link may
/// sit anywhere on it, and the point that a file gives for it says no more than its line: that link reaches to the joint
/// behind.
pub fn ends(robot: &Robot, i: usize) -> Option<[V3; 2]> {
    let own = robot.joints.get(i.checked_sub(1)?)?.point;
    let next = robot.joints.get(i)?;
    let far = robot.joints.get(i + 1).map(|joint| joint.point);
    let far = far.filter(|far| {
        let reach = sub(*far, own);
        dot(reach, next.axis).abs() > ALONG * norm(reach)
    });
    Some([own, far.unwrap_or(next.point)])
}

/// Cosine above which an axis runs along a link.
const ALONG: f64 = 0.95;

/// The number in a site as `link2`.
pub fn number_in(site: &str, stem: &str) -> Option<usize> {
    site.strip_prefix(stem)?.parse().ok()
}

/// Adds elastic axes through `point` (base axes, every joint at zero), behind the body that joint `after` moves, with
/// compliances about x, y and z and, where six are given, those that two axes share ([`turns`](super::turns)).
pub fn add_axes(robot: &mut Robot, site: &str, after: usize, point: V3, amounts: &[f64]) {
    add_axes_along(robot, site, (after, point), &IDENTITY, amounts);
}

/// [`add_axes`] about the columns of `frame` instead of x, y and z.
pub fn add_axes_along(
    robot: &mut Robot,
    site: &str,
    (after, point): (usize, V3),
    frame: &M3,
    amounts: &[f64],
) {
    for (k, (own, amount)) in axes(amounts).into_iter().enumerate() {
        let Some(spring) = added_spring(amount) else {
            continue;
        };
        let name = free_name(robot, &format!("{site}-{}", ["x", "y", "z"][k]));
        robot.elastic.push(ElasticAxis {
            name,
            after,
            axis: frame.map(|row| dot(row, own)),
            point,
            spring,
            body: None,
        });
    }
}

/// Adds a shift along a unit vector by a spring (N/m, N·s/m), behind the body that joint `after` moves, of points near `point`: a turn
/// about an axis across it, `far` away (m): a robot file knows turns only.
pub fn add_shift(
    robot: &mut Robot,
    name: &str,
    (after, point, far): (usize, V3, f64),
    (along, mut spring): (V3, Spring),
) {
    let (axis, across) = normals(along);
    spring.stiffness *= far * far;
    spring.damping *= far * far;
    robot.elastic.push(ElasticAxis {
        name: name.to_string(),
        after,
        axis,
        point: add(point, scale(far, across)),
        spring,
        body: None,
    });
}

/// The name, with a number behind it if the robot has such an axis already.
fn free_name(robot: &Robot, name: &str) -> String {
    let taken = |name: &str| robot.elastic.iter().any(|axis| axis.name == name);
    let numbered = (2..).map(|n| format!("{name}{n}"));
    let mut names = std::iter::once(name.to_string()).chain(numbered);
    names.find(|n| !taken(n)).unwrap_or_else(|| name.into())
}
