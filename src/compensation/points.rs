//! The points of a corrected path: so dense that chords between them follow it.

use super::correction::Correction;
use crate::ground::spatial::{V3, add, angle, cross, norm, scale, sub};
use crate::path::Quaternion;
use crate::planning::Plan;

/// Farthest points, m.
pub(super) const FAR: f64 = 1e-3;
/// Largest turn between chords over their length: what keeps them this near to the corrected path, m.
const FINE: f64 = 1e-6;
/// Largest turn of the feed from one place to the next, rad: a controller comes by once or twice in a rounded corner, and chords between
/// such places cut it. A blend of 2 mm turns so much within a tenth of a millimetre.
const TURN: f64 = 0.04;

/// A point.
pub(super) struct Point {
    /// Arc length of the programmed path, m.
    pub s: f64,
    /// Tip, corrected, m, workpiece frame.
    pub place: V3,
    /// Tool frame in the workpiece frame.
    pub orientation: Quaternion,
}

/// Of the places of a plan those whose chords follow the corrected path.
pub(super) fn points(plan: &Plan, correction: &Correction) -> Vec<Point> {
    let mut chosen: Vec<Point> = Vec::new();
    let mut all = places(plan, correction).into_iter().peekable();
    while let Some(point) = all.next() {
        let (Some(last), next) = (chosen.last(), all.peek()) else {
            chosen.push(point);
            continue;
        };
        let way = point.s - last.s;
        let is_far = way >= FAR * (1.0 - 1e-9);
        let bends = next.is_none_or(|next| bends([last.place, point.place, next.place]));
        if way > 1e-6 && (is_far || bends) {
            chosen.push(point);
        }
    }
    chosen
}

/// Whether the third place leaves the line through the others.
fn bends([a, b, c]: [V3; 3]) -> bool {
    let (ab, bc) = (sub(b, a), sub(c, b));
    norm(cross(ab, bc)) > FINE * norm(add(ab, bc)).max(1e-9)
}

/// Where the controller comes by, and between, where the path bends.
fn places(plan: &Plan, correction: &Correction) -> Vec<Point> {
    let at = |s: f64, point: V3, orientation: Quaternion| Point {
        s,
        place: add(point, correction.at(s)),
        orientation,
    };
    let mut all: Vec<Point> = Vec::new();
    for row in &plan.rows {
        if let Some(last) = all.last() {
            let (from, begin) = (last.orientation, last.s);
            let turn = from.way_to(row.orientation);
            let shares = shares(plan, begin, row.s);
            all.extend(shares.map(|share| {
                let s = begin + share * (row.s - begin);
                at(s, plan.path.point(s), from.turned(scale(share, turn)))
            }));
        }
        all.push(at(row.s, row.point, row.orientation));
    }
    all
}

/// Shares of the way between two arc lengths at which the feed has turned by so much.
fn shares(plan: &Plan, begin: f64, end: f64) -> impl Iterator<Item = f64> {
    let [a, b, c] = [0.0, 0.5, 1.0].map(|u| plan.path.direction(begin + u * (end - begin)));
    let count = ((angle(a, b) + angle(b, c)) / TURN).ceil();
    (1..count as usize).map(move |k| k as f64 / count)
}
