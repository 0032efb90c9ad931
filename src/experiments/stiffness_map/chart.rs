//! The map as a figure.

use super::{Cell, StiffnessMap};
use crate::motion::skeleton::skeleton;
use crate::robot::Robot;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::significant;

/// Classes of a map.
const CLASSES: usize = 6;
const MICROMETRE: f64 = 1e-6;

impl StiffnessMap {
    /// A map of one quantity (N/m) with the robot in it.
    pub fn chart(
        &self,
        robot: &Robot,
        name: &str,
        title: &str,
        of: impl Fn(&Cell) -> f64,
    ) -> Chart {
        let [a, b] = self.asked.plane;
        let axis = |k: usize| Axis::new(["x", "y", "z"][k], "m");
        let values: Vec<f64> = self
            .cells
            .iter()
            .map(|cell| MICROMETRE * of(cell))
            .collect();
        let edges = edges(&values);
        let side = [self.asked.step; 2];
        let mut panel = Panel::new(axis(a), axis(b)).equal_axes();
        for pair in edges.windows(2) {
            let inside =
                |v: f64| v >= pair[0] && (v < pair[1] || pair[1] == edges[edges.len() - 1]);
            let cells = self.cells.iter().zip(&values).filter(|(_, v)| inside(**v));
            let places = cells.map(|(cell, _)| [cell.at[a], cell.at[b]]).collect();
            let name = format!("{} to {}", significant(pair[0], 2), significant(pair[1], 2));
            panel = panel.with(Series::cells(name, places, side));
        }
        let line = skeleton(robot, &self.asked.joints).line;
        let line: Vec<[f64; 2]> = line.iter().map(|p| [p[a], p[b]]).collect();
        let tool = line.last().copied().unwrap_or_default();
        panel = panel
            .with(Series::line("robot", line.clone()).emphasised())
            .with(Series::points("joints and tool", line))
            .named(tool, "tool")
            .noted("stiffness in N/µm");
        let caption = "Tool orientation and arm as drawn; blank: not reached so, inside the limits of the joints. Springs without gaps, bodies rigid.";
        Chart::new(name, title, caption).with(panel)
    }
}

/// Edges of classes with about as many cells in each, on round numbers.
fn edges(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len() - 1;
    let mut edges = vec![round(sorted[0], f64::floor)];
    for k in 1..CLASSES {
        edges.push(round(sorted[k * last / CLASSES], f64::round));
    }
    edges.push(round(sorted[last], f64::ceil));
    edges.dedup_by(|a, b| *a <= *b);
    if let [alone] = edges[..] {
        edges.push(1.1 * alone);
    }
    edges
}

/// Two digits.
fn round(value: f64, how: fn(f64) -> f64) -> f64 {
    let unit = 10f64.powf(value.abs().max(1e-12).log10().floor() - 1.0);
    how(value / unit) * unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_have_round_edges_that_rise() {
        let values: Vec<f64> = (0..100).map(|k| 0.123 + 0.01 * f64::from(k)).collect();
        let found = edges(&values);
        assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "{found:?}");
        assert!(found[0] <= 0.123 && found[found.len() - 1] >= 1.113);
        assert_eq!(edges(&[2.0]).len(), 2);
    }
}
