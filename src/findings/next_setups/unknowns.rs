//! What is not known of a robot: the compliance of every place that may give way, those of the model
//! and those that a cause would add.

use super::belief::Belief;
use crate::causes::{Sight, seen_by};
use crate::effects::Family;
use crate::experiments::workspace::{Response, Site};
use crate::fit::axis_tests::AxisTest;
use crate::fit::validation::DEFAULT_SPREAD;
use crate::robot::{Robot, Spring};
use nalgebra::{DMatrix, DVector};

/// Spread of a compliance that the model does not have, of that of the drive before it.
const ABSENT: f64 = 0.5;
/// A spread of zero would be certainty.
const LEAST: f64 = 1e-6;

/// Every compliance in question.
#[derive(Debug, Clone)]
pub struct Unknowns {
    /// The robot with everything that could be added to it.
    pub robot: Robot,
    /// The places, each with its reference: the compliance of the model, or what could be there.
    pub sites: Vec<Site>,
    /// Compliance expected, of the reference: one for what the model has, else zero.
    mean: Vec<f64>,
    /// Spread, of the reference.
    std: Vec<f64>,
}

impl Unknowns {
    /// Of a robot. `spread`: stated relative standard deviation of what no axis test measured.
    pub fn of(robot: &Robot, tests: &[AxisTest], spread: Option<f64>) -> Self {
        let known: Vec<String> = robot.springs().map(|(name, _)| name).collect();
        let wide = widened(robot);
        let sites = Response::of(&wide, &[]).sites;
        let spread = spread.unwrap_or(DEFAULT_SPREAD).max(LEAST);
        let mut unknowns = Self {
            robot: wide,
            sites: Vec::new(),
            mean: Vec::new(),
            std: Vec::new(),
        };
        for site in sites {
            let (reference, mean, std) = match tests.iter().find(|test| test.site == site.name) {
                Some(test) => {
                    let (value, stderr) = test.stiffness;
                    (1.0 / value, 1.0, (stderr / value).max(LEAST))
                }
                None if known.contains(&site.name) => (site.compliance, 1.0, spread),
                None => (neighbour(robot, &site.name), 0.0, ABSENT),
            };
            unknowns.sites.push(Site {
                compliance: reference,
                ..site
            });
            unknowns.mean.push(mean);
            unknowns.std.push(std);
        }
        unknowns
    }

    /// What is known before any point is measured.
    pub fn belief(&self) -> Belief {
        let prior = DVector::from_vec(self.std.clone());
        Belief {
            sites: self.sites.iter().map(|site| site.name.clone()).collect(),
            mean: DVector::from_vec(self.mean.clone()),
            covariance: DMatrix::from_diagonal(&prior.component_mul(&prior)),
            prior,
        }
    }

    /// The compliances expected, rad/(N·m).
    pub fn compliances(&self) -> Vec<f64> {
        let both = self.sites.iter().zip(&self.mean);
        both.map(|(site, mean)| site.compliance * mean).collect()
    }
}

/// The robot with every spring that a physical cause would add to it.
fn widened(robot: &Robot) -> Robot {
    let mut wide = robot.clone();
    let physics = seen_by(Sight::Workspace).filter(|c| c.card().family == Family::Physics);
    for cause in physics {
        // a shift has no drive to be compared with
        let own = |k: usize| f64::from(u8::from(k < cause.straight()));
        let amounts: Vec<f64> = (0..cause.card().amounts.len()).map(own).collect();
        for site in cause.sites(robot) {
            let mut one = robot.clone();
            cause.alter(&mut one, &site, &amounts);
            if adds(&one, robot, &wide) {
                cause.alter(&mut wide, &site, &amounts);
            }
        }
    }
    wide
}

/// Whether a robot has springs that another lacks, and a third has none of them yet.
fn adds(one: &Robot, robot: &Robot, wide: &Robot) -> bool {
    let names = |robot: &Robot| robot.springs().map(|(name, _)| name).collect::<Vec<_>>();
    let (old, taken) = (names(robot), names(wide));
    let mut fresh = names(one);
    fresh.retain(|name| !old.contains(name));
    !fresh.is_empty() && fresh.iter().all(|name| !taken.contains(name))
}

/// Compliance of the drive that a place hangs on: `link3-x` on A3, `A2-tilt` on A2, the foundation on
/// the first, the tool on the last.
fn neighbour(robot: &Robot, site: &str) -> f64 {
    let (place, _) = site.split_once('-').unwrap_or((site, ""));
    let link = place
        .strip_prefix("link")
        .and_then(|n| n.parse::<usize>().ok());
    let own = robot.joints.iter().position(|joint| joint.name == place);
    let at = match (link, own, place) {
        (Some(i), _, _) => i.saturating_sub(1),
        (_, Some(i), _) => i,
        (_, _, "base") => 0,
        _ => robot.dof().saturating_sub(1),
    };
    let drive = robot.joints.get(at).and_then(|joint| joint.drive.as_ref());
    let any = || robot.springs().map(|(_, spring)| spring).next();
    drive
        .or_else(any)
        .map_or(1e-7, |spring: &Spring| 1.0 / spring.stiffness)
}
