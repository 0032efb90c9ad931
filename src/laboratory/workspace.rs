//! Simulated force steps at points of the workspace: deflections of the true robot, the factor of
//! each set-up, noise of the sensors.

use crate::experiments::workspace::Response;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use crate::ground::spatial::{M3, Pose, V3};
use crate::ground::units::DEGREE;
use crate::measurement::workspace_test::DIRECTIONS;
use crate::motion::inverse::SphericalWrist;
use crate::motion::rigid;
use crate::robot::file::is_rotation;
use crate::robot::{Robot, load};
use serde::Deserialize;
use std::fmt::Write;

/// The workspace test of a campaign.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorkspaceTruth {
    /// File to write.
    pub file: String,
    /// Postures of the points, one row each; else [`WorkspaceTruth::tcp_m`].
    #[serde(default)]
    pub joint_angles_deg: Vec<Vec<f64>>,
    /// Tool centre points, m, base frame: solved for the posture nearest to the usual home.
    #[serde(default)]
    pub tcp_m: Vec<V3>,
    /// Axes of the tool frame as columns, base axes, for [`WorkspaceTruth::tcp_m`].
    pub tool_rotation: Option<M3>,
    /// Largest force, both ways.
    #[serde(rename = "force_N")]
    pub force: f64,
    /// Steps from zero to the largest force.
    pub steps: usize,
    /// Number of cycles.
    pub cycles: usize,
    /// Rms of the displacement sensors' noise.
    pub sensor_noise_mm: f64,
    /// Relative standard deviation of the factor of each set-up.
    pub setup_repeatability: f64,
    /// Stated spread of the stiffnesses that the simulation uses.
    pub nominal_stiffness_rel_std: f64,
}

/// Posture near which the points are reached, deg.
const HOME: [f64; 6] = [0.0, -90.0, 90.0, 0.0, 60.0, 0.0];
/// Decimals of the angles in the file: the controller shows as many.
const ANGLE: f64 = 1e4;

impl WorkspaceTruth {
    /// Simulates the test with the robot that the campaign names.
    ///
    /// # Errors
    /// A robot that cannot be loaded, a point out of reach, a number that cannot be.
    pub fn record(&self, robot: &str, source: &str, seed: u64) -> Outcome<String> {
        let truth = load::load(robot, None)?.robot;
        self.record_with(&truth, robot, source, seed)
    }

    /// Simulates the test with `truth`, while the file names the robot `name`.
    ///
    /// # Errors
    /// As [`WorkspaceTruth::record`].
    pub fn record_with(
        &self,
        truth: &Robot,
        name: &str,
        source: &str,
        seed: u64,
    ) -> Outcome<String> {
        self.check()?;
        let angles = self.angles(truth)?;
        let radians: Vec<Vec<f64>> = angles
            .iter()
            .map(|row| row.iter().map(|q| q * DEGREE).collect())
            .collect();
        let response = Response::of(truth, &radians);
        let mut text = self.front(name, source, &angles);
        text.push_str("point,direction,cycle,force_N,dx_mm,dy_mm,dz_mm\n");
        let random = &mut Random::new(seed);
        for point in 0..angles.len() {
            let matrix = response.matrix(point);
            for (direction, slope) in matrix.iter().enumerate() {
                self.set_up(&mut text, (point, direction), slope, random);
            }
        }
        Ok(text)
    }

    /// The rows of one point and direction; `slope` in m/N.
    fn set_up(&self, text: &mut String, at: (usize, usize), slope: &V3, random: &mut Random) {
        let factor = 1.0 + self.setup_repeatability * random.normal();
        for cycle in 1..=self.cycles {
            for force in self.forces() {
                let read =
                    |s: &f64| 1e3 * s * force * factor + self.sensor_noise_mm * random.normal();
                let [dx, dy, dz]: [f64; 3] = {
                    let values: Vec<f64> = slope.iter().map(read).collect();
                    [values[0], values[1], values[2]]
                };
                let (point, direction) = (at.0 + 1, DIRECTIONS[at.1]);
                let _ = writeln!(
                    text,
                    "{point},{direction},{cycle},{force:.1},{dx:.5},{dy:.5},{dz:.5}"
                );
            }
        }
    }

    /// One cycle: up, down through zero, back.
    fn forces(&self) -> Vec<f64> {
        let n = self.steps as i64;
        let levels = (0..=n).chain((-n..n).rev()).chain(-n + 1..=0);
        levels
            .map(|level| self.force * level as f64 / n as f64)
            .collect()
    }

    fn front(&self, robot: &str, source: &str, angles: &[Vec<f64>]) -> String {
        let rows = angles.iter().map(|row| {
            let row: Vec<String> = row.iter().map(|q| format!("{q:?}")).collect();
            format!("#   [{}],\n", row.join(", "))
        });
        format!(
            "# kind = \"workspace\"\n\
             # synthetic = true   # simulated by `ident lab`; nobody measured this\n\
             # source = {}\n\
             # robot = {}\n\
             # nominal_stiffness_rel_std = {:?}\n\
             # setup_repeatability = {:?}\n\
             # sensor_noise_mm = {:?}\n\
             # joint_angles_deg = [\n{}# ]\n",
            toml::Value::from(source),
            toml::Value::from(robot),
            self.nominal_stiffness_rel_std,
            self.setup_repeatability,
            self.sensor_noise_mm,
            rows.collect::<String>()
        )
    }

    /// Joint angles of the points as the file gives them, deg.
    fn angles(&self, robot: &Robot) -> Outcome<Vec<Vec<f64>>> {
        if !self.joint_angles_deg.is_empty() {
            return Ok(self.joint_angles_deg.clone());
        }
        let rotation = self.tool_rotation.unwrap_or(robot.tool.rotation);
        let limits: Vec<[f64; 2]> = robot.joints.iter().map(|joint| joint.limits).collect();
        let wrist = SphericalWrist::of(&rigid(robot), &limits).ok_or_else(|| {
            self.refuse(
                "the robot has no spherical wrist",
                "give `joint_angles_deg` instead of `tcp_m`",
            )
        })?;
        let home = HOME.map(|q| q * DEGREE);
        let reach = |(i, point): (usize, &V3)| {
            let pose = Pose {
                rotation,
                point: *point,
            };
            let found = wrist.solve(&pose, &home);
            let nearest = found.nearest(&home).ok_or_else(|| {
                self.refuse(
                    &format!("point {} is out of reach", i + 1),
                    "move it towards the robot",
                )
            })?;
            let shown = |q: &f64| (q / DEGREE * ANGLE).round() / ANGLE + 0.0;
            Ok(nearest.q.iter().map(shown).collect())
        };
        self.tcp_m.iter().enumerate().map(reach).collect()
    }

    fn refuse(&self, what: &str, remedy: &str) -> Problem {
        Problem::new(format!("{}: {what}", self.file), remedy)
    }

    fn check(&self) -> Outcome<()> {
        let given = [self.joint_angles_deg.is_empty(), self.tcp_m.is_empty()];
        if given == [true, true] || given == [false, false] {
            return Err(self.refuse("needs points", "give either `joint_angles_deg` or `tcp_m`"));
        }
        if self
            .tool_rotation
            .is_some_and(|rotation| !is_rotation(&rotation))
        {
            return Err(self.refuse(
                "`tool_rotation` is no rotation",
                "write three orthonormal rows",
            ));
        }
        let numbers = [
            self.sensor_noise_mm,
            self.setup_repeatability,
            self.nominal_stiffness_rel_std,
        ];
        let fine = numbers.iter().all(|x| x.is_finite() && *x >= 0.0);
        let rows = self.steps.saturating_mul(self.cycles);
        if !(fine && self.force > 0.0 && self.force.is_finite() && (1..=100_000).contains(&rows)) {
            return Err(self.refuse(
                "force, steps, cycles, noise or a spread cannot be",
                "force above zero, at least one step and cycle, noise and spreads zero or more",
            ));
        }
        Ok(())
    }
}
