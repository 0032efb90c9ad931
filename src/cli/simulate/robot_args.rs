//! The arguments that every simulation shares.

use crate::cli::Ending;
use crate::cli::output::tell;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use crate::measurement::workspace;
use crate::motion::{self, Chain};
use crate::robot::check;
use crate::robot::load::{Loaded, load};
use clap::Args;
use std::path::Path;

/// Beyond this many degrees no joint was meant: a hundred turns, where the most that a robot axis makes is some dozens. A choice.
const MOST_DEG: f64 = 36_000.0;

/// Robot, posture and form of the answer.
#[derive(Debug, Args)]
pub struct RobotArgs {
    /// Built-in name (kr210, kr300) or a robot file, TOML or URDF; without it the identified robot of
    /// the campaign (fits/<campaign>/robot.toml)
    #[arg(long, value_name = "ROBOT")]
    pub robot: Option<String>,
    /// Campaign whose identified robot is meant, if there are several
    #[arg(long, value_name = "NAME", conflicts_with = "robot")]
    pub campaign: Option<String>,
    /// Joint angles in degrees, one per joint, A1 first
    #[arg(
        long,
        value_name = "Q1,..,Q6",
        value_delimiter = ',',
        allow_hyphen_values = true,
        required = true
    )]
    pub joints_deg: Vec<f64>,
    /// Print one JSON document instead of text
    #[arg(long)]
    pub json: bool,
}

impl RobotArgs {
    /// The robot and its joint angles, rad.
    pub fn load(&self) -> Outcome<(Loaded, Vec<f64>)> {
        let loaded = match &self.robot {
            Some(name) => load(name, None)?,
            None => identified(self.campaign.as_deref())?,
        };
        let q = self.angles(loaded.robot.dof())?;
        Ok((loaded, q))
    }

    fn angles(&self, joints: usize) -> Outcome<Vec<f64>> {
        let given = self.joints_deg.len();
        if given != joints {
            return Err(Problem::new(
                format!("{given} joint angles given, the robot has {joints} joints"),
                "write one angle per joint in degrees: --joints-deg 0,-90,90,0,0,0",
            )
            .in_column("--joints-deg"));
        }
        let possible = -MOST_DEG..=MOST_DEG;
        if !self.joints_deg.iter().all(|q| possible.contains(q)) {
            return Err(Problem::new(
                "a joint angle is not finite, or beyond a hundred turns",
                "write degrees as plain numbers",
            )
            .in_column("--joints-deg"));
        }
        Ok(self.joints_deg.iter().map(|q| q * DEGREE).collect())
    }
}

/// The robot that `stiffness` and `validate` identified; told on standard error.
fn identified(campaign: Option<&str>) -> Outcome<Loaded> {
    let path = workspace::identified_robot(Path::new(""), campaign)?;
    tell(&format!("robot: {}", path.display()));
    load(&path.display().to_string(), None)
}

/// Joints beyond their limits, one warning line each, printed to standard error.
pub fn limit_warnings(loaded: &Loaded, joints_deg: &[f64]) -> Vec<String> {
    let joints = loaded.robot.joints.iter().zip(joints_deg);
    let lines = joints.filter_map(|(joint, q)| {
        let [low, high] = joint.limits.map(|limit| limit / DEGREE);
        let outside = *q < low - 1e-6 || *q > high + 1e-6;
        outside.then(|| {
            format!(
                "warning: {} at {q:.3} deg is outside its limits {low:.1} .. {high:.1} deg",
                joint.name
            )
        })
    });
    let lines: Vec<String> = lines.collect();
    lines.iter().for_each(|line| tell(line));
    lines
}

/// Exit status: a posture that cannot be reached needs attention.
pub fn ending(warnings: &[String]) -> Ending {
    if warnings.is_empty() {
        Ending::Done
    } else {
        Ending::Attention
    }
}

/// The chain with all its springs.
///
/// # Errors
/// A body that cannot exist, or a robot in which nothing is elastic.
pub fn elastic_chain(loaded: &Loaded, without_tilt: bool) -> Outcome<Chain> {
    let robot = if without_tilt {
        loaded.robot.without_tilt()
    } else {
        loaded.robot.clone()
    };
    let place = |problem: Problem| problem.in_text(Path::new(&loaded.path));
    check::bodies(&robot).map_err(place)?;
    if !robot.is_elastic() {
        return Err(place(Problem::new(
            "nothing in this robot is elastic: no drive, tilt or elastic axis has a stiffness",
            "add `drive = { stiffness_Nm_rad = .. }` to its joints; `ident robot convert FILE` makes an editable copy of a URDF",
        )));
    }
    Ok(motion::elastic(&robot))
}
