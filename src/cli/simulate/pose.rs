//! `ident simulate pose`.

use super::robot_args::{RobotArgs, ending, limit_warnings};
use crate::cli::Ending;
use crate::cli::output::{print, print_result};
use crate::ground::problem::Outcome;
use crate::motion::{self, Work};
use crate::robot::check;
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

/// Tool pose, Jacobian, mass matrix and gravity torques of the rigid robot.
#[derive(Debug, Args)]
pub struct Pose {
    #[command(flatten)]
    robot: RobotArgs,
}

/// Everything that the verb reports; units in `formats.md`.
struct Answer {
    tcp_m: [f64; 3],
    rotation: [[f64; 3]; 3],
    jacobian: Vec<Vec<f64>>,
    mass: Vec<Vec<f64>>,
    gravity: Vec<f64>,
}

impl Pose {
    /// Computes and prints.
    ///
    /// # Errors
    /// A robot that cannot be read or whose links have no possible mass.
    pub fn run(&self) -> Outcome<Ending> {
        let (loaded, q) = self.robot.load()?;
        check::dynamics(&loaded.robot)
            .map_err(|problem| problem.in_text(Path::new(&loaded.path)))?;
        let answer = compute(&loaded.robot, &q);
        match self.robot.json {
            true => print_result("simulate pose", &[loaded.input()], answer.json())?,
            false => print(&answer.text(&loaded.robot.name))?,
        }
        Ok(ending(&limit_warnings(&loaded, &self.robot.joints_deg)))
    }
}

fn compute(robot: &crate::robot::Robot, q: &[f64]) -> Answer {
    let chain = motion::rigid(robot);
    let mut work = Work::new(&chain);
    let gravity = motion::gravity_torque(&chain, &mut work, q).to_vec();
    let n = chain.len();
    let mass = motion::crba(&chain, &mut work, q)
        .chunks(n)
        .map(<[f64]>::to_vec)
        .collect();
    let columns = motion::jacobian(&chain, &work);
    let jacobian = (0..6).map(|row| columns.iter().map(|column| column[row]).collect());
    let pose = motion::tcp(&chain, &work);
    Answer {
        tcp_m: pose.point,
        rotation: pose.rotation,
        jacobian: jacobian.collect(),
        mass,
        gravity,
    }
}

impl Answer {
    fn json(&self) -> Value {
        json!({
            "tcp_m": self.tcp_m,
            "tcp_rotation": self.rotation,
            "jacobian": self.jacobian,
            "mass_matrix": self.mass,
            "gravity_torque_Nm": self.gravity,
        })
    }

    fn text(&self, name: &str) -> String {
        let [x, y, z] = self.tcp_m.map(|c| c * 1e3);
        let mut out = format!("{name}: tool at ({x:.3}, {y:.3}, {z:.3}) mm\n");
        let _ = writeln!(out, "rotation (columns: tool axes in the base frame)");
        table(&mut out, self.rotation.iter().map(|row| row.as_slice()), 6);
        let _ = writeln!(out, "Jacobian at the tool (rows vx vy vz m/rad, wx wy wz)");
        table(&mut out, self.jacobian.iter().map(Vec::as_slice), 4);
        let _ = writeln!(out, "mass matrix, kg·m²");
        table(&mut out, self.mass.iter().map(Vec::as_slice), 3);
        let _ = writeln!(out, "gravity torques, N·m");
        table(&mut out, [self.gravity.as_slice()].into_iter(), 1);
        out
    }
}

fn table<'a>(out: &mut String, rows: impl Iterator<Item = &'a [f64]>, digits: usize) {
    for row in rows {
        let cells: Vec<String> = row
            .iter()
            .map(|x| format!("{:>12.digits$}", x + 0.0))
            .collect();
        let _ = writeln!(out, "{}", cells.concat());
    }
}
