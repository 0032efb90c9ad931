//! `ident simulate deflection`.

use super::robot_args::{RobotArgs, elastic_chain, ending, limit_warnings};
use crate::cli::Ending;
use crate::cli::output::{print, print_result};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, V3};
use crate::ground::stats::length;
use crate::motion::Work;
use crate::motion::statics::{Equilibrium, Weight, deflect, large_deflection};
use clap::Args;
use serde_json::{Value, json};

/// Displacement of the tool under a force: compliance and stiffness.
#[derive(Debug, Args)]
pub struct Deflection {
    #[command(flatten)]
    robot: RobotArgs,
    /// Force at the tool in newtons, base frame
    #[arg(
        long = "force-N",
        value_name = "X,Y,Z",
        value_delimiter = ',',
        allow_hyphen_values = true,
        required = true
    )]
    force: Vec<f64>,
    /// Leave the elastic bearings out
    #[arg(long)]
    without_tilt: bool,
}

struct Answer {
    compliance: M3,
    linear: V3,
    large: Equilibrium,
}

impl Deflection {
    /// Computes and prints.
    ///
    /// # Errors
    /// A robot or force that is refused.
    pub fn run(&self) -> Outcome<Ending> {
        let force = self.force()?;
        let (loaded, q) = self.robot.load()?;
        let chain = elastic_chain(&loaded, self.without_tilt)?;
        let (mut work, q) = (Work::new(&chain), chain.spread(&q));
        let (compliance, linear) = deflect(&chain, &mut work, &q, force);
        let large = large_deflection(&chain, &mut work, &q, force, Weight::Balanced)?;
        let answer = Answer {
            compliance,
            linear,
            large,
        };
        match self.robot.json {
            true => print_result("simulate deflection", &[loaded.input()], answer.json())?,
            false => print(&answer.text(force))?,
        }
        Ok(ending(&limit_warnings(&loaded, &self.robot.joints_deg)))
    }

    fn force(&self) -> Outcome<V3> {
        let force = V3::try_from(self.force.as_slice()).ok();
        force
            .filter(|f| f.iter().all(|x| x.is_finite()))
            .ok_or_else(|| {
                Problem::new(
                    "the force is not three finite numbers",
                    "write it in newtons: --force-N 0,0,-100",
                )
                .in_column("--force-N")
            })
    }
}

impl Answer {
    /// Force over displacement along the same direction, N/m; null for a rigid direction.
    fn stiffness(&self) -> [Option<f64>; 3] {
        [0, 1, 2].map(|i| Some(1.0 / self.compliance[i][i]).filter(|k| k.is_finite()))
    }

    fn json(&self) -> Value {
        let [xx, yy, zz] = self.stiffness();
        json!({
            "displacement_m": self.linear,
            "compliance_m_N": self.compliance,
            "stiffness_N_m": {"xx": xx, "yy": yy, "zz": zz},
            "displacement_large_m": self.large.displacement,
        })
    }

    fn text(&self, [fx, fy, fz]: V3) -> String {
        let [x, y, z] = self.linear.map(|d| d * 1e3);
        let size = length(&self.linear) * 1e3;
        let stiffness = self
            .stiffness()
            .map(|k| k.map_or("rigid".into(), |k| format!("{:.1} N/mm", k * 1e-3)));
        let [kx, ky, kz] = stiffness;
        format!(
            "Under ({fx}, {fy}, {fz}) N the tool moves {size:.4} mm: ({x:.4}, {y:.4}, {z:.4}) mm.\n\
             Stiffness along x {kx}, y {ky}, z {kz}.\n"
        )
    }
}
