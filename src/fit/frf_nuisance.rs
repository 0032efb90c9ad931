//! Stiffnesses that are fitted along with the dampings: no robot file is right to the last digit, and a
//! resonance that lies elsewhere by a fraction of its width turns the dampings about it upside down.

use super::frf_model::Kind;
use super::frf_tuning::{Parameter, Tuning};
use crate::robot::{Robot, Spring};
use nalgebra::DMatrix;

/// Relative standard deviation of a stiffness in the model, however well it is known as a constant of
/// the robot. Weight adds up to 0.3 % to the stiffness of a hinge (moment of 8 kN·m over 5 MN·m/rad
/// and less), depending on where a sagging robot stands, and tilt axes turned about the drive share it
/// differently.
pub const MODEL_FORM: f64 = 0.003;
/// Site of what weight does.
const WEIGHT: &str = "weight";
/// Standard deviation of the logarithm of what weight does, over what it should do: from nothing, as in
/// a simulation without weight or with a controller that makes up for the sag, to all of it.
const WEIGHT_SPREAD: f64 = 1.5;
/// Range of what weight does, over what it should do.
const WEIGHT_RANGE: [f64; 2] = [0.01, 2.0];
/// Range of a stiffness that is fitted along, times the robot's: its prior holds it, not these.
const RANGE: [f64; 2] = [0.5, 2.0];
/// Standard deviations of its prior beyond which a stiffness contradicts what is said of it.
const PULLED: f64 = 3.0;
/// Times the stated deviation, at least, by which priors that are contradicted are widened.
const WIDER: f64 = 1.2;
/// Relative standard deviation of a stiffness beyond which no prior is widened.
const WIDEST: f64 = 0.1;

/// Where a nuisance went.
#[derive(Debug, Clone, PartialEq)]
pub struct Pull {
    /// Where it acts.
    pub site: String,
    /// The robot's value, SI.
    pub stated: f64,
    /// The fitted value over it.
    pub times: f64,
    /// Standard deviation of the prior of its logarithm.
    pub prior_ln_std: f64,
    /// Share of the prior's variance that the data took away, 0 to 1.
    pub learned: f64,
}

impl Pull {
    /// Distance from the robot's value in standard deviations of the prior.
    pub fn deviations(&self) -> f64 {
        self.times.ln() / self.prior_ln_std
    }

    /// Whether it contradicts the prior.
    pub fn contradicts(&self) -> bool {
        self.deviations().abs() > PULLED
    }
}

/// What weight does, over what it should do by the masses of the robot.
pub fn weight() -> Parameter {
    Parameter {
        site: WEIGHT.into(),
        kind: Kind::Weight,
        start: 1.0,
        bounds: WEIGHT_RANGE,
        prior_ln_std: Some(WEIGHT_SPREAD),
        nuisance: true,
    }
}

/// Every stiffness of the robot, about its value: its spread is that of its interval, else `stated`
/// for all of them, with the model form in quadrature.
pub fn stiffnesses(robot: &Robot, stated: Option<f64>) -> Vec<Parameter> {
    let springs = robot.springs();
    springs
        .map(|(site, spring)| stiffness(&site, spring, stated))
        .collect()
}

fn stiffness(site: &str, spring: &Spring, stated: Option<f64>) -> Parameter {
    let sound = spring
        .ci95
        .stiffness
        .filter(|[low, high]| *low > 0.0 && low < high);
    let known = sound.map(|[low, high]| (high / low).ln() / 3.92);
    Parameter {
        site: site.into(),
        kind: Kind::Stiffness,
        start: spring.stiffness,
        bounds: RANGE.map(|r| r * spring.stiffness),
        prior_ln_std: Some(known.or(stated).unwrap_or(0.0).hypot(MODEL_FORM)),
        nuisance: true,
    }
}

/// Whether it is a stiffness that is fitted along.
pub(super) fn along(parameter: &Parameter) -> bool {
    parameter.nuisance && parameter.kind == Kind::Stiffness
}

/// Where the stiffnesses that a task fits along went, at the logarithms `theta`.
pub(super) fn pulls(task: &Tuning, theta: &[f64], normal: &DMatrix<f64>) -> Vec<Pull> {
    let covariance = normal.clone().cholesky().map(|c| c.inverse());
    let all = task.parameters.iter().enumerate();
    let pull = |(i, parameter): (usize, &Parameter)| {
        let deviation = parameter.prior_ln_std.filter(|_| along(parameter))?;
        let left = covariance
            .as_ref()
            .map_or(1.0, |c| c[(i, i)] / deviation.powi(2));
        Some(Pull {
            site: parameter.site.clone(),
            stated: parameter.start,
            times: theta[i].exp() / parameter.start,
            prior_ln_std: deviation,
            learned: (1.0 - left).clamp(0.0, 1.0),
        })
    };
    all.filter_map(pull).collect()
}

/// The same with wider priors where a nuisance contradicts its own; none where all agree. One factor
/// serves all (MacKay 1992: the sum of the squared distances over the number of distances that the data
/// fix): where one stated value is wrong, the others are no better than it.
pub(super) fn widened(parameters: &[Parameter], pulls: &[Pull]) -> Option<Vec<Parameter>> {
    if !pulls.iter().any(Pull::contradicts) {
        return None;
    }
    let squares: f64 = pulls.iter().map(|pull| pull.deviations().powi(2)).sum();
    let fixed: f64 = pulls.iter().map(|pull| pull.learned).sum();
    let factor = (squares / fixed.max(1.0)).sqrt().max(WIDER);
    let wider = |parameter: &Parameter| Parameter {
        prior_ln_std: match parameter.prior_ln_std {
            Some(deviation) if along(parameter) => {
                Some((factor * deviation).min(WIDEST.max(deviation)))
            }
            kept => kept,
        },
        ..parameter.clone()
    };
    let all: Vec<Parameter> = parameters.iter().map(wider).collect();
    (all != parameters).then_some(all)
}
