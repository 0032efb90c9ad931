//! Robot or spindle grow while they warm up: the error drifts over the time of the job.

use super::{Case, Station};
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::{V3, add, norm, rotate_back, scale};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "thermal_growth",
    summary: "Robot or spindle grow while they warm up: the error drifts over the time of the job.",
    mechanism: "drift",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        vec![
            Place::new("spindle", CONSTANTS.map(|c| spindle(case, c)).into()),
            Place::new("arm", CONSTANTS.map(|c| arm(case, c)).into()),
            Place::new("robot", CONSTANTS.map(|c| robot(case, c)).into()),
        ]
    },
    parameters: |_, blamed| {
        let axes: &[&str] = match blamed.amounts.len() {
            1 if blamed.site == "arm" => &["along_the_reach"],
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

fn warm(progress: f64, constant: f64) -> f64 {
    match constant {
        0.0 => progress,
        c => (1.0 - (-progress / c).exp()) / (1.0 - (-1.0 / c).exp()),
    }
}

/// A displacement of the tool by a direction at every station, as it grows.
fn grown(case: &Case, constant: f64, of: impl Fn(&Station) -> V3) -> Vec<f64> {
    let each = case.stations.iter();
    let moved: Vec<V3> = each
        .map(|s| scale(warm(s.progress, constant), of(s)))
        .collect();
    case.answered(&moved)
}

/// The spindle pushes the tool out, along its axis.
fn spindle(case: &Case, constant: f64) -> Member {
    Member::free(grown(case, constant, |s| s.axis)).shaped(&[-1.0, constant])
}

/// All of the arm grows alike: the tool goes away from the foot, in proportion to its distance; one at the end of the
/// longest reach.
fn arm(case: &Case, constant: f64) -> Member {
    let frame = &case.planned.plan.cell.workpiece;
    let foot = rotate_back(&frame.rotation, frame.point);
    let reach = |s: &Station| add(s.tip, foot);
    let longest = case.stations.iter().map(|s| norm(reach(s)));
    let longest = longest.fold(f64::MIN_POSITIVE, f64::max);
    let column = grown(case, constant, |s| scale(longest.recip(), reach(s)));
    Member::free(column).shaped(&[-1.0, constant])
}

/// Links grow each by its own: in some direction.
fn robot(case: &Case, constant: f64) -> Member {
    let along = |k: usize| {
        grown(case, constant, |_| {
            [0, 1, 2].map(|i| f64::from(u8::from(i == k)))
        })
    };
    Member {
        columns: (0..3).map(along).collect(),
        size: Size::Free,
        positive: None,
        shape: vec![-1.0, constant],
    }
}
