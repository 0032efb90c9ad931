//! The arguments that every simulation shares.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use crate::robot::load::{Loaded, load};
use clap::Args;

/// Robot, posture and form of the answer.
#[derive(Debug, Args)]
pub struct RobotArgs {
    /// Built-in name (kr210, kr300) or a robot file, TOML or URDF
    #[arg(long, value_name = "ROBOT")]
    pub robot: String,
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
        let loaded = load(&self.robot, None)?;
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
        if self.joints_deg.iter().any(|q| !q.is_finite()) {
            return Err(Problem::new(
                "a joint angle is not finite",
                "write degrees as plain numbers",
            )
            .in_column("--joints-deg"));
        }
        Ok(self.joints_deg.iter().map(|q| q * DEGREE).collect())
    }
}

/// Joints beyond their limits, as one warning line each.
pub fn limit_warnings(loaded: &Loaded, q: &[f64]) -> Vec<String> {
    let joints = loaded.robot.joints.iter().zip(q);
    let outside =
        joints.filter(|(joint, q)| **q < joint.limits[0] - 1e-9 || **q > joint.limits[1] + 1e-9);
    let line = outside.map(|(joint, q)| {
        let [low, high] = joint.limits.map(|limit| limit / DEGREE);
        format!(
            "warning: {} at {:.3} deg is outside its limits {low:.1} .. {high:.1} deg",
            joint.name,
            q / DEGREE
        )
    });
    line.collect()
}
