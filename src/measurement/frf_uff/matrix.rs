//! Frequency responses put into a matrix of forces and responses.

use super::dofs::{Ends, Place, ends, names};
use super::grid::{self, Grid};
use super::units::{Stated, scale};
use super::{Given, GivenPair, is_response, refuse};
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::front::Front;
use crate::measurement::uff::{Function, Kind, UniversalFile, Values};
use rustfft::num_complex::Complex64;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// A function with its place in the file and in the matrix.
struct Placed<'a> {
    function: &'a Function,
    line: usize,
    ends: Ends,
}

impl Placed<'_> {
    /// Input and output without signs.
    fn key(&self) -> Key {
        let plain = |place: Place| Place {
            reversed: false,
            ..place
        };
        (plain(self.ends.input), plain(self.ends.output))
    }
}

type Key = (Place, Place);

/// Names of the responses, and the matrix.
///
/// # Errors
/// As [`super::record`].
pub fn read(file: &UniversalFile, front: &Front, rate: f64) -> Outcome<(Vec<String>, Given)> {
    let mut remarks = Vec::new();
    let responses = placed(file, front, is_response, &mut remarks)?;
    let coherences = placed(file, front, |f| f.kind == Kind::Coherence, &mut Vec::new())?;
    let grid = common(&responses)?;
    let stated = Stated::read(front)?;
    let mut pairs: BTreeMap<Key, (usize, GivenPair)> = BTreeMap::new();
    for one in &responses {
        let values = accelerance(one, file, (grid, rate), stated)?;
        let coherence = coherences.iter().find(|c| c.key() == one.key());
        let coherence = coherence.map(|c| real(c, grid)).transpose()?;
        let pair = GivenPair {
            accelerance: values,
            coherence,
        };
        if let Some((first, _)) = pairs.insert(one.key(), (one.line, pair)) {
            let what = format!("the same response and force as on line {first}");
            return Err(refuse(
                one.line,
                what,
                "export each frequency response once, or one test per file",
            ));
        }
    }
    let (inputs, outputs) = full(&pairs, &mut remarks);
    let pair =
        |input: &Place, output: &Place| pairs.get(&(*input, *output)).map(|(_, pair)| pair.clone());
    let row = |input: &Place| {
        outputs
            .iter()
            .filter_map(|output| pair(input, output))
            .collect()
    };
    let given = Given {
        frequency_hz: grid.frequency_hz(),
        inputs: names(&inputs),
        rate,
        pairs: inputs.iter().map(row).collect(),
        forces: inputs,
        responses: outputs.clone(),
        averages: None,
        remarks,
    };
    Ok((names(&outputs), given))
}

/// The functions of one kind with a place in the matrix.
fn placed<'a>(
    file: &'a UniversalFile,
    front: &Front,
    wanted: impl Fn(&Function) -> bool,
    remarks: &mut Vec<String>,
) -> Outcome<Vec<Placed<'a>>> {
    let tool: Option<Vec<f64>> = front.numbers("tool_nodes")?;
    let at_tool = |place: Place| {
        tool.as_ref()
            .is_none_or(|nodes| nodes.contains(&(place.node as f64)))
    };
    let mut found = Vec::new();
    let mut turned = 0;
    for (i, function) in file.functions.iter().enumerate().filter(|(_, f)| wanted(f)) {
        let line = file.lines.get(i).copied().unwrap_or(1);
        match ends(function, line)? {
            None => turned += 1,
            Some(mut ends) if at_tool(ends.input) && at_tool(ends.output) => {
                if tool.is_some() {
                    (ends.input.node, ends.output.node) = (0, 0);
                }
                found.push(Placed {
                    function,
                    line,
                    ends,
                });
            }
            Some(_) => {}
        }
    }
    if turned > 0 {
        remarks.push(format!(
            "{turned} frequency responses of rotations are left out"
        ));
    }
    Ok(found)
}

fn common(responses: &[Placed]) -> Outcome<Grid> {
    let mut all = responses
        .iter()
        .map(|one| Ok((grid::of(one.function, one.line)?, one.line)));
    let (first, _) = all.next().unwrap_or_else(|| Err(none()))?;
    all.try_fold(first, |grid, other: Outcome<(Grid, usize)>| {
        let (other, line) = other?;
        grid.and(other, line)
    })
}

fn none() -> Problem {
    Problem::new(
        "no frequency response of a translation at these nodes",
        "export function type 4 of data set 58, and check `tool_nodes`",
    )
}

fn accelerance(
    one: &Placed,
    file: &UniversalFile,
    (grid, rate): (Grid, f64),
    stated: Stated,
) -> Outcome<Vec<Complex64>> {
    let Values::Complex(values) = &one.function.values else {
        let what = "a frequency response of real numbers has no phase";
        return Err(refuse(
            one.line,
            what,
            "export complex values (ordinate type 5 or 6)",
        ));
    };
    let scale = scale(one.function, file.units.as_ref(), stated, one.line)?;
    let s = |f: f64| Complex64::new(rate, TAU * f);
    let sign = one.ends.sign();
    let lines = values.iter().zip(grid.frequency_hz());
    let values: Vec<Complex64> = lines
        .map(|(h, f)| scale.accelerance(h * sign, s(f)))
        .collect();
    match values.iter().all(|h| h.is_finite()) {
        true => Ok(values),
        false => Err(refuse(
            one.line,
            "a value is not finite",
            "export again: the data are damaged",
        )),
    }
}

/// A coherence on the common lines.
fn real(one: &Placed, grid: Grid) -> Outcome<Vec<f64>> {
    let own = grid::of(one.function, one.line)?;
    grid.and(own, one.line)?;
    let values: Vec<f64> = match &one.function.values {
        Values::Real(values) => values.clone(),
        Values::Complex(values) => values.iter().map(|v| v.re).collect(),
    };
    let outside = values.iter().position(|v| !(-0.001..=1.001).contains(v));
    if values.len() < grid.count || outside.is_some() {
        let what =
            "a coherence that is shorter than its frequency response, or not between 0 and 1";
        return Err(refuse(one.line, what, "export it again, or without it"));
    }
    Ok(values[..grid.count]
        .iter()
        .map(|v| v.clamp(0.0, 1.0))
        .collect())
}

/// Forces and responses of the largest matrix without gaps; what is left out is said.
fn full(
    pairs: &BTreeMap<Key, (usize, GivenPair)>,
    remarks: &mut Vec<String>,
) -> (Vec<Place>, Vec<Place>) {
    let mut rows: BTreeMap<Place, Vec<Place>> = BTreeMap::new();
    for (input, output) in pairs.keys() {
        rows.entry(*input).or_default().push(*output);
    }
    let outputs = rows
        .values()
        .max_by_key(|outputs| outputs.len())
        .cloned()
        .unwrap_or_default();
    let whole = |row: &&Place| outputs.iter().all(|output| rows[row].contains(output));
    let inputs: Vec<Place> = rows.keys().filter(whole).copied().collect();
    let left = pairs.len() - inputs.len() * outputs.len();
    if left > 0 {
        remarks.push(format!(
            "{left} of {} frequency responses are left out: not every force has the same responses",
            pairs.len()
        ));
    }
    (inputs, outputs)
}
