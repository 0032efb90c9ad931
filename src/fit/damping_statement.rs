//! What is said of each tuned constant, and whether the model supports saying it.

use super::damping::Pair;
use super::frf_identifiability::{Statement, Status as Found};
use super::frf_match::FrfMatch;
use super::frf_model::Kind;
use super::frf_tuning::{Parameter, Tuned};
use super::parameter::{Identified, Status};

/// Match below which the simulation needs attention: FRAC, and mean amplitude error in dB.
const GOOD: (f64, f64) = (0.99, 0.5);
/// Reduced chi-square above which the misfit is not noise: with it, errors are twice what scatters from
/// hit to hit.
pub const MISFIT: f64 = 4.0;

/// Whether a match is good in shape and scale.
pub fn good(found: &FrfMatch) -> bool {
    found.frac > GOOD.0 && found.log_error_db < GOOD.1
}

/// Whether the model is right enough for its constants to be told: it misses the FRFs by noise only, or
/// by little. Intervals are widened by the root of the reduced chi-square, but no factor makes up for
/// constants that stand in for something else.
pub(super) fn supported(reduced_chi_square: f64, pairs: &[Vec<Pair>]) -> bool {
    let mut all = pairs.iter().flatten();
    reduced_chi_square <= MISFIT || all.all(|pair| good(&pair.matches[1]))
}

/// The constants as reported; no value of any where the model does not support them.
pub(super) fn reported(constants: &[Parameter], tuned: &Tuned, supported: bool) -> Vec<Identified> {
    let rows = constants
        .iter()
        .zip(&tuned.values)
        .zip(&tuned.uncertainty.statements);
    rows.map(|((constant, value), said)| match supported {
        true => identified(constant, *value, said),
        false => refused(constant, said),
    })
    .collect()
}

fn identified(constant: &Parameter, value: f64, said: &Statement) -> Identified {
    let (name, unit, meaning) = words(constant.kind);
    let prior = match said.by_prior {
        true => "; fixed by its prior, not by the data",
        false => "",
    };
    Identified {
        name: name.into(),
        site: constant.site.clone(),
        value: said.ci95.map(|_| value),
        unit: unit.into(),
        stderr: said.stderr,
        ci95: said.ci95,
        status: status(said.status),
        meaning: format!("{meaning}{prior}"),
        limit95: None,
        parts: None,
    }
}

fn refused(constant: &Parameter, said: &Statement) -> Identified {
    let nothing = Statement {
        status: match said.status {
            Found::AtBound => Found::AtBound,
            _ => Found::NotIdentifiable,
        },
        stderr: None,
        ci95: None,
        by_prior: false,
    };
    let told = identified(constant, 0.0, &nothing);
    Identified {
        meaning: format!("{}; the simulation does not meet the FRFs", told.meaning),
        ..told
    }
}

fn status(found: Found) -> Status {
    match found {
        Found::Identified => Status::Identified,
        Found::AtBound => Status::AtBound,
        Found::NotIdentifiable => Status::NotIdentifiable,
    }
}

/// Name, unit and meaning of a constant.
fn words(kind: Kind) -> (&'static str, &'static str, &'static str) {
    match kind {
        Kind::Damping => (
            "damping",
            "N·m·s/rad",
            "viscous damping of this elastic axis",
        ),
        Kind::Stiffness => (
            "stiffness",
            "N·m/rad",
            "stiffness of this elastic axis, released",
        ),
        Kind::Mass => (
            "mass",
            "kg",
            "mass of the tool, released, its inertia in proportion",
        ),
        Kind::Weight => ("weight", "1", "sag and stiffness by weight, over its own"),
        Kind::Body => (
            "bodies",
            "1",
            "combination of bodies' numbers, standard deviations",
        ),
        Kind::Instrument => ("instrument", "1", "hammer or sensor, standard deviations"),
    }
}
