//! What the robot cannot do: speeds, ranges, singularities.

use super::adapt::{acceleration, speed};
use super::cell::{Cell, JOINTS};
use super::plan::Row;
use crate::ground::units::DEGREE;

/// A limit that is exceeded, at its worst.
#[derive(Debug, Clone, PartialEq)]
pub struct Exceeded {
    /// `joint-speed`, `joint-acceleration`, `joint-angle`, `reach` or `singularity`.
    pub what: &'static str,
    /// Joint, or `wrist`, `elbow`, `shoulder`, `arm`.
    pub site: String,
    /// When, s.
    pub at: f64,
    /// Line of the path file.
    pub line: usize,
    /// How much: deg/s, deg/s², deg, m; for a singularity the angle from it, deg.
    pub value: f64,
    /// What is allowed, in the same unit.
    pub limit: f64,
}

/// How one joint is used.
#[derive(Debug, Clone, PartialEq)]
pub struct JointUse {
    /// Its name.
    pub site: String,
    /// Least and largest angle, rad.
    pub range: [f64; 2],
    /// Limits of the angle, rad.
    pub limits: [f64; 2],
    /// Largest speed, rad/s: difference of rows over the cycle.
    pub max_speed: f64,
    /// Highest speed allowed, rad/s.
    pub speed_limit: Option<f64>,
    /// Row of the largest speed.
    pub fastest: usize,
    /// Largest acceleration, rad/s²: second difference of rows over the square of the cycle.
    pub max_acceleration: f64,
    /// Highest acceleration allowed, rad/s².
    pub acceleration_limit: Option<f64>,
    /// Row of the largest acceleration.
    pub hardest: usize,
}

/// Share of a limit beyond which it counts as exceeded: rounding.
const SLACK: f64 = 1e-6;
/// A5 nearer to its singularity than this while a joint is too fast: the singularity is the reason, rad.
const NEAR: f64 = 3.0 * DEGREE;

/// How every joint is used.
pub fn uses(cell: &Cell, rows: &[Row], cycle: f64) -> Vec<JointUse> {
    let joints = cell.robot.joints.iter().enumerate();
    let one = |(i, joint): (usize, &crate::robot::Joint)| {
        let angles = || rows.iter().map(|row| row.q[i]);
        let speeds = rows.windows(2).map(|pair| speed(pair, i, cycle));
        let (fastest, max_speed) = largest(speeds);
        let accelerations = rows.windows(3).map(|rows| acceleration(rows, i, cycle));
        let (hardest, max_acceleration) = largest(accelerations.map(f64::abs));
        JointUse {
            site: joint.name.clone(),
            range: [
                angles().fold(f64::INFINITY, f64::min),
                angles().fold(f64::NEG_INFINITY, f64::max),
            ],
            limits: joint.limits,
            max_speed,
            speed_limit: joint.max_speed,
            fastest,
            max_acceleration,
            acceleration_limit: joint.max_acceleration,
            hardest: hardest + usize::from(rows.len() > 2),
        }
    };
    joints.map(one).collect()
}

/// The first of the largest values, and where it stands.
fn largest(values: impl Iterator<Item = f64>) -> (usize, f64) {
    let all = values.enumerate();
    let found = all.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
    found.unwrap_or((0, 0.0))
}

/// The worst of every kind and site, in the order speeds, accelerations, angles, singularities.
pub fn exceeded(
    cell: &Cell,
    rows: &[Row],
    uses: &[JointUse],
    line: impl Fn(f64) -> usize,
) -> Vec<Exceeded> {
    let beyond_limit = |own: &JointUse, what: &'static str| {
        let (value, limit, row) = match what {
            "joint-speed" => (own.max_speed, own.speed_limit?, &rows[own.fastest]),
            _ => (
                own.max_acceleration,
                own.acceleration_limit?,
                &rows[own.hardest],
            ),
        };
        (value > limit * (1.0 + SLACK)).then(|| Exceeded {
            what,
            site: own.site.clone(),
            at: row.t,
            line: line(row.s),
            value: value / DEGREE,
            limit: limit / DEGREE,
        })
    };
    let mut all = Vec::new();
    for what in ["joint-speed", "joint-acceleration"] {
        all.extend(uses.iter().filter_map(|own| beyond_limit(own, what)));
    }
    for (i, own) in uses.iter().enumerate() {
        all.extend(beyond(rows, i, own, &line));
    }
    all.extend(singular(cell, rows, uses, &line));
    all
}

fn beyond(
    rows: &[Row],
    i: usize,
    own: &JointUse,
    line: &impl Fn(f64) -> usize,
) -> Option<Exceeded> {
    let [low, high] = own.limits;
    let over = |row: &Row| (low - row.q[i]).max(row.q[i] - high);
    let worst = rows.iter().max_by(|a, b| over(a).total_cmp(&over(b)))?;
    (over(worst) > 1e-9).then(|| Exceeded {
        what: "joint-angle",
        site: own.site.clone(),
        at: worst.t,
        line: line(worst.s),
        value: worst.q[i] / DEGREE,
        limit: if worst.q[i] > high { high } else { low } / DEGREE,
    })
}

/// A wrist near its singularity while a joint of it is too fast.
fn singular(
    cell: &Cell,
    rows: &[Row],
    uses: &[JointUse],
    line: &impl Fn(f64) -> usize,
) -> Option<Exceeded> {
    cell.wrist.as_ref()?;
    let too_fast = uses
        .iter()
        .filter(|own| own.max_speed > own.speed_limit.unwrap_or(f64::INFINITY) * (1.0 + SLACK));
    let from_line = |row: &Row| straightness(cell, &row.q);
    let rows = too_fast.map(|own| &rows[own.fastest]);
    let worst = rows.min_by(|a, b| from_line(a).total_cmp(&from_line(b)))?;
    (from_line(worst) < NEAR).then(|| Exceeded {
        what: "singularity",
        site: "wrist".into(),
        at: worst.t,
        line: line(worst.s),
        value: from_line(worst) / DEGREE,
        limit: NEAR / DEGREE,
    })
}

/// Angle between A4 and A6, rad: zero in the wrist's singularity.
pub fn straightness(cell: &Cell, q: &[f64; JOINTS]) -> f64 {
    use crate::ground::spatial::{cross, dot, norm, rotate, rotation};
    let axis = |i: usize| cell.robot.joints[i].axis;
    let turned = rotate(&rotation(axis(4), q[4]), axis(5));
    let (across, along) = (norm(cross(axis(3), turned)), dot(axis(3), turned));
    across.atan2(along.abs())
}

/// Times (s) and places (arc length, m) at which A5 passes through the wrist's singularity.
pub fn passages(cell: &Cell, rows: &[Row]) -> Vec<[f64; 2]> {
    if cell.wrist.is_none() {
        return Vec::new();
    }
    let side = |row: &Row| {
        use crate::ground::spatial::{cross, dot, rotate, rotation};
        let axis = |i: usize| cell.robot.joints[i].axis;
        let turned = rotate(&rotation(axis(4), row.q[4]), axis(5));
        dot(axis(4), cross(axis(3), turned))
    };
    let sides: Vec<f64> = rows.iter().map(side).collect();
    let crossing = |k: &usize| sides[*k - 1] * sides[*k] < 0.0 || sides[*k] == 0.0;
    let passed = (1..rows.len()).filter(crossing);
    passed.map(|k| [rows[k].t, rows[k].s]).collect()
}
