//! A survey of many points: the frequency responses of a universal file with the places of its nodes and the
//! wires between them (data sets 15, 2411, 82), beside them or in a file of geometry.

mod geometry;
mod placement;

pub use geometry::{Geometry, Point};
pub use placement::Placement;

use super::foreign::sidecar::place as sidecar;
use super::frf_uff::{self, Given, GivenPair, Place};
use super::hammer::HammerRecord;
use super::uff;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A survey, SI.
#[derive(Debug, Clone)]
pub struct Survey {
    /// Points and wires.
    pub geometry: Geometry,
    /// Point and axis (0, 1, 2: x, y, z) of every response.
    pub dofs: Vec<(usize, usize)>,
    /// Names of the references that did not move from point to point.
    pub references: Vec<String>,
    /// The responses as a hammer test; its outputs are `dofs`.
    pub record: HammerRecord,
    /// How it lies to a robot.
    pub placement: Placement,
    /// What a reader should know of the reading.
    pub remarks: Vec<String>,
    /// The files with their hashes.
    pub inputs: Vec<(PathBuf, String)>,
}

/// Reads a survey, its geometry from `geometry` where that is given.
///
/// # Errors
/// No responses, no places, or what contradicts itself, with file, line and remedy.
pub fn read(path: &Path, geometry: Option<&Path>) -> Outcome<Survey> {
    let file = uff::read(path)?;
    let front = frf_uff::front(path).map_err(|problem| problem.in_file(&sidecar(path)))?;
    let beside = |problem: Problem| problem.in_file(&sidecar(path));
    let stated = geometry::stated_unit(&front).map_err(beside)?;
    let placement = Placement::read(&front).map_err(beside)?;
    let drawn = match geometry {
        None => Geometry::of(&file, stated).map_err(|p| p.in_text(path))?,
        Some(other) => {
            let drawn = uff::read(other)?;
            Geometry::of(&drawn, stated).map_err(|p| p.in_text(other))?
        }
    };
    if !frf_uff::has_responses(&file) {
        return Err(no_responses().in_file(path));
    }
    let mut record = frf_uff::record(&file, &front).map_err(|p| p.in_text(path))?;
    let given = record.given.take().unwrap_or_default();
    let (given, outputs, mut remarks) = roving_last(given, record.outputs.clone());
    let dofs = dofs(&given.responses, &drawn).map_err(|p| p.in_file(path))?;
    remarks.extend(drawn.remarks.iter().cloned());
    remarks.extend(given.remarks.iter().cloned());
    let references = given.inputs.clone();
    let mut inputs = vec![(path.to_path_buf(), files::sha256(&files::read_bytes(path)?))];
    if let Some(other) = geometry {
        inputs.push((other.into(), files::sha256(&files::read_bytes(other)?)));
    }
    Ok(Survey {
        geometry: drawn,
        dofs,
        references,
        record: HammerRecord {
            outputs,
            given: Some(given),
            sha256: inputs[0].1.clone(),
            ..record
        },
        placement,
        remarks,
        inputs,
    })
}

fn no_responses() -> Problem {
    Problem::new(
        "no frequency response in the file",
        "export function type 4 of data set 58; of time records `ident frf FILE --uff FRFS.uff` makes some",
    )
}

/// The responses so that what moved from point to point is the output: where that was the hammer, force and
/// response change places (Maxwell and Betti).
fn roving_last(given: Given, outputs: Vec<String>) -> (Given, Vec<String>, Vec<String>) {
    let nodes = |places: &[Place]| places.iter().map(|p| p.node).collect::<BTreeSet<_>>().len();
    if nodes(&given.forces) <= nodes(&given.responses) {
        return (given, outputs, Vec::new());
    }
    let column =
        |o: usize| -> Vec<GivenPair> { given.pairs.iter().map(|row| row[o].clone()).collect() };
    let turned = Given {
        pairs: (0..outputs.len()).map(column).collect(),
        inputs: outputs,
        forces: given.responses.clone(),
        responses: given.forces.clone(),
        ..given.clone()
    };
    let remark =
        "the hammer went from point to point: force and response change places (reciprocity)";
    (turned, given.inputs, vec![remark.into()])
}

fn dofs(places: &[Place], geometry: &Geometry) -> Outcome<Vec<(usize, usize)>> {
    let of = |place: &Place| geometry.index(place.node).map(|i| (i, place.axis));
    let found: Vec<(usize, usize)> = places.iter().filter_map(of).collect();
    let lost = places.iter().filter(|place| of(place).is_none());
    let lost: BTreeSet<i64> = lost.map(|place| place.node).collect();
    if let Some(first) = lost.first() {
        let what = format!(
            "{} nodes with frequency responses have no place, such as node {first}",
            lost.len()
        );
        let remedy =
            "export the geometry with it (data set 15 or 2411), or name it: --geometry FILE";
        return Err(Problem::new(what, remedy));
    }
    let points: BTreeSet<usize> = found.iter().map(|dof| dof.0).collect();
    if points.len() < 2 {
        let what = format!(
            "{} point with frequency responses is no survey",
            points.len()
        );
        let remedy =
            "export all points into one file; `ident frf FILE --modes` takes a single point";
        return Err(Problem::new(what, remedy));
    }
    Ok(found)
}
