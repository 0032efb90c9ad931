//! Cells of a map: rectangles in the colour of their class.

use super::canvas::{Frame, layer};
use super::style::Look;
use crate::ground::problem::Outcome;
use crate::sheet::chart::Series;
use plotters::element::Rectangle;
use plotters::style::Color;

/// Inks the cells of a series; neighbours along x become one rectangle.
pub(super) fn ink(series: &Series, frame: &Frame, look: &Look) -> Outcome<String> {
    let [wide, tall] = series.cell.map(|side| 0.5 * side);
    // Neighbouring rows would show a hair of paper between them.
    layer(frame, " shape-rendering=\"crispEdges\"", |area| {
        for [from, to, y] in rows(&series.points, series.cell[0]) {
            let corners = [(from - wide, y - tall), (to + wide, y + tall)];
            area.draw(&Rectangle::new(corners, look.color.filled()))?;
        }
        Ok(())
    })
}

/// First and last centre along x, and y, of runs of neighbours.
fn rows(points: &[[f64; 2]], wide: f64) -> Vec<[f64; 3]> {
    let mut runs: Vec<[f64; 3]> = Vec::new();
    for [x, y] in points
        .iter()
        .filter(|p| p[0].is_finite() && p[1].is_finite())
    {
        match runs.last_mut() {
            Some(run) if run[2] == *y && (x - run[1] - wide).abs() < 1e-6 * wide => run[1] = *x,
            _ => runs.push([*x, *x, *y]),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_become_one() {
        let points = [
            [0.0, 0.0],
            [1.0, 0.0],
            [3.0, 0.0],
            [3.0, 1.0],
            [f64::NAN, 1.0],
        ];
        let found = rows(&points, 1.0);
        assert_eq!(found, [[0.0, 1.0, 0.0], [3.0, 3.0, 0.0], [3.0, 3.0, 1.0]]);
    }
}
