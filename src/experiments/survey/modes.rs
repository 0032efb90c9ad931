//! The modes of a survey: poles from a few combinations of all responses, shapes from all of them.

use crate::experiments::hammer_frf::{HammerFrf, Settings};
use crate::experiments::hammer_given;
use crate::experiments::hammer_modes::{channels, lines};
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::frf_uff::{Given, GivenPair};
use crate::measurement::hammer::HammerRecord;
use crate::measurement::survey::Survey;
use crate::signal::mac::{phase_collinearity, upright};
use crate::signal::modal_shapes::{Shapes, principal, shapes};
use crate::signal::modes::{LeftOut, Mode, identify};
use rustfft::num_complex::Complex64;

/// Combinations in which poles are sought.
const COMBINATIONS: usize = 12;
/// Share of its power that a response may keep beside the modes without a remark; noise alone leaves some.
const LEFT: f64 = 0.3;
/// So many times the middle of all is told.
const OUTSTANDING: f64 = 4.0;

/// A mode with its shape.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyMode {
    /// Frequency, damping and their intervals.
    pub mode: Mode,
    /// Per response (as [`Survey::dofs`]), the largest at 1, turned to be as real as it can.
    pub shape: Vec<Complex64>,
    /// Modal phase collinearity, 0 to 1.
    pub collinearity: f64,
}

/// What a survey gives.
#[derive(Debug, Clone)]
pub struct SurveyModes {
    /// By frequency.
    pub modes: Vec<SurveyMode>,
    /// Per response, the share of its power that the modes leave, those above the band counted too.
    pub left: Vec<f64>,
    /// What a reader should know.
    pub remarks: Vec<String>,
}

/// The modes up to `to_hz`.
///
/// # Errors
/// Lines that are too few up to there.
pub fn find(survey: &Survey, to_hz: f64) -> Outcome<SurveyModes> {
    let record = &survey.record;
    let given = record.given.clone().unwrap_or_default();
    let settings = Settings {
        band_hz: to_hz,
        modes: true,
        ..Settings::default()
    };
    let all = hammer_given::frf(record, &given, &settings);
    let lines = lines(&all, to_hz);
    if lines.len() < FEWEST {
        return Err(too_few(lines.len(), to_hz));
    }
    let few = combined(record, &given, &all, &lines);
    let few = hammer_given::frf(&few, few.given.as_ref().unwrap_or(&given), &settings);
    // Modes above the band reach into it: the shapes need them too.
    let found = identify(&channels(&few, &lines), &LeftOut::new(), f64::INFINITY);
    let poles: Vec<Complex64> = found.iter().map(|mode| mode.pole).collect();
    let shapes = shapes(&channels(&all, &lines), &poles);
    let mut modes: Vec<SurveyMode> = found
        .into_iter()
        .zip(&shapes.at_outputs)
        .map(together)
        .collect();
    // Below the first line nothing is seen.
    let first = all.frequency_hz[lines[0]];
    modes.retain(|one| (first..=to_hz).contains(&one.mode.frequency_hz));
    let told: Vec<Mode> = modes.iter().map(|one| one.mode.clone()).collect();
    let mut remarks = Vec::new();
    remarks.extend(hammer_given::undecayed(&all, &told));
    remarks.extend(outstanding(survey, &shapes));
    Ok(SurveyModes {
        modes,
        left: shapes.left,
        remarks,
    })
}

/// Fewest lines from which modes are sought.
const FEWEST: usize = 16;

fn too_few(lines: usize, to_hz: f64) -> Problem {
    Problem::new(
        format!("{lines} lines up to {to_hz} Hz are too few for modes"),
        "measure with finer lines, or raise --to-Hz",
    )
}

fn together((mode, shape): (Mode, &Vec<Complex64>)) -> SurveyMode {
    SurveyMode {
        collinearity: phase_collinearity(shape),
        shape: upright(shape),
        mode,
    }
}

/// The responses combined to a few that hold their power.
fn combined(
    record: &HammerRecord,
    given: &Given,
    all: &HammerFrf,
    lines: &[usize],
) -> HammerRecord {
    let outputs = record.outputs.len();
    let strong = channels(all, lines).frf;
    let factors = principal(&strong, outputs, COMBINATIONS.min(outputs));
    let sum = |row: &Vec<GivenPair>, factors: &Vec<f64>| -> GivenPair {
        let at = |k: usize| {
            let parts = row
                .iter()
                .zip(factors)
                .map(|(pair, f)| pair.accelerance[k] * f);
            parts.sum()
        };
        GivenPair {
            accelerance: (0..given.frequency_hz.len()).map(at).collect(),
            coherence: None,
        }
    };
    let row = |row: &Vec<GivenPair>| factors.iter().map(|f| sum(row, f)).collect();
    HammerRecord {
        outputs: (1..=factors.len())
            .map(|k| format!("combination {k}"))
            .collect(),
        given: Some(Given {
            pairs: given.pairs.iter().map(row).collect(),
            ..given.clone()
        }),
        ..HammerRecord::default()
    }
}

/// Points at which the modes leave much: another structure there, a loose sensor, a cable that was swapped.
fn outstanding(survey: &Survey, shapes: &Shapes) -> Option<String> {
    let middle = crate::signal::outliers::median(&shapes.left);
    let much = |left: f64| left > LEFT && left > OUTSTANDING * middle;
    let named: Vec<String> = survey
        .record
        .outputs
        .iter()
        .zip(&shapes.left)
        .filter(|(_, left)| much(**left))
        .map(|(name, left)| format!("{name} ({:.0} %)", 100.0 * left))
        .collect();
    (!named.is_empty()).then(|| {
        format!(
            "the modes leave much of the power at {}: look at these points before trusting their shapes",
            named.join(", ")
        )
    })
}
