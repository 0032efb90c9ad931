//! What a file counts along the path: the drawn one with its blends, or from point to point as they were programmed. Every blend is a
//! little shorter than its corner.

use super::stations::NEAR;
use crate::ground::spatial::{V3, add, norm, scale, sub};
use crate::measurement::milled_part::{At, PartTest};
use crate::measurement::toolpath::{Shape, Toolpath};
use crate::process::Way;
use crate::process::way::nearest;

/// One point: its length from point to point and where the drawn path is nearest to it, m, and its place, workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Point {
    told: f64,
    drawn: f64,
    place: V3,
}

/// Every point of a file that counts from point to point, beside the drawn path; none: the drawn path is counted.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Counted(Vec<Point>);

impl Counted {
    /// How a file counts: it goes beyond the end of the drawn path, and not beyond the last point, only if it counts from point to point.
    pub fn of(test: &PartTest, toolpath: &Toolpath, way: &Way) -> Self {
        let along = test.readings.iter().map(|reading| match reading.at {
            At::Along(s) => s,
            At::Place(_) => 0.0,
        });
        let farthest = along.fold(0.0, f64::max);
        let drawn = way.rows().last().map_or(0.0, |row| row.s_m);
        let straight = toolpath.moves.iter().all(|step| step.shape == Shape::Line);
        if farthest <= drawn + NEAR || !straight {
            return Self::default();
        }
        let points = points(toolpath, way);
        let reaches = points
            .last()
            .is_some_and(|last| farthest <= last.told + NEAR);
        Self(if reaches { points } else { Vec::new() })
    }

    /// Whether it counts from point to point.
    pub fn is_by_points(&self) -> bool {
        !self.0.is_empty()
    }

    /// Length along the drawn path, m: where that is nearest to the place on the straight line from point to point.
    pub fn drawn(&self, told_m: f64, way: &Way) -> f64 {
        let after = self.0.partition_point(|point| point.told < told_m);
        let ends = (self.0.get(after.wrapping_sub(1)), self.0.get(after));
        let (Some(a), Some(b)) = ends else {
            let last = self.0.last().filter(|last| told_m > last.told);
            return last.map_or(told_m, |last| last.drawn);
        };
        let share = (told_m - a.told) / (b.told - a.told);
        let place = add(a.place, scale(share, sub(b.place, a.place)));
        let about = a.drawn + share * (b.drawn - a.drawn);
        let shorter = (b.told - a.told) - (b.drawn - a.drawn);
        let near = shorter.abs() + NEAR;
        pass(way, [about - near, about + near], place).unwrap_or(about)
    }
}

/// Every point of a path.
fn points(toolpath: &Toolpath, way: &Way) -> Vec<Point> {
    let places = toolpath.moves.iter().map(|step| step.to);
    let mut points: Vec<Point> = Vec::new();
    for place in places {
        let next = match points.last() {
            None => Point {
                told: 0.0,
                drawn: 0.0,
                place,
            },
            Some(before) => {
                let length = norm(sub(place, before.place));
                // a blend is no longer than the corner that it cuts
                let within = [0.5 * length, length + NEAR].map(|s| before.drawn + s);
                Point {
                    told: before.told + length,
                    drawn: pass(way, within, place).unwrap_or(before.drawn + length),
                    place,
                }
            }
        };
        points.push(next);
    }
    points
}

/// Where the drawn path, within some of its length (m), is nearest to a place; none where it has no such piece.
fn pass(way: &Way, within: [f64; 2], place: V3) -> Option<f64> {
    let rows = way.rows();
    let [from, to] = within.map(|s| rows.partition_point(|row| row.s_m < s));
    let pieces = rows[from.saturating_sub(1)..(to + 1).min(rows.len())].windows(2);
    let passes = pieces.map(|piece| {
        let (share, far) = nearest([&piece[0], &piece[1]], place);
        (piece[0].s_m + share * (piece[1].s_m - piece[0].s_m), far)
    });
    passes.min_by(|a, b| a.1.total_cmp(&b.1)).map(|pass| pass.0)
}
