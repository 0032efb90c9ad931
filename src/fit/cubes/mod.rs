//! Every drive, bearing and elastic axis of a robot at once, from measuring cubes under load: linear in the
//! compliances, which are not negative (source 002, section 2.5; Abele et al. 2008).

pub mod relative;
pub mod solved;
pub mod store;
pub mod together;

use super::parameter::{Identified, Status, Z95};
use crate::experiments::cubes::Setup;
use crate::ground::problem::Outcome;
use crate::measurement::cubes::CubeTest;
use crate::robot::Robot;
use relative::Relative;
use solved::Solved;
use together::Together;

/// What was found.
#[derive(Debug, Clone)]
pub struct Account {
    /// The compliances with their covariance.
    pub solved: Solved,
    /// Stiffness of every site, N·m/rad.
    pub parameters: Vec<Identified>,
    /// Sites of which only a sum is seen.
    pub together: Vec<Together>,
    /// Rotation between subsequent cubes and the moment there.
    pub relative: Vec<Relative>,
}

/// Identifies a robot from all its cube `tests` together.
///
/// # Errors
/// A file that does not fit the robot, or no convergence.
pub fn identify(tests: &[CubeTest], robot: &Robot) -> Outcome<Account> {
    let setups = tests
        .iter()
        .map(|test| Setup::new(test, robot))
        .collect::<Outcome<Vec<_>>>()?;
    let solved = Solved::of(tests, &setups).map_err(|problem| match tests.first() {
        Some(test) => problem.in_text(&test.path),
        None => problem,
    })?;
    Ok(Account {
        parameters: parameters(&solved),
        together: together::together(&solved),
        relative: relative::relative(tests, &setups),
        solved,
    })
}

fn parameters(solved: &Solved) -> Vec<Identified> {
    (0..solved.sites.len())
        .map(|i| parameter(solved, i))
        .collect()
}

fn parameter(solved: &Solved, i: usize) -> Identified {
    let site = &solved.sites[i];
    let (c, s) = (solved.compliance(i), solved.deviation(i));
    let meaning = match solved.status[i] {
        Status::NotIdentifiable if !solved.seen[i] => {
            "Stiffness; no cube moves with it under these loads."
        }
        Status::NotIdentifiable => "Stiffness; these cubes and loads do not fix it.",
        _ => "Stiffness of the whole site: what is read divided into joints and links.",
    };
    let mut found = Identified::new(
        "stiffness",
        &site.name,
        1.0 / c,
        "N·m/rad",
        s / (c * c),
        meaning,
    );
    found.ci95 = Some([1.0 / (c + Z95 * s), 1.0 / (c - Z95 * s)]);
    match solved.status[i] {
        Status::Identified => found,
        status => {
            found = found.limited(status, f64::NAN);
            found
        }
    }
}
