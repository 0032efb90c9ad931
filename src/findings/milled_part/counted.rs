//! What a file counts along the path: the drawn one with its blends, or from point to point as they were programmed. Every blend is a
//! little shorter than its corner.

use super::stations::NEAR;
use crate::ground::spatial::V3;
use crate::measurement::milled_part::{At, PartTest};
use crate::measurement::toolpath::{Shape, Toolpath};
use crate::path::Curve;
use crate::process::Way;
use crate::process::way::nearest;

/// One point: its length from point to point and where the drawn path is nearest to it, m, and the way to it from the one before.
#[derive(Debug, Clone, PartialEq)]
struct Point {
    told: f64,
    drawn: f64,
    leg: Option<Curve>,
}

/// Every point of a file that counts from point to point, beside the drawn path; none: the drawn path is counted.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Counted(Vec<Point>);

impl Counted {
    /// How a file usually counts, and how it may as well: the drawn path, and from point to point where that is another length and the file reaches
    /// no farther. What goes beyond the end of the drawn path counts from point to point, if that is long enough.
    pub fn ways(test: &PartTest, toolpath: &Toolpath, way: &Way) -> (Self, Option<Self>) {
        let along = test.readings.iter().filter_map(|reading| match reading.at {
            At::Along(s) => Some(s),
            At::Place(_) => None,
        });
        let Some(farthest) = along.reduce(f64::max) else {
            return (Self::default(), None);
        };
        let points = points(toolpath, way);
        let last = points.last().map_or(0.0, |last| last.told);
        let drawn = way.rows().last().map_or(0.0, |row| row.s_m);
        let [reaches, is_other] = [farthest <= last + NEAR, (last - drawn).abs() > NEAR];
        match (farthest <= drawn + NEAR, reaches && is_other) {
            (_, false) => (Self::default(), None),
            (true, true) => (Self::default(), Some(Self(points))),
            (false, true) => (Self(points), None),
        }
    }

    /// Whether it counts from point to point.
    pub fn is_by_points(&self) -> bool {
        !self.0.is_empty()
    }

    /// Length along the drawn path, m: where that is nearest to the place on the way from point to point.
    pub fn drawn(&self, told_m: f64, way: &Way) -> f64 {
        let after = self.0.partition_point(|point| point.told < told_m);
        let ends = (self.0.get(after.wrapping_sub(1)), self.0.get(after));
        let (Some(a), Some(b)) = ends else {
            let last = self.0.last().filter(|last| told_m > last.told);
            return last.map_or(told_m, |last| last.drawn);
        };
        let share = (told_m - a.told) / (b.told - a.told);
        let about = a.drawn + share * (b.drawn - a.drawn);
        let shorter = (b.told - a.told) - (b.drawn - a.drawn);
        let near = shorter.abs() + NEAR;
        let place = b.leg.as_ref().map(|leg| leg.point(told_m - a.told));
        place
            .and_then(|place| pass(way, [about - near, about + near], place))
            .unwrap_or(about)
    }
}

/// Every point of a path.
fn points(toolpath: &Toolpath, way: &Way) -> Vec<Point> {
    let start = toolpath.moves.first().map(|_| Point {
        told: 0.0,
        drawn: 0.0,
        leg: None,
    });
    let mut points: Vec<Point> = start.into_iter().collect();
    for ends in toolpath.moves.windows(2) {
        let [from, to] = [&ends[0], &ends[1]].map(|step| step.to);
        let leg = match &ends[1].shape {
            Shape::Line => Curve::line(from, to),
            Shape::Arc(arc) => Curve::arc(from, to, arc),
        };
        let before = &points[points.len() - 1];
        let length = leg.as_ref().map_or(0.0, Curve::length);
        // a blend is no longer than the corner that it cuts
        let within = [0.5 * length, length + NEAR].map(|s| before.drawn + s);
        points.push(Point {
            told: before.told + length,
            drawn: pass(way, within, to).unwrap_or(before.drawn + length),
            leg,
        });
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
