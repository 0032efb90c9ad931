//! A robot at a pose as the model of a tuning: which constants of it are tuned, and how they act.

use super::frf_model::{Kind, Pose, Uncertain, Weight};
use super::frf_nuisance::{MODEL_FORM, stiffnesses, weight};
use super::frf_tuning::Parameter;
use super::parameter::{Identified, Status};
use crate::ground::problem::Outcome;
use crate::motion::linear::{Linear, gravity_stiffness};
use crate::motion::swing::State;
use crate::motion::uncertain::{Known, bodies};
use crate::motion::{self, Chain, Work, linearise};
use crate::robot::{Robot, Spring};
use nalgebra::DMatrix;

/// Dampings lie between these times the stiffness, s.
const DAMPING: [f64; 2] = [1e-6, 0.1];
/// First guess where the robot file has no damping, times the stiffness, s.
const GUESS: f64 = 1e-3;
/// Range of a released stiffness or mass without an interval, relative.
const RANGE: [f64; 2] = [0.7, 1.4];
/// Prior of a released stiffness or mass without an interval: standard deviation of its logarithm.
const SPREAD: f64 = 0.1;
/// Site of the tool's mass.
pub const TOOL: &str = "tool";

/// What is tuned.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Released {
    /// Every stiffness too, about its value in the robot file.
    pub stiffness: bool,
    /// The mass of the tool too.
    pub mass: bool,
    /// Prior of the dampings about the robot's: standard deviation of the logarithm.
    pub prior_ln_std: Option<f64>,
}

/// The tuned constants of a robot: damping per drive, tilt and elastic axis, then what is released, last
/// the stiffnesses that are fitted along unless they are. `stated`: relative standard deviation of those
/// that have no interval.
pub fn parameters(robot: &Robot, released: Released, stated: Option<f64>) -> Vec<Parameter> {
    let springs: Vec<(String, &Spring)> = robot.springs().collect();
    let mut all: Vec<Parameter> = springs
        .iter()
        .map(|(site, spring)| damping(site, spring, released.prior_ln_std))
        .collect();
    if released.stiffness {
        all.extend(springs.iter().map(|(site, spring)| stiffness(site, spring)));
    }
    if let Some(body) = robot.tool.body.as_ref().filter(|_| released.mass) {
        all.push(about(TOOL, Kind::Mass, body.mass, None));
    }
    if !released.stiffness {
        all.extend(stiffnesses(robot, stated));
    }
    all.push(weight());
    all
}

fn damping(site: &str, spring: &Spring, prior_ln_std: Option<f64>) -> Parameter {
    let bounds = DAMPING.map(|t| t * spring.stiffness);
    let guess = GUESS * spring.stiffness;
    let known = spring.damping > 0.0;
    let start = if known { spring.damping } else { guess };
    Parameter {
        site: site.into(),
        kind: Kind::Damping,
        start: start.clamp(bounds[0], bounds[1]),
        bounds,
        prior_ln_std,
        nuisance: false,
    }
}

fn stiffness(site: &str, spring: &Spring) -> Parameter {
    about(
        site,
        Kind::Stiffness,
        spring.stiffness,
        spring.ci95.stiffness,
    )
}

/// A released constant: within its interval where it has one, with that interval as its prior, either
/// wider by the model form.
fn about(site: &str, kind: Kind, start: f64, ci95: Option<[f64; 2]>) -> Parameter {
    let sound = ci95.filter(|[low, high]| *low > 0.0 && low < high);
    let margin = (1.96 * MODEL_FORM).exp();
    let widened = sound.map(|[low, high]| [low / margin, high * margin]);
    let bounds = widened.unwrap_or(RANGE.map(|r| r * start));
    let spread = sound.map_or(SPREAD, |[low, high]| (high / low).ln() / 3.92);
    Parameter {
        site: site.into(),
        kind,
        start: start.clamp(bounds[0], bounds[1]),
        bounds,
        prior_ln_std: Some(spread.hypot(MODEL_FORM)),
        nuisance: false,
    }
}

/// The model at the joint angles `joints` (rad), and what its own weight does to it; nothing measured
/// yet. A hit is small: play is closed on the side the weight presses.
///
/// # Errors
/// No equilibrium, or nothing elastic.
pub fn pose(
    robot: &Robot,
    joints: &[f64],
    parameters: &[Parameter],
    known: Option<&Known>,
) -> Outcome<Pose> {
    let chain = motion::elastic(&without_play(robot));
    let rest = State::settled(&chain, joints)?.angles();
    let mut work = Work::new(&chain);
    let bent = linearise(&chain, &mut work, &rest)?;
    let stiffened = square(bent.n, &gravity_stiffness(&chain, &work));
    let straight = State::relaxed(&chain, joints).angles();
    let linear = linearise(&chain, &mut work, &straight)?;
    let tool = tool_mass(robot, &chain, &rest)?;
    let directions: Vec<DMatrix<f64>> = parameters
        .iter()
        .map(|p| direction(&linear, &tool, p))
        .collect();
    let tuned = |kind: Kind, whole: DMatrix<f64>| {
        let parts = parameters
            .iter()
            .zip(&directions)
            .filter(|(p, _)| p.kind == kind);
        parts.fold(whole, |rest, (p, d)| rest - d * value(robot, p))
    };
    Ok(Pose {
        mass: tuned(Kind::Mass, square(linear.n, &linear.mass)),
        damping: tuned(Kind::Damping, square(linear.n, &linear.damping)),
        stiffness: tuned(Kind::Stiffness, square(linear.n, &linear.stiffness)),
        weight: Some(Weight {
            mass: square(bent.n, &bent.mass) - square(linear.n, &linear.mass),
            stiffness: stiffened,
            jacobian: jacobian(&bent) - jacobian(&linear),
        }),
        jacobian: jacobian(&linear),
        uncertain: known
            .map(|known| -> Outcome<Uncertain> {
                Ok(Uncertain {
                    bodies: bodies::directions(robot, &straight, &known.bodies)?,
                    instrument: known.instrument,
                    turn: linear.turn.clone(),
                    pose: 0,
                })
            })
            .transpose()?,
        directions,
        measured: Vec::new(),
    })
}

fn without_play(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    robot
        .springs_mut()
        .for_each(|(_, spring)| spring.backlash.clear());
    robot
}

/// Translation of the tool per coordinate (3 × n).
fn jacobian(linear: &Linear) -> DMatrix<f64> {
    DMatrix::from_fn(3, linear.n, |row, i| linear.tool[i][row])
}

fn square(n: usize, rows: &[f64]) -> DMatrix<f64> {
    DMatrix::from_row_slice(n, n, rows)
}

/// What a constant is in the robot itself, SI: the start of a damping that is zero there is not.
fn value(robot: &Robot, parameter: &Parameter) -> f64 {
    let spring = robot.springs().find(|(site, _)| *site == parameter.site);
    match parameter.kind {
        Kind::Damping => spring.map_or(0.0, |(_, s)| s.damping),
        Kind::Stiffness => spring.map_or(0.0, |(_, s)| s.stiffness),
        Kind::Mass => robot.tool.body.as_ref().map_or(0.0, |body| body.mass),
        Kind::Weight => 1.0,
        Kind::Body | Kind::Instrument => 0.0,
    }
}

/// What one kilogram of tool, its inertia in proportion, adds to the mass matrix.
fn tool_mass(robot: &Robot, chain: &Chain, rest: &[f64]) -> Outcome<DMatrix<f64>> {
    let Some(body) = robot.tool.body.as_ref().filter(|body| body.mass > 0.0) else {
        return Ok(DMatrix::zeros(0, 0));
    };
    let mut bare = without_play(robot);
    bare.tool.body = None;
    let with = linearise(chain, &mut Work::new(chain), rest)?;
    let bare = motion::elastic(&bare);
    let without = linearise(&bare, &mut Work::new(&bare), rest)?;
    let added = square(with.n, &with.mass) - square(with.n, &without.mass);
    Ok(added / body.mass)
}

/// A spring's constant acts on every coordinate of its site: one for a drive, two for a tilt.
fn direction(linear: &Linear, tool: &DMatrix<f64>, parameter: &Parameter) -> DMatrix<f64> {
    match parameter.kind {
        Kind::Mass => return tool.clone(),
        Kind::Weight | Kind::Body | Kind::Instrument => return DMatrix::zeros(0, 0),
        Kind::Damping | Kind::Stiffness => {}
    }
    let own = |i: usize| f64::from(u8::from(linear.names[i] == parameter.site));
    DMatrix::from_fn(linear.n, linear.n, |i, j| if i == j { own(i) } else { 0.0 })
}

/// The robot with the tuned values.
#[must_use]
pub fn with_values(robot: &Robot, parameters: &[Parameter], values: &[f64]) -> Robot {
    let mut robot = robot.clone();
    for (parameter, value) in parameters.iter().zip(values) {
        if parameter.kind == Kind::Mass {
            if let Some(body) = &mut robot.tool.body {
                let share = value / body.mass;
                body.mass = *value;
                body.inertia = body.inertia.map(|i| i * share);
            }
            continue;
        }
        let own = robot
            .springs_mut()
            .find(|(site, _)| *site == parameter.site);
        if let Some((_, spring)) = own {
            match parameter.kind {
                Kind::Damping => spring.damping = *value,
                Kind::Stiffness => spring.stiffness = *value,
                Kind::Mass | Kind::Weight | Kind::Body | Kind::Instrument => {}
            }
        }
    }
    robot
}

/// The robot with identified dampings, for simulation: each with its interval and where it comes
/// from. A damping that the data do not fix alone takes the value of the joint fit, which meets the
/// FRF together with the others, and says so. One that the fit drives to a bound stays as it was.
#[must_use]
pub fn damped(
    robot: &Robot,
    parameters: &[Parameter],
    values: &[f64],
    said: &[Identified],
    origin: &str,
) -> Robot {
    let before = robot;
    let mut robot = with_values(robot, parameters, values);
    for (parameter, said) in parameters.iter().zip(said) {
        let own = robot
            .springs_mut()
            .find(|(site, _)| *site == parameter.site);
        let (Some((_, spring)), Kind::Damping) = (own, parameter.kind) else {
            continue;
        };
        spring.ci95.damping = said.ci95;
        let known = match said.status {
            Status::Identified => format!("damping identified from {origin}"),
            Status::AtBound => {
                spring.damping = value(before, parameter);
                format!("damping not fixed by {origin}: as before")
            }
            Status::NotIdentifiable => {
                format!("damping not fixed alone by {origin}: value of the joint fit")
            }
        };
        let before = spring.source.as_deref().unwrap_or("");
        let kept: Vec<&str> = before
            .split("; ")
            .filter(|part| !part.is_empty() && !part.starts_with("damping"))
            .collect();
        spring.source = Some([kept, vec![&known]].concat().join("; "));
    }
    robot.notes.retain(|note| !note.starts_with("Damping "));
    let any = said.iter().any(|one| one.status == Status::Identified);
    let word = if any {
        "identified"
    } else {
        "tuned, none identified,"
    };
    robot
        .notes
        .push(format!("Damping {word} by `ident damping` from {origin}."));
    robot
}
