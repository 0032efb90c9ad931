//! What may be off although nothing is wrong: springs and coefficients within what is known of them, and the datum.

use super::Case;
use super::stations::LAW;
use crate::causes::places::soften;
use crate::findings::engine::Nuisance;
use crate::findings::physics;
use crate::process::setup::Setup;

/// A number that is merely uncertain.
#[derive(Debug, Clone, PartialEq)]
pub enum Known {
    /// Compliance of a spring, relative.
    Spring(String),
    /// A coefficient of the cut, relative.
    Coefficient(usize),
    /// Where the part was found again, along one axis, m.
    Datum,
    /// What the laws of the cut do not know, here and there along the path, as a share of the simulated deviation.
    Law,
    /// What surface and probe are off alike at neighbouring places, in deviations of the probe.
    Form,
}

/// Standard deviation of a datum that states none, m.
const DATUM: f64 = 10e-6;

/// All of a case that the readings show, each with what one unit of it adds to them.
pub(super) fn uncertain(case: &Case) -> Vec<(Known, Nuisance)> {
    let sites = physics::shown_springs(case);
    let springs = sites.into_iter().map(Known::Spring);
    let springs = springs.zip(physics::springs(case));
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
    let all = springs.chain(coefficients).chain(datum);
    let all = all.chain(laws(case)).chain(forms(case));
    all.filter(|(_, n)| n.column.iter().any(|x| x.abs() > 1e-12))
        .collect()
}

/// Waves over the path by which the laws of the cut miss: neighbours are missed alike, which no noise of single places says.
const WAVES: usize = 4;

/// The simulated deviation times each of them, m.
pub(super) fn missed(case: &Case) -> Vec<Vec<f64>> {
    let times = |wave: &Vec<f64>| {
        let each = wave.iter().zip(&case.simulated);
        each.map(|(w, s)| w * s).collect()
    };
    case.waves(WAVES).iter().map(times).collect()
}

fn laws(case: &Case) -> impl Iterator<Item = (Known, Nuisance)> {
    let law = |column| Nuisance {
        column,
        spread: LAW,
    };
    missed(case).into_iter().map(move |m| (Known::Law, law(m)))
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
        Known::Coefficient(k) => setup.material.coefficients[*k] *= (1.0 + amount).max(0.05),
        Known::Datum | Known::Law | Known::Form => return false,
    }
    true
}
