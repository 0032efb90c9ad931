//! The points of a survey and the wires between them.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::ground::stats::largest;
use crate::measurement::front::Front;
use crate::measurement::uff::{Node, Trace, UniversalFile};
use std::collections::BTreeMap;

/// A point of the survey.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Its label in the file.
    pub label: i64,
    /// Where it is, m, axes of the survey.
    pub at: V3,
}

/// Points and wires.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Geometry {
    /// The points, by label.
    pub points: Vec<Point>,
    /// Lines from point to point, by their places in `points`.
    pub wires: Vec<Vec<usize>>,
    /// What a reader should know of it.
    pub remarks: Vec<String>,
}

/// Units that `geometry_unit` may name: m per unit.
const UNITS: &[(&str, f64)] = &[("m", 1.0), ("mm", 1e-3), ("cm", 1e-2), ("in", 0.0254)];
/// No robot, and nothing that is hit with a hammer in its laboratory, is as large, m.
const LARGEST: f64 = 200.0;
/// Distance from which one label stands for two places, as a share of the coordinates.
const SAME: f64 = 1e-6;

/// The unit of the places that stands beside the file, m.
///
/// # Errors
/// A unit that is not known.
pub fn stated_unit(front: &Front) -> Outcome<Option<f64>> {
    let Some(unit) = front.text("geometry_unit")? else {
        return Ok(None);
    };
    let row = UNITS.iter().find(|row| row.0 == unit);
    row.map(|row| Some(row.1)).ok_or_else(|| {
        front.problem(
            "geometry_unit",
            format!("is `{unit}`, no unit known here"),
            "write m, mm, cm or in",
        )
    })
}

impl Geometry {
    /// The geometry in a universal file; `stated` goes before its data set 164.
    ///
    /// # Errors
    /// No nodes, one label at two places, a wire to nowhere, directions in several systems.
    pub fn of(file: &UniversalFile, stated: Option<f64>) -> Outcome<Self> {
        let unit = stated.or(file.units.as_ref().map(|units| 1.0 / units.factors[0]));
        let nodes = distinct(&file.nodes)?;
        one_system(&nodes)?;
        let at = |node: &Node| node.position.map(|x| x * unit.unwrap_or(1.0));
        let points: Vec<Point> = nodes
            .values()
            .map(|node| Point {
                label: node.label,
                at: at(node),
            })
            .collect();
        let mut geometry = Self {
            points,
            ..Self::default()
        };
        geometry.check_size(unit.is_some())?;
        for trace in &file.traces {
            let wires = geometry.wires_of(trace)?;
            geometry.wires.extend(wires);
        }
        if geometry.wires.is_empty() {
            let remark = "no trace lines (data set 82): the points are drawn without wires";
            geometry.remarks.push(remark.into());
        }
        Ok(geometry)
    }

    /// The place of a label in `points`.
    pub fn index(&self, label: i64) -> Option<usize> {
        self.points
            .binary_search_by_key(&label, |point| point.label)
            .ok()
    }

    /// Extents along the axes, m.
    pub fn extents(&self) -> V3 {
        std::array::from_fn(|k| {
            let along = || self.points.iter().map(|point| point.at[k]);
            along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
        })
    }

    /// Greatest extent along an axis, m.
    pub fn size(&self) -> f64 {
        self.extents().into_iter().fold(0.0, f64::max)
    }

    fn check_size(&mut self, known: bool) -> Outcome<()> {
        let size = self.size();
        if size > LARGEST {
            let what = format!("the points span {size:.0} m");
            let remedy =
                "write `geometry_unit = \"mm\"` into STEM.ident.toml if the places are in mm";
            return Err(Problem::new(what, remedy));
        }
        if size <= 0.0 {
            let remedy = "export the places of the nodes (data set 15 or 2411)";
            return Err(Problem::new("all points are at one place", remedy));
        }
        if !known {
            let remark = format!(
                "the unit of the places is not stated (data set 164): taken as m, the points span {size:.2} m"
            );
            self.remarks.push(remark);
        }
        Ok(())
    }

    /// The wires of a trace line: a label 0 lifts the pen.
    fn wires_of(&self, trace: &Trace) -> Outcome<Vec<Vec<usize>>> {
        let place = |label: &i64| {
            self.index(*label).ok_or_else(|| {
                let what = format!(
                    "trace line {} runs to node {label}, which is not there",
                    trace.number
                );
                let remedy = "export all nodes of the geometry (data set 15 or 2411)";
                Problem::new(what, remedy).at_line(trace.line)
            })
        };
        let runs = trace.nodes.split(|label| *label == 0);
        let runs = runs.filter(|run| !run.is_empty());
        runs.map(|run| run.iter().map(place).collect()).collect()
    }
}

/// Nodes by label: one that stands there twice must stand at one place.
fn distinct(nodes: &[Node]) -> Outcome<BTreeMap<i64, &Node>> {
    let mut found: BTreeMap<i64, &Node> = BTreeMap::new();
    for node in nodes {
        let Some(first) = found.insert(node.label, node) else {
            continue;
        };
        let size = largest(&node.position);
        let apart = |k: usize| (node.position[k] - first.position[k]).abs() > SAME * size;
        if (0..3).any(apart) {
            let what = format!(
                "node {} is at another place than on line {}",
                node.label, first.line
            );
            let remedy = "export every node once, or number the points of the survey anew";
            return Err(Problem::new(what, remedy).at_line(node.line));
        }
    }
    match found.is_empty() {
        false => Ok(found),
        true => Err(Problem::new(
            "no places of nodes in the file",
            "export the geometry with it (data set 15 or 2411), or name a file that holds it: --geometry FILE",
        )),
    }
}

/// Directions count from one system of axes.
fn one_system(nodes: &BTreeMap<i64, &Node>) -> Outcome<()> {
    let mut all = nodes.values();
    let Some(first) = all.next() else {
        return Ok(());
    };
    let other = all.find(|node| node.systems[..2] != first.systems[..2]);
    let Some(other) = other else { return Ok(()) };
    let what = format!(
        "nodes {} and {} have places or directions in different coordinate systems",
        first.label, other.label
    );
    let remedy = "export places and directions of all nodes in the global system";
    Err(Problem::new(what, remedy).at_line(other.line))
}
