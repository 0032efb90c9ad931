//! Kind `hammer` from the time records of a universal file.

use super::foreign::sidecar::place as sidecar;
use super::frf_uff;
use super::front::Front;
use super::hammer::{self, HammerRecord, HammerRun};
use super::uff::{self, Abscissa, Function, Kind, Quantity, Values};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use std::path::Path;

/// Whether the name of `path` is that of a universal file.
pub fn is_universal(path: &Path) -> bool {
    let name = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    matches!(name.as_deref(), Some("uff" | "unv" | "ufb" | "58"))
}

/// Whether a file holds frequency responses without the hits behind them.
pub fn without_hits(path: &Path) -> bool {
    is_universal(path) && read_hammer(path).is_ok_and(|record| record.given.is_some())
}

/// Reads a hammer test of either form: universal file by its name, else CSV.
pub fn read_any(path: &Path) -> Outcome<HammerRecord> {
    if is_universal(path) {
        read_hammer(path)
    } else {
        hammer::read_hammer(path)
    }
}

/// Reads force and acceleration records, or frequency responses where the file has those and no records
/// of a force. Facts stand beside the file. Records of one load case belong together where the load cases
/// name the hits; else the k-th force belongs to the k-th record of each response.
pub fn read_hammer(path: &Path) -> Outcome<HammerRecord> {
    let file = uff::read(path)?;
    let front = frf_uff::front(path).map_err(|problem| problem.in_file(&sidecar(path)))?;
    let functions = file.functions_si();
    let record = match frf_uff::has_responses(&file) && forces(&functions).is_empty() {
        true => frf_uff::record(&file, &front),
        false => from_functions(&functions, &front),
    };
    Ok(HammerRecord {
        sha256: files::sha256(&files::read_bytes(path)?),
        ..record.map_err(|problem| problem.in_text(path))?
    })
}

fn forces(functions: &[Function]) -> Vec<&Function> {
    let wanted = [Quantity::ExcitationForce, Quantity::ReactionForce];
    let fits = |f: &&Function| f.kind == Kind::Time && wanted.contains(&f.quantity());
    functions.iter().filter(fits).collect()
}

fn from_functions(functions: &[Function], front: &Front) -> Outcome<HammerRecord> {
    let records = |wanted: &[Quantity]| -> Vec<&Function> {
        let fits = |f: &&Function| f.kind == Kind::Time && wanted.contains(&f.quantity());
        functions.iter().filter(fits).collect()
    };
    let forces = forces(functions);
    let accelerations = records(&[Quantity::Acceleration]);
    let first = forces.first().ok_or_else(no_force)?;
    let interval_s = interval(first)?;
    let outputs = outputs(&accelerations, forces.len())?;
    let named = load_cases(&forces, &outputs);
    let runs = forces.iter().enumerate().map(|(k, force)| {
        let responses = outputs.iter().map(|(_, all)| {
            let same = |f: &&&Function| named && f.numbers[2] == force.numbers[2];
            let own = all.iter().find(same).unwrap_or(&all[k]);
            signed(own, own.response.direction)
        });
        run(k, force, responses.collect())
    });
    let runs = runs.collect::<Outcome<Vec<_>>>()?;
    let all = forces.iter().chain(accelerations.iter());
    for other in all {
        if (interval(other)? - interval_s).abs() > 1e-6 * interval_s {
            return Err(Problem::new(
                "the time records have different sampling rates",
                "export all channels of the test with one rate",
            ));
        }
    }
    Ok(HammerRecord {
        interval_s,
        outputs: outputs.into_iter().map(|(name, _)| name).collect(),
        runs,
        ..hammer::stated(front)?
    })
}

/// Whether every force has a load case of its own and every response has each of them once.
fn load_cases(forces: &[&Function], outputs: &[(String, Vec<&Function>)]) -> bool {
    let sorted = |all: &[&Function]| {
        let mut cases: Vec<i64> = all.iter().map(|f| f.numbers[2]).collect();
        cases.sort_unstable();
        cases
    };
    let own = sorted(forces);
    let distinct = own.windows(2).all(|pair| pair[0] != pair[1]);
    distinct && outputs.iter().all(|(_, all)| sorted(all) == own)
}

fn no_force() -> Problem {
    Problem::new(
        "no time record of a force",
        "export force (type 13) and acceleration (type 12) as time records, data set 58 function type 1",
    )
}

fn interval(function: &Function) -> Outcome<f64> {
    let places = function.places();
    match (&function.abscissa, &places[..]) {
        (Abscissa::Even { .. }, [first, second, ..]) if second > first => Ok(second - first),
        _ => Err(Problem::new(
            "a time record is not evenly sampled forward in time",
            "export evenly sampled records",
        )),
    }
}

/// Responses by direction, each with one record per force.
fn outputs<'a>(
    accelerations: &[&'a Function],
    hits: usize,
) -> Outcome<Vec<(String, Vec<&'a Function>)>> {
    let mut outputs: Vec<(String, Vec<&Function>)> = Vec::new();
    for function in accelerations {
        let name = direction(function.response.direction);
        match outputs.iter_mut().find(|(n, _)| *n == name) {
            Some((_, all)) => all.push(function),
            None => outputs.push((name, vec![function])),
        }
    }
    let unequal = outputs.iter().find(|(_, all)| all.len() != hits);
    match unequal {
        None if !outputs.is_empty() => Ok(outputs),
        _ => {
            let found = unequal.map_or(0, |(_, all)| all.len());
            let what = format!("{hits} force records but {found} of an acceleration");
            Err(Problem::new(what, "export the same hits of every channel"))
        }
    }
}

fn direction(code: i64) -> String {
    ["force", "x", "y", "z", "rx", "ry", "rz"]
        .get(code.unsigned_abs() as usize)
        .map_or_else(|| code.to_string(), |name| (*name).into())
}

fn signed(function: &Function, direction: i64) -> Vec<f64> {
    let sign = if direction < 0 { -1.0 } else { 1.0 };
    match &function.values {
        Values::Real(values) => values.iter().map(|v| sign * v).collect(),
        Values::Complex(values) => values.iter().map(|v| sign * v.re).collect(),
    }
}

fn run(k: usize, force: &Function, responses: Vec<Vec<f64>>) -> Outcome<HammerRun> {
    let samples = force.values.len();
    let values = signed(force, force.response.direction);
    let finite = |record: &Vec<f64>| record.iter().all(|v| v.is_finite());
    if responses.iter().any(|r| r.len() != samples) {
        return Err(Problem::new(
            format!("hit {}: force and acceleration differ in length", k + 1),
            "export whole records of every channel",
        ));
    }
    if !finite(&values) || !responses.iter().all(finite) {
        return Err(Problem::new(
            format!("hit {}: a value is not finite", k + 1),
            "export again: the record is damaged",
        ));
    }
    Ok(HammerRun {
        direction: direction(force.response.direction),
        hit: Some((k + 1).to_string()),
        force: values,
        responses,
    })
}
