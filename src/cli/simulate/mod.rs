//! `ident simulate pose | deflection | frf | motion`: what the model says.

mod deflection;
mod frf;
mod motion;
mod pose;
mod record;
mod robot_args;

use super::{Ending, Verb, arguments};
use crate::ground::problem::Outcome;
use clap::{ArgMatches, Args, Subcommand};

/// The verb.
pub const VERB: Verb = Verb {
    name: "simulate",
    about: "Simulate the robot: pose, deflection, frequency response, motion",
    arguments: arguments::<Simulate>,
    run,
};

/// Simulate the robot: pose, deflection, frequency response, motion.
#[derive(Debug, Args)]
pub struct Simulate {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Tool pose, Jacobian, mass matrix and gravity torques
    Pose(pose::Pose),
    /// Displacement of the tool under a force, compliance, stiffness
    Deflection(deflection::Deflection),
    /// Accelerance of the tool and the natural modes
    Frf(frf::Frf),
    /// Time response to a force record or a joint path, as CSV
    Motion(motion::Motion),
}

/// Runs `ident simulate`.
///
/// # Errors
/// A robot or argument that is refused, with its remedy.
pub fn run(matches: &ArgMatches) -> Outcome<Ending> {
    match super::parsed::<Simulate>(matches).what {
        What::Pose(pose) => pose.run(),
        What::Deflection(deflection) => deflection.run(),
        What::Frf(frf) => frf.run(),
        What::Motion(motion) => motion.run(),
    }
}
