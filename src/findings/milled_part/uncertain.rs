//! What may be off although nothing is wrong: springs and coefficients within what is known of them, and the datum.

use super::Case;
use super::stations::LAW;
use crate::causes::places::soften;
use crate::findings::engine::Nuisance;
use crate::findings::physics::{self, OnRobot};
use crate::ground::spatial::{dot, scale, sub};
use crate::ground::stats::{Z95, rms};
use crate::process::setup::Setup;
use crate::robot::{Robot, Spring};
use rayon::prelude::*;

/// A number that is merely uncertain.
#[derive(Debug, Clone, PartialEq)]
pub enum Known {
    /// Compliance of a spring, relative.
    Spring(String),
    /// All dampers of a robot that swings together, relative.
    Dampers,
    /// One of them.
    Damper(String),
    /// A coefficient of the cut, relative.
    Coefficient(usize),
    /// Where the part was found again, along one axis, m.
    Datum,
    /// Whether the sag at the start was calibrated away as a place or as the bend of every spring: none or one.
    Calibration,
    /// Whether a place was measured where the tool passes it, or what the tool did when it was told to be there: none or one.
    Instant,
    /// Whether a part that is taken to be at rest shows the simulated swing: none or all of it.
    Swing,
    /// What the laws of the cut do not know, as a share of the simulated deviation times one of some waves along the path.
    Law(usize),
    /// What surface and probe are off alike at neighbouring places, in deviations of the probe.
    Form,
}

/// Standard deviation of a datum that states none, m.
const DATUM: f64 = 10e-6;

/// All of a case that the readings show, each with what one unit of it adds to them.
pub(super) fn uncertain(case: &Case) -> Vec<(Known, Nuisance)> {
    let springs = physics::shown_springs(case).into_iter();
    let springs = springs.map(|(site, nuisance)| (Known::Spring(site), nuisance));
    let stds = case.planned.coefficient_stds();
    let coefficient = |(i, column): (usize, &Vec<f64>)| {
        let spread = stds.get(i).copied().flatten().unwrap_or(physics::USUAL);
        (
            Known::Coefficient(i),
            Nuisance {
                column: column.clone(),
                spread,
            },
        )
    };
    let coefficients = case.coefficients.iter().enumerate().map(coefficient);
    let spread = case.test.facts.datum_std.unwrap_or(DATUM).max(1e-9);
    let datum = (0..3).map(|k| {
        let column = case.column(|_, row| row.across[k]);
        (Known::Datum, Nuisance { column, spread })
    });
    let all = springs
        .chain(dampers(case))
        .chain(coefficients)
        .chain(datum);
    let all = all
        .chain(calibration(case))
        .chain(instant(case))
        .chain(swing(case))
        .chain(laws(case))
        .chain(forms(case));
    all.filter(|(_, n)| n.column.iter().any(|x| x.abs() > 1e-12))
        .collect()
}

/// What is left of the sag if bends of springs were calibrated away at the start, and no place: no file says which.
fn calibration(case: &Case) -> [(Known, Nuisance); 1] {
    let moved = case.holds.iter().map(|h| scale(-1.0, h.as_at_first));
    let nuisance = Nuisance {
        column: case.answered(&moved.collect::<Vec<_>>()),
        spread: 1.0,
    };
    [(Known::Calibration, nuisance)]
}

/// What a file shows more that tells what a tool did at a time; where nothing swings that is noise of steep places.
fn instant(case: &Case) -> Option<(Known, Nuisance)> {
    let column = case.column(|s, row| dot(row.across, sub(s.told, s.deviation)));
    let nuisance = Nuisance {
        column,
        spread: 1.0,
    };
    case.swings().then_some((Known::Instant, nuisance))
}

/// Dampings decide how much of the swing is there: hammer tests tell, and not every robot had one. One of it is as likely as none; a choice.
fn swing(case: &Case) -> Option<(Known, Nuisance)> {
    let nuisance = Nuisance {
        column: case.swing.clone(),
        spread: 1.0,
    };
    (!case.swing.is_empty()).then_some((Known::Swing, nuisance))
}

/// Relative standard deviation of a damping that states none: what hammer tests in other poses leave open. A choice, no measurement.
const DAMPING: f64 = 0.1;
/// Least noise of a reading below which nobody feels all dampings together, as a share.
const FELT: f64 = 0.1;
/// Relative change at which a damping is tried.
const DAMPED: f64 = 0.2;

/// Joints from the foot whose dampers are uncertain each for itself: they carry the slow modes.
const SLOW: usize = 3;

/// All dampers together and those of the slow modes, each within what is known of it, where the robot swings.
fn dampers(case: &Case) -> Vec<(Known, Nuisance)> {
    let robot = &case.setup.robot;
    let nuisance = |known: Known, spread: f64| {
        let mut other = robot.clone();
        damp(&mut other, &known, DAMPED);
        let column = case.change(&other).iter().map(|x| x / DAMPED).collect();
        (known, Nuisance { column, spread })
    };
    if !case.swings() {
        return Vec::new();
    }
    let all = nuisance(Known::Dampers, DAMPING);
    if rms(&all.1.column) * DAMPED < FELT * case.noise() {
        return Vec::new();
    }
    let joints = robot.joints.iter().take(SLOW);
    let drives: Vec<(&str, &Spring)> = joints
        .filter_map(|joint| Some((&joint.name[..], joint.drive.as_ref()?)))
        .collect();
    let own = drives.into_par_iter().map(|(site, spring)| {
        let spread = known_damping(spring).unwrap_or(DAMPING);
        nuisance(Known::Damper(site.into()), spread)
    });
    std::iter::once(all)
        .chain(own.collect::<Vec<_>>())
        .collect()
}

/// Half of an interval of 95 %, in standard deviations, relative.
fn known_damping(spring: &Spring) -> Option<f64> {
    let [least, most] = spring.ci95.damping?;
    let spread = (most - least) / (2.0 * Z95 * spring.damping);
    (spread.is_finite() && spread > 0.0).then_some(spread)
}

fn damp(robot: &mut Robot, which: &Known, by: f64) {
    let is_own = |site: &str| match which {
        Known::Damper(own) => own == site,
        _ => true,
    };
    for (site, spring) in robot.springs_mut() {
        if is_own(&site) {
            spring.damping *= (1.0 + by).max(0.1);
        }
    }
}

/// Waves over the path by which the laws of the cut miss: neighbours are missed alike, which no noise of single places says.
const WAVES: usize = 4;

/// A simulated deviation times each of them, m.
pub(super) fn missed(case: &Case, simulated: &[f64]) -> Vec<Vec<f64>> {
    let times = |wave: &Vec<f64>| {
        let each = wave.iter().zip(simulated);
        each.map(|(w, s)| w * s).collect()
    };
    case.waves(WAVES).iter().map(times).collect()
}

fn laws(case: &Case) -> impl Iterator<Item = (Known, Nuisance)> {
    let law = |(k, column)| {
        let nuisance = Nuisance {
            column,
            spread: LAW,
        };
        (Known::Law(k), nuisance)
    };
    let missed = missed(case, &case.simulated);
    missed.into_iter().enumerate().map(law)
}

/// Waves over the path of a surface and of a probe that are not quite true, and how far, in deviations of the probe: neighbours
/// are off alike, which many readings do not average out. A choice, no measurement: together they are two fifths of a deviation.
const FORMS: (usize, f64) = (8, 0.2);

/// Each of them in either direction across the feed, short ones as large as long ones.
fn forms(case: &Case) -> impl Iterator<Item = (Known, Nuisance)> {
    let spread = FORMS.1 * case.probe();
    let alike = |(wave, k): (Vec<f64>, u8)| wave.iter().map(|w| f64::from(k) * w).collect();
    let waves: Vec<Vec<f64>> = case
        .waves(FORMS.0)
        .into_iter()
        .zip(1..)
        .map(alike)
        .collect();
    let each = case.either_way(&waves).into_iter();
    each.map(move |column| (Known::Form, Nuisance { column, spread }))
}

/// Puts an amount of it in place; false where that changes neither robot nor cut.
pub(super) fn put(known: &Known, amount: f64, setup: &mut Setup) -> bool {
    match known {
        Known::Spring(site) => soften(&mut setup.robot, site, amount),
        Known::Dampers | Known::Damper(_) => damp(&mut setup.robot, known, amount),
        Known::Coefficient(k) => setup.material.coefficients[*k] *= (1.0 + amount).max(0.05),
        Known::Datum
        | Known::Calibration
        | Known::Instant
        | Known::Swing
        | Known::Law(_)
        | Known::Form => {
            return false;
        }
    }
    true
}
