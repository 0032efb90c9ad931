//! The validation of a robot model by a workspace test: measured beside simulated stiffness at every
//! point, then re-identification and what the points cannot separate.

use super::axis_tests::AxisTest;
use super::compliance::{Prior, Refit, refit};
use super::force_steps::{Setup, Stiffness, setups};
use super::parameter::{Identified, Status, Z95};
use super::separability::{Group, groups, with_foundation};
use super::suitability::workspace::doubts;
use super::suitability::{Doubt, is_fatal, is_odd};
use crate::experiments::workspace::Response;
use crate::ground::problem::Outcome;
use crate::measurement::workspace_test::{DIRECTIONS, WorkspaceTest};
use crate::robot::Robot;

/// One point and direction.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The raw lines.
    pub setup: Setup,
    /// Measured.
    pub measured: Stiffness,
    /// Simulated, N/m; infinite where nothing gives way.
    pub simulated: f64,
    /// Simulated with rigid bearings, N/m.
    pub without_tilt: f64,
    /// Simulated with the re-identified compliances, N/m.
    pub refitted: f64,
}

/// A validated model.
pub struct Validation {
    /// Every point and direction measured.
    pub comparisons: Vec<Comparison>,
    /// The re-identification.
    pub refit: Refit,
    /// The re-identification of a model with rigid bearings.
    pub rigid_bearings: Option<Refit>,
    /// What the points cannot separate.
    pub groups: Vec<Group>,
    /// What needs attention, one sentence each.
    pub warnings: Vec<String>,
    /// What is odd about the data.
    pub doubts: Vec<Doubt>,
}

/// Spread of a nominal stiffness that nobody stated.
pub const DEFAULT_SPREAD: f64 = 0.3;
/// Force at which errors are told in millimetres, N.
pub const FORCE: f64 = 750.0;

/// Validates `robot` (as it is simulated), with what the axis tests measured as prior.
///
/// # Errors
/// The re-identification does not converge.
pub fn validate(test: &WorkspaceTest, robot: &Robot, tests: &[AxisTest]) -> Outcome<Validation> {
    let lines = setups(test);
    let repeatability = test.facts.setup_repeatability.unwrap_or(0.0);
    let points = &test.facts.joint_angles;
    let response = Response::of(robot, points);
    let bare = robot.without_tilt();
    let without = Response::of(&bare, points);
    let spread = test.facts.nominal_rel_std.unwrap_or(DEFAULT_SPREAD);
    let fit = |response: &Response| {
        refit(
            response,
            priors(response, tests, spread),
            &lines,
            repeatability,
        )
    };
    let refitted = fit(&response)?;
    let rigid_bearings = match bare.is_elastic() {
        true => Some(fit(&without)?),
        false => None,
    };
    let wide = Response::of(&with_foundation(robot), points);
    let groups = groups(&wide, &refitted.weighing);
    let compare = |setup: &Setup| {
        let (p, d) = (setup.point, setup.direction);
        let stiffness =
            |response: &Response, compliances: &[f64]| 1.0 / response.slope(p, d, compliances)[d];
        Comparison {
            measured: setup.stiffness(repeatability),
            simulated: stiffness(&response, &response.compliances()),
            without_tilt: stiffness(&without, &without.compliances()),
            refitted: stiffness(&response, &refitted.compliances()),
            setup: setup.clone(),
        }
    };
    let mut validation = Validation {
        comparisons: lines.iter().map(compare).collect(),
        refit: refitted,
        rigid_bearings,
        groups,
        warnings: Vec::new(),
        doubts: doubts(test, Some(robot)),
    };
    validation.warnings = warnings(test, &validation, tests);
    Ok(validation)
}

/// Axis test where there is one, else the model's value with the stated spread.
fn priors(response: &Response, tests: &[AxisTest], spread: f64) -> Vec<Prior> {
    let of = |name: &str, compliance: f64| match tests.iter().find(|test| test.site == name) {
        Some(test) => Prior {
            stiffness: test.stiffness.0,
            rel_std: test.stiffness.1 / test.stiffness.0,
            measured: true,
        },
        None => Prior {
            stiffness: 1.0 / compliance,
            rel_std: spread.max(1e-6),
            measured: false,
        },
    };
    response
        .sites
        .iter()
        .map(|site| of(&site.name, site.compliance))
        .collect()
}

impl Comparison {
    /// `P3 y`.
    pub fn name(&self) -> String {
        format!(
            "P{} {}",
            self.setup.point + 1,
            DIRECTIONS[self.setup.direction]
        )
    }

    /// How much stiffer the given value is than the measured one, %.
    pub fn error_percent(&self, stiffness: f64) -> Option<f64> {
        let error = 100.0 * (stiffness / self.measured.value? - 1.0);
        error.is_finite().then_some(error)
    }

    /// How much further than measured the tool moves under [`FORCE`] with the given stiffness, m.
    pub fn error_m(&self, stiffness: f64) -> Option<f64> {
        Some(FORCE / stiffness - FORCE / self.measured.value?)
    }

    /// Whether the simulated stiffness lies inside the measured interval.
    pub fn agrees(&self) -> Option<bool> {
        let [low, high] = self.measured.ci95?;
        Some((low..=high).contains(&self.simulated))
    }
}

/// Mean and largest magnitude of errors; `None` without any.
pub fn mean_and_max(errors: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let sizes: Vec<f64> = errors.map(f64::abs).collect();
    (!sizes.is_empty()).then(|| {
        let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
        (mean, sizes.iter().fold(0.0, |m, e| e.max(m)))
    })
}

impl Validation {
    /// The re-identified stiffnesses; without a value where the data cannot carry one.
    pub fn parameters(&self) -> Vec<Identified> {
        let all = self.refit.parameters();
        match is_fatal(&self.doubts) {
            false => all,
            true => all
                .into_iter()
                .map(|p| p.without_value(Status::NotIdentifiable))
                .collect(),
        }
    }

    /// Mean and largest magnitude of the error of a simulated stiffness, %.
    pub fn errors(&self, of: fn(&Comparison) -> f64) -> Option<(f64, f64)> {
        mean_and_max(
            self.comparisons
                .iter()
                .filter_map(|c| c.error_percent(of(c))),
        )
    }

    /// Mean ratio of the simulated stiffness without tilt to that with tilt, by direction.
    pub fn tilt_ratio(&self, direction: usize) -> Option<f64> {
        let own = self
            .comparisons
            .iter()
            .filter(|c| c.setup.direction == direction);
        let ratios = own.map(|c| c.without_tilt / c.simulated);
        let ratios: Vec<f64> = ratios.filter(|r| r.is_finite()).collect();
        (!ratios.is_empty()).then(|| ratios.iter().sum::<f64>() / ratios.len() as f64)
    }
}

/// Below this probability the contradiction between model and measurement needs attention.
const CONTRADICTION: f64 = 1e-3;
/// A prior is contradicted if the fit moves it by this many of its standard deviations.
const PULL: f64 = 3.5;

fn warnings(test: &WorkspaceTest, found: &Validation, tests: &[AxisTest]) -> Vec<String> {
    let mut said: Vec<String> = found.doubts.iter().map(Doubt::sentence).collect();
    if test.facts.setup_repeatability.is_none() {
        said.push("the file states no `setup_repeatability`: intervals hold the scatter of the readings only".into());
    }
    if test.facts.nominal_rel_std.is_none() && tests.len() < found.refit.sites.len() {
        said.push(format!(
            "the file states no `nominal_stiffness_rel_std`: {:.0} % is assumed where no axis test is",
            100.0 * DEFAULT_SPREAD
        ));
    }
    if test.left_out > 0 {
        said.push(format!(
            "{} of {} rows left out for an empty cell",
            test.left_out, test.rows
        ));
    }
    said.extend(unreadable(found));
    let wild: usize = found
        .comparisons
        .iter()
        .flat_map(|c| c.setup.lines)
        .flatten()
        .map(|l| l.wild)
        .sum();
    if wild > 0 {
        said.push(format!("{wild} wild displacement readings left out"));
    }
    said.extend(contradictions(found));
    said
}

fn unreadable(found: &Validation) -> Option<String> {
    let none = found
        .comparisons
        .iter()
        .filter(|c| c.measured.value.is_none());
    let names: Vec<String> = none.map(Comparison::name).collect();
    (!names.is_empty()).then(|| {
        format!("the readings give no stiffness along the force at {}: not measured, too noisy, or of reversed sign", names.join(", "))
    })
}

fn contradictions(found: &Validation) -> Vec<String> {
    let mut said = Vec::new();
    if found.refit.p_value < CONTRADICTION {
        said.push(format!(
            "model, priors and points contradict each other (p = {:.1e}): something bends that the model does not have, or a stated spread is too small; intervals are widened",
            found.refit.p_value
        ));
    }
    for (i, site) in found.refit.sites.iter().enumerate() {
        let pull = found.refit.pull(i);
        if pull.abs() > PULL.max(Z95) {
            said.push(format!(
                "{} comes out {} than known before by {:.1} of its standard deviations",
                site.name,
                if pull > 0.0 { "softer" } else { "stiffer" },
                pull.abs()
            ));
        }
    }
    said
}

/// Whether anything needs attention: a contradiction, or a point without a stiffness.
pub fn needs_attention(found: &Validation) -> bool {
    unreadable(found).is_some() || !contradictions(found).is_empty() || is_odd(&found.doubts)
}
