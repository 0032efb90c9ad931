//! Robot or spindle grow while they warm up: the error drifts over the time of the job.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::dot;
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "thermal_growth",
    summary: "Robot or spindle grow while they warm up: the error drifts over the time of the job.",
    mechanism: "drift",
    places: |case| vec![Place::new("spindle", members(case))],
    parameters: |_, blamed| {
        let axes: &[&str] = match blamed.amounts.len() {
            1 => &["along_the_spindle"],
            _ => &["x", "y", "z"],
        };
        axes.iter()
            .zip(&blamed.amounts)
            .map(|(name, amount)| (*name, *amount, "m"))
            .collect()
    },
    would_tell: "mill the first feature once more at the end",
};

/// Time constants over the length of the job; 0: in proportion to time.
const CONSTANTS: [f64; 3] = [0.0, 0.2, 0.5];

fn members(case: &Case) -> Vec<Member> {
    CONSTANTS
        .iter()
        .flat_map(|constant| [along(case, *constant), free(case, *constant)])
        .collect()
}

fn warm(progress: f64, constant: f64) -> f64 {
    match constant {
        0.0 => progress,
        c => (1.0 - (-progress / c).exp()) / (1.0 - (-1.0 / c).exp()),
    }
}

fn along(case: &Case, constant: f64) -> Member {
    let column = case.column(|s, row| dot(row.across, s.axis) * warm(s.progress, constant));
    Member::free(column).shaped(&[-1.0, constant])
}

fn free(case: &Case, constant: f64) -> Member {
    Member {
        columns: (0..3)
            .map(|k| case.column(|s, row| row.across[k] * warm(s.progress, constant)))
            .collect(),
        size: Size::Free,
        positive: None,
        shape: vec![-1.0, constant],
    }
}
