//! Kind `hammer` from the frequency responses of a universal file (data set 58, function type 4), as
//! analysers export them, with coherences (type 6) where the file has them.

mod dofs;
mod grid;
mod matrix;
mod units;

pub use dofs::Place;

use super::foreign::Sidecar;
use super::front::Front;
use super::hammer::{self, HammerRecord};
use super::uff::{Function, Kind, UniversalFile};
use crate::ground::problem::{Outcome, Problem};
use rustfft::num_complex::Complex64;
use std::path::Path;

/// Frequency responses that another program estimated.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Given {
    /// Frequencies of the lines, Hz, evenly spaced.
    pub frequency_hz: Vec<f64>,
    /// Degrees of freedom of the forces: `x`, or `12z` where there are several nodes.
    pub inputs: Vec<String>,
    /// Where the forces acted, in the order of `inputs`, without signs: they are in the values.
    pub forces: Vec<Place>,
    /// Where the responses were taken, likewise.
    pub responses: Vec<Place>,
    /// Rate of the exponential window on both channels, 1/s.
    pub rate: f64,
    /// `pairs[input][output]`
    pub pairs: Vec<Vec<GivenPair>>,
    /// Hits or averages behind each value, where that is stated.
    pub averages: Option<usize>,
    /// What a reader should know of the reading.
    pub remarks: Vec<String>,
}

/// One of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GivenPair {
    /// Accelerance, (m/s²)/N.
    pub accelerance: Vec<Complex64>,
    /// Ordinary coherence.
    pub coherence: Option<Vec<f64>>,
}

/// Facts of such a file beside those of a hammer test.
pub(super) const FACTS: &[&str] = &[
    "averages",
    "response_unit",
    "force_unit",
    "tool_nodes",
    "geometry_unit",
    "survey_origin_mm",
    "survey_yaw_deg",
    "links",
];

/// Most averages that a file may state.
const MOST_AVERAGES: f64 = 1e6;

/// Whether the file holds frequency responses.
pub fn has_responses(file: &UniversalFile) -> bool {
    file.functions.iter().any(is_response)
}

fn is_response(function: &Function) -> bool {
    function.kind == Kind::FrequencyResponse
}

/// What the sidecar of a universal file and the folder say of it.
///
/// # Errors
/// An unknown fact.
pub fn front(path: &Path) -> Outcome<Front> {
    let mut front = Front::default();
    front.inherit(Sidecar::beside(path)?);
    front.only(&[hammer::FACTS, FACTS].concat())?;
    Ok(front)
}

/// The frequency responses of a file as a hammer test.
///
/// # Errors
/// A unit, a direction or a spacing that is not understood, with its line.
pub fn record(file: &UniversalFile, front: &Front) -> Outcome<HammerRecord> {
    let (outputs, given) = matrix::read(file, front, rate(file, front)?)?;
    let given = Given {
        averages: averages(file, front)?,
        ..given
    };
    Ok(HammerRecord {
        outputs,
        given: Some(given),
        ..hammer::stated(front)?
    })
}

/// Rate of the exponential window, 1/s: from beside the file, else as `ident frf` writes it.
fn rate(file: &UniversalFile, front: &Front) -> Outcome<f64> {
    let own = || said(file, 1, |line| between(line, "sigma = ", " 1/s"));
    let constant = front.positive("exponential_window_s")?;
    Ok(constant.map_or_else(|| own().unwrap_or(0.0), f64::recip))
}

/// Hits behind each value: from beside the file, else as `ident frf` writes it.
fn averages(file: &UniversalFile, front: &Front) -> Outcome<Option<usize>> {
    match front.positive("averages")? {
        None => Ok(said(file, 0, |line| between(line, ", ", " hits")).map(|n| n as usize)),
        Some(n) if n.fract() == 0.0 && n <= MOST_AVERAGES => Ok(Some(n as usize)),
        Some(n) => {
            let what = format!("is {n}, which is no number of averages");
            Err(front.problem("averages", what, "write for example `averages = 5`"))
        }
    }
}

/// A number that every frequency response states in one line of its head; the least of them.
fn said(file: &UniversalFile, line: usize, of: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    let responses = file.functions.iter().filter(|f| is_response(f));
    let all: Option<Vec<f64>> = responses.map(|f| of(&f.id[line])).collect();
    all?.into_iter().min_by(f64::total_cmp)
}

fn between(line: &str, before: &str, after: &str) -> Option<f64> {
    let (_, rest) = line.split_once(before)?;
    let value: f64 = rest.split_once(after)?.0.trim().parse().ok()?;
    (value.is_finite() && value >= 0.0).then_some(value)
}

/// A problem with one function of the file.
fn refuse(line: usize, what: impl Into<String>, remedy: impl Into<String>) -> Problem {
    Problem::new(what, remedy).at_line(line)
}
