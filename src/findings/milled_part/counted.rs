//! What a file counts along the path: the drawn one with its blends, or from point to point as they were programmed. Every blend is a
//! little shorter than its corner.

use super::stations::NEAR;
use crate::ground::spatial::{norm, sub};
use crate::measurement::milled_part::{At, PartTest};
use crate::measurement::toolpath::{Shape, Toolpath};
use crate::process::Way;

/// Lengths from point to point at every point, and those of the drawn path where it passes it, m; none: the drawn path is counted.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Counted(Vec<[f64; 2]>);

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
        let reaches = points.last().is_some_and(|last| farthest <= last[0] + NEAR);
        Self(if reaches { points } else { Vec::new() })
    }

    /// Whether it counts from point to point.
    pub fn is_by_points(&self) -> bool {
        !self.0.is_empty()
    }

    /// Length along the drawn path, m.
    pub fn drawn(&self, s_m: f64) -> f64 {
        let after = self.0.partition_point(|point| point[0] < s_m);
        let (Some(a), Some(b)) = (self.0.get(after.saturating_sub(1)), self.0.get(after)) else {
            return self.0.last().map_or(s_m, |last| last[1]);
        };
        match b[0] > a[0] {
            true => a[1] + (s_m - a[0]) / (b[0] - a[0]) * (b[1] - a[1]),
            false => b[1],
        }
    }
}

/// Every point: its length from point to point, and where the drawn path is nearest to it.
fn points(toolpath: &Toolpath, way: &Way) -> Vec<[f64; 2]> {
    let rows = way.rows();
    let mut points = vec![[0.0; 2]];
    for ends in toolpath.moves.windows(2) {
        let [before, drawn] = points[points.len() - 1];
        let length = norm(sub(ends[1].to, ends[0].to));
        let [from, to] = [drawn + 0.5 * length, before + length + NEAR]
            .map(|s| rows.partition_point(|row| row.s_m < s));
        let far = |row: &&crate::process::way::Row| norm(sub(row.tip, ends[1].to));
        let own = rows[from.min(to)..to].iter();
        let nearest = own.min_by(|a, b| far(a).total_cmp(&far(b)));
        points.push([
            before + length,
            nearest.map_or(drawn + length, |row| row.s_m),
        ]);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::Counted;

    #[test]
    fn lengths_lie_between_those_of_the_points() {
        let counted = Counted(vec![[0.0, 0.0], [10.0, 9.5], [20.0, 19.0]]);
        let told = [0.0, 5.0, 10.0, 15.0, 20.0].map(|s| counted.drawn(s));
        assert_eq!(told, [0.0, 4.75, 9.5, 14.25, 19.0]);
        assert_eq!(Counted::default().drawn(12.5), 12.5);
    }
}
