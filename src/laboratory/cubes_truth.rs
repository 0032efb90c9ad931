//! Simulated measuring cubes on the structure of a robot, loaded less unloaded.

use crate::experiments::cubes::Setup;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use crate::ground::spatial::V3;
use crate::ground::units::DEGREE;
use crate::measurement::cubes::{Cube, CubeTest, Facts, Reading};
use crate::robot::{Robot, load};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

/// One cubes test of a campaign.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CubesTruth {
    /// File to write.
    pub file: String,
    /// Pose.
    pub joint_angles_deg: Vec<f64>,
    /// The cubes.
    pub cubes: Vec<CubeTruth>,
    /// True stiffness over that of the robot file; left out: 1.
    #[serde(default)]
    pub stiffness: BTreeMap<String, f64>,
    /// Largest pull of the cable, along each base axis both ways.
    #[serde(rename = "force_N")]
    pub force: f64,
    /// Largest moment of the bar, about each base axis both ways.
    #[serde(rename = "moment_Nm")]
    pub moment: f64,
    /// Noise of the displacements.
    pub sensor_noise_mm: f64,
    /// Noise of the rotations.
    pub sensor_noise_mrad: f64,
    /// Translation of the measuring frame per test and direction.
    pub frame_std_mm: f64,
}

/// One cube.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CubeTruth {
    /// Its name.
    pub name: String,
    /// The link that carries it.
    pub after: usize,
    /// The last elastic axis of that link before it.
    pub beyond: Option<String>,
    /// Its centre, base frame, at the pose.
    pub centre_m: V3,
}

impl CubesTruth {
    /// Simulates the test on the robot that the campaign names.
    ///
    /// # Errors
    /// A robot that cannot be loaded or does not carry such cubes, a stiffness of no such site.
    pub fn record(&self, (name, source): (&str, &str), seed: u64) -> Outcome<String> {
        let robot = self.truth(load(name, None)?.robot)?;
        let setup = Setup::new(&self.test(name), &robot)?;
        let compliances: Vec<f64> = setup.sites.iter().map(|site| site.compliance).collect();
        let mut text = self.front(name, source);
        text.push_str("test,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,cube,dx_mm,dy_mm,dz_mm,rx_mrad,ry_mrad,rz_mrad\n");
        let random = &mut Random::new(seed);
        for (number, [force, moment]) in self.loads().into_iter().enumerate() {
            let loaded = Reading {
                test: number as i64 + 1,
                force,
                moment,
                cube: 0,
                moved: [f64::NAN; 6],
            };
            let bent = setup.bent(&loaded, &compliances);
            let frame: V3 = std::array::from_fn(|_| self.frame_std_mm * random.normal());
            for (cube, own) in self.cubes.iter().enumerate() {
                let moved = setup.moved(&bent, cube);
                let _ = write!(text, "{}", number + 1);
                for x in force.iter().chain(&moment) {
                    let _ = write!(text, ",{x:.1}");
                }
                let _ = write!(text, ",{}", own.name);
                for k in 0..6 {
                    let read = match k < 3 {
                        true => 1e3 * moved[k] + frame[k] + self.sensor_noise_mm * random.normal(),
                        false => 1e3 * moved[k] + self.sensor_noise_mrad * random.normal(),
                    };
                    let _ = write!(text, ",{read:.5}");
                }
                text.push('\n');
            }
        }
        Ok(text)
    }

    /// A pull along, and a moment about, every base axis, both ways.
    fn loads(&self) -> Vec<[V3; 2]> {
        let mut all = Vec::new();
        for k in 0..6 {
            for sign in [1.0, -1.0] {
                let mut load = [[0.0; 3]; 2];
                load[k / 3][k % 3] = sign * if k < 3 { self.force } else { self.moment };
                all.push(load);
            }
        }
        all
    }

    /// The robot as it really is.
    fn truth(&self, mut robot: Robot) -> Outcome<Robot> {
        for (site, factor) in &self.stiffness {
            let own = robot.springs_mut().find(|s| s.0 == *site);
            match own {
                Some((_, spring)) if *factor > 0.0 && factor.is_finite() => {
                    spring.stiffness *= factor
                }
                _ => {
                    return Err(Problem::new(
                        format!("{}: `stiffness.{site} = {factor}` cannot be", self.file),
                        "name a drive, bearing or elastic axis of the robot and give a factor above zero",
                    ));
                }
            }
        }
        Ok(robot)
    }

    /// The file as its reader would see it, without readings.
    fn test(&self, robot: &str) -> CubeTest {
        let cube = |own: &CubeTruth| Cube {
            name: own.name.clone(),
            after: own.after,
            beyond: own.beyond.clone(),
            centre: own.centre_m,
        };
        CubeTest {
            path: PathBuf::from(&self.file),
            sha256: String::new(),
            facts: Facts {
                robot: robot.into(),
                joint_angles: self.joint_angles_deg.iter().map(|a| a * DEGREE).collect(),
                cubes: self.cubes.iter().map(cube).collect(),
                ..Facts::default()
            },
            readings: Vec::new(),
            left_out: 0,
        }
    }

    fn front(&self, robot: &str, source: &str) -> String {
        let cubes = self.cubes.iter().map(|cube| {
            let beyond = cube
                .beyond
                .iter()
                .map(|b| format!(", beyond = {}", toml::Value::from(b.as_str())));
            format!(
                "#   {{ name = {}, after = {}{}, centre_m = {:?} }},\n",
                toml::Value::from(cube.name.as_str()),
                cube.after,
                beyond.collect::<String>(),
                cube.centre_m
            )
        });
        format!(
            "# kind = \"cubes\"\n\
             # synthetic = true   # simulated by `ident lab`; nobody measured this\n\
             # source = {}\n\
             # robot = {}\n\
             # joint_angles_deg = {:?}\n\
             # sensor_noise_mm = {:?}\n\
             # sensor_noise_mrad = {:?}\n\
             # frame_std_mm = {:?}\n\
             # cubes = [\n{}# ]\n",
            toml::Value::from(source),
            toml::Value::from(robot),
            self.joint_angles_deg,
            self.sensor_noise_mm,
            self.sensor_noise_mrad,
            self.frame_std_mm,
            cubes.collect::<String>()
        )
    }
}
