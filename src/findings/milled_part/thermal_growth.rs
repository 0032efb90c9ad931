//! Robot or spindle grow while they warm up: the error drifts over the time of the job.

use super::{Case, Station};
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place, together, warmed};
use crate::ground::spatial::{V3, add, norm, rotate_back, scale};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "thermal_growth",
    summary: "Robot or spindle grow while they warm up: the error drifts over the time of the job.",
    mechanism: "drift",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let place =
            |site: &'static str| Place::new(site, CONSTANTS.map(|c| member(case, site, c)).into());
        ["spindle", "arm", "robot"].map(place).into()
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

/// Where what is one moves the tool at a station before the cut answers: amount by amount, at a site.
fn directions(case: &Case, site: &str, s: &Station) -> Vec<V3> {
    match site {
        // the spindle pushes the tool out, along its axis
        "spindle" => vec![s.axis],
        // all of the arm grows alike: the tool goes away from the foot, in proportion to its distance
        "arm" => vec![scale(longest(case).recip(), reach(case, s))],
        // links grow each by its own: in some direction
        _ => vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    }
}

/// From the foot to the tool.
fn reach(case: &Case, s: &Station) -> V3 {
    let frame = &case.planned.plan.cell.workpiece;
    add(s.tip, rotate_back(&frame.rotation, frame.point))
}

/// The longest reach, m: an amount of the arm is what it is longer by there.
fn longest(case: &Case) -> f64 {
    let each = case.stations.iter().map(|s| norm(reach(case, s)));
    each.fold(f64::MIN_POSITIVE, f64::max)
}

/// Where the tool goes at every station, m, if this is to blame.
pub(super) fn moves(case: &Case, blamed: &Blamed) -> Option<Vec<V3>> {
    (blamed.effect == EFFECT.name).then(|| {
        let at = |s: &Station| {
            let along = directions(case, &blamed.site, s);
            let each = along.iter().zip(&blamed.amounts);
            let whole = each.fold([0.0; 3], |sum, (d, a)| add(sum, scale(*a, *d)));
            scale(warmed(s.progress, blamed.shape[1]), whole)
        };
        case.stations.iter().map(at).collect()
    })
}

fn member(case: &Case, site: &str, constant: f64) -> Member {
    let each = case.stations.iter();
    let along: Vec<(f64, Vec<V3>)> = each
        .map(|s| (warmed(s.progress, constant), directions(case, site, s)))
        .collect();
    let count = along.first().map_or(0, |(_, d)| d.len());
    let column = |k: usize| {
        let moved: Vec<V3> = along.iter().map(|(w, d)| scale(*w, d[k])).collect();
        case.answered(&moved)
    };
    together((0..count).map(column).collect(), &[-1.0, constant])
}
