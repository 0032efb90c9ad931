//! What a frequency response is of: displacement, velocity or acceleration over a force, in which unit.

use super::refuse;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::front::Front;
use crate::measurement::uff::{Axis, Function, Quantity, Units};
use rustfft::num_complex::Complex64;

/// What the numbers of a function are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// 0: displacement, 1: velocity, 2: acceleration.
    pub order: usize,
    /// Times this they are m, m/s or m/s² per N.
    pub factor: f64,
}

impl Scale {
    /// The accelerance of a value at `s`, (m/s²)/N.
    pub fn accelerance(&self, value: Complex64, s: Complex64) -> Complex64 {
        value * self.factor * s.powu(2 - self.order as u32)
    }
}

/// Standard gravity, m/s².
const G: f64 = 9.806_65;
/// Units of a response: name, order, SI per unit.
const RESPONSES: &[(&str, usize, f64)] = &[
    ("m", 0, 1.0),
    ("mm", 0, 1e-3),
    ("um", 0, 1e-6),
    ("in", 0, 0.0254),
    ("m/s", 1, 1.0),
    ("mm/s", 1, 1e-3),
    ("in/s", 1, 0.0254),
    ("m/s2", 2, 1.0),
    ("mm/s2", 2, 1e-3),
    ("in/s2", 2, 0.0254),
    ("g", 2, G),
];
/// Units of a force: name, N per unit.
const FORCES: &[(&str, f64)] = &[("n", 1.0), ("kn", 1e3), ("lbf", 4.448_221_615)];
/// Words for what a response over a force is, by the order of the response.
const WORDS: [&[&str]; 3] = [
    &["receptance", "compliance"],
    &["mobility"],
    &["accelerance", "inertance"],
];
/// Relative difference from which two factors are not the same.
const SAME: f64 = 1e-3;

/// Units that stand beside the file and go first.
#[derive(Debug, Clone, Copy, Default)]
pub struct Stated {
    response: Option<(usize, f64)>,
    force: Option<f64>,
}

impl Stated {
    /// Reads them.
    ///
    /// # Errors
    /// A unit that is not known.
    pub fn read(front: &Front) -> Outcome<Self> {
        let unknown = |key: &str, names: &str| {
            front.problem(
                key,
                "is no unit known here",
                format!("write one of {names}"),
            )
        };
        let response = front.text("response_unit")?.map(|unit| {
            let names = RESPONSES
                .iter()
                .map(|row| row.0)
                .collect::<Vec<_>>()
                .join(", ");
            response(unit).ok_or_else(|| unknown("response_unit", &names))
        });
        let force = front
            .text("force_unit")?
            .map(|unit| force(unit).ok_or_else(|| unknown("force_unit", "N, kN, lbf")));
        Ok(Self {
            response: response.transpose()?,
            force: force.transpose()?,
        })
    }
}

fn simple(unit: &str) -> String {
    let unit = unit
        .to_lowercase()
        .replace(['²'], "2")
        .replace(['µ', 'μ'], "u");
    unit.replace(['(', ')', '[', ']', ' ', '^', '*'], "")
}

fn response(unit: &str) -> Option<(usize, f64)> {
    let unit = simple(unit);
    let row = RESPONSES.iter().find(|row| row.0 == unit)?;
    Some((row.1, row.2))
}

fn force(unit: &str) -> Option<f64> {
    let unit = simple(unit);
    Some(FORCES.iter().find(|row| row.0 == unit)?.1)
}

/// The unit of the ordinate: alone, or as in `(m/s^2)/N` with that of the force.
fn labelled(axis: &Axis) -> (Option<(usize, f64)>, Option<f64>) {
    if let Some(found) = response(&axis.unit) {
        return (Some(found), None);
    }
    let unit = simple(&axis.unit);
    match unit.rsplit_once('/') {
        Some((above, below)) if force(below).is_some() => (response(above), force(below)),
        _ => (None, None),
    }
}

/// What a function is of. What stands beside the file goes first, then the codes of record 9 and 10 with
/// data set 164, then the labels; where two of the file say different things it is refused.
///
/// # Errors
/// A unit that is not known, or two that contradict each other.
pub fn scale(
    function: &Function,
    units: Option<&Units>,
    stated: Stated,
    line: usize,
) -> Outcome<Scale> {
    let [_, ordinate, denominator, _] = &function.axes;
    let (label, below) = labelled(ordinate);
    let (order, above) = match (stated.response, coded(ordinate, units)) {
        (Some(found), _) => found,
        (None, Some(code)) => agreed(code, label, line)?,
        (None, None) => label.ok_or_else(|| unknown(ordinate, line))?,
    };
    worded(ordinate, order, stated, line)?;
    let force_code = matches!(
        denominator.quantity,
        Quantity::ExcitationForce | Quantity::ReactionForce
    );
    let by_label = force(&denominator.unit).or(below);
    let below = match (stated.force, force_code, by_label) {
        (Some(unit), ..) => unit,
        (None, true, label) => {
            let code = units.map(|units| 1.0 / units.factor(denominator));
            agreed_force(code, label, line)?
        }
        (None, false, Some(label)) => label,
        (None, false, None) => return Err(no_force(denominator, line)),
    };
    Ok(Scale {
        order,
        factor: above / below,
    })
}

/// Order and SI per unit by the code of the ordinate and data set 164.
fn coded(axis: &Axis, units: Option<&Units>) -> Option<(usize, Option<f64>)> {
    let order = match axis.quantity {
        Quantity::Displacement => 0,
        Quantity::Velocity => 1,
        Quantity::Acceleration => 2,
        _ => return None,
    };
    Some((order, units.map(|units| 1.0 / units.factor(axis))))
}

/// The code with its factor, once the label does not contradict it.
fn agreed(
    (order, factor): (usize, Option<f64>),
    label: Option<(usize, f64)>,
    line: usize,
) -> Outcome<(usize, f64)> {
    match (factor, label) {
        (_, Some((other, _))) if other != order => Err(contradiction(line)),
        (Some(factor), Some((_, label))) if !same(factor, label) => Err(contradiction(line)),
        (Some(factor), _) => Ok((order, factor)),
        (None, label) => Ok((order, label.map_or(1.0, |label| label.1))),
    }
}

fn agreed_force(code: Option<f64>, label: Option<f64>, line: usize) -> Outcome<f64> {
    match (code, label) {
        (Some(code), Some(label)) if !same(code, label) => Err(contradiction(line)),
        (Some(code), _) => Ok(code),
        (None, label) => Ok(label.unwrap_or(1.0)),
    }
}

fn same(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < SAME
}

/// Refuses a word such as `Receptance` that the unit contradicts.
fn worded(axis: &Axis, order: usize, stated: Stated, line: usize) -> Outcome<()> {
    let label = axis.label.to_lowercase();
    let said = WORDS
        .iter()
        .position(|words| words.iter().any(|word| label.contains(word)));
    match said {
        Some(word) if word != order && stated.response.is_none() => Err(contradiction(line)),
        _ => Ok(()),
    }
}

const REMEDY: &str = "write `response_unit = \"m/s2\"` and `force_unit = \"N\"`, as they are, into STEM.ident.toml beside the file";

fn contradiction(line: usize) -> Problem {
    let what = "the codes, labels and units of this frequency response contradict each other";
    refuse(line, what, REMEDY)
}

fn unknown(axis: &Axis, line: usize) -> Problem {
    let what = format!(
        "the ordinate (specific data type {}, unit `{}`) is no displacement, velocity or acceleration known here",
        axis.quantity.code(),
        axis.unit
    );
    refuse(line, what, REMEDY)
}

fn no_force(axis: &Axis, line: usize) -> Problem {
    let what = format!(
        "the denominator (specific data type {}, unit `{}`) is no force known here",
        axis.quantity.code(),
        axis.unit
    );
    refuse(line, what, REMEDY)
}
