//! The readable truth of the hammer tests of a campaign, and the files they make.

use super::hammer_blow::{Blow, Instrument, strike};
use super::recording::{Recording, head};
use super::truth::LoadCycleTruth;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use crate::motion;
use crate::robot::{Robot, Spring, check, load};
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Hammer tests of one robot at one pose.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HammerTruth {
    /// Joint angles of the pose.
    pub joint_angles_deg: Vec<f64>,
    /// What records the hits.
    pub instrument: Instrument,
    /// Hits per direction.
    pub hits: usize,
    /// Range of the peak forces.
    #[serde(rename = "peak_N")]
    pub peak: [f64; 2],
    /// Range of the lengths of the pulses.
    pub pulse_s: [f64; 2],
    /// The hit that bounces, as `x4`.
    pub double: Option<String>,
    /// The hit that overloads the force channel, as `y2`.
    pub overloaded: Option<String>,
    /// True dampings by site; sites left out keep the robot file's.
    #[serde(rename = "damping_Nms_rad")]
    pub damping: BTreeMap<String, f64>,
    /// The files.
    pub file: Vec<HammerFile>,
}

/// One file of hammer tests.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HammerFile {
    /// File to write.
    pub name: String,
    /// Whether the joints have the play that the load cycles hide.
    pub backlash: bool,
    /// `comparison`: used only when it is named.
    pub role: Option<String>,
}

/// Directions of the hits, base axes.
const DIRECTIONS: [&str; 3] = ["x", "y", "z"];

impl HammerTruth {
    /// The robot that is struck: `robot` with the true stiffnesses and dampings, and the play of the
    /// load cycles if asked for.
    pub fn robot(&self, robot: &str, tests: &[LoadCycleTruth], backlash: bool) -> Outcome<Robot> {
        let mut truth = load(robot, None)?.robot;
        for test in tests {
            if let Some(spring) = spring(&mut truth, &site(test)) {
                spring.stiffness = test.stiffness;
                let gap = test.effects.get("backlash").and_then(|p| p.get("gap"));
                spring.backlash = gap.filter(|_| backlash).copied().into_iter().collect();
            }
        }
        for (site, damping) in &self.damping {
            let spring = spring(&mut truth, site).ok_or_else(|| {
                Problem::new(
                    format!("`{site}` is no elastic joint of {robot}"),
                    "name drives as `A6` and bearings as `A6-tilt`",
                )
            })?;
            spring.damping = *damping;
        }
        Ok(truth)
    }

    /// Simulates one file.
    ///
    /// # Errors
    /// A robot that cannot move, or numbers that no test has.
    pub fn record(
        &self,
        file: &HammerFile,
        robot: (&str, &str),
        tests: &[LoadCycleTruth],
        seed: u64,
    ) -> Outcome<Recording> {
        self.check(&file.name)?;
        let truth = self.robot(robot.0, tests, file.backlash)?;
        check::dynamics(&truth)?;
        let (chain, joints) = (motion::elastic(&truth), self.joints(&truth)?);
        let blows = self.blows(seed);
        let struck: Vec<Vec<[f64; 5]>> = blows
            .par_iter()
            .map(|blow| strike(&chain, &joints, &self.instrument, blow))
            .collect::<Outcome<_>>()?;
        Ok(self.recording(file, robot, &blows, &struck))
    }

    fn joints(&self, truth: &Robot) -> Outcome<Vec<f64>> {
        let given = self.joint_angles_deg.len();
        if given != truth.dof() {
            return Err(Problem::new(
                format!("{given} joint angles, the robot has {}", truth.dof()),
                "write one angle per joint",
            )
            .in_column("joint_angles_deg"));
        }
        let degree = crate::ground::units::DEGREE;
        Ok(self.joint_angles_deg.iter().map(|q| q * degree).collect())
    }

    fn blows(&self, seed: u64) -> Vec<Blow> {
        let mut random = Random::new(seed);
        let mut blows = Vec::new();
        for (axis, direction) in DIRECTIONS.iter().enumerate() {
            for hit in 1..=self.hits {
                let name = Some(format!("{direction}{hit}"));
                blows.push(Blow {
                    axis,
                    hit,
                    peak: random.uniform(self.peak[0], self.peak[1]),
                    pulse_s: random.uniform(self.pulse_s[0], self.pulse_s[1]),
                    double: self.double == name,
                    overloaded: self.overloaded == name,
                    seed: random.bits(),
                });
            }
        }
        blows
    }

    fn recording(
        &self,
        file: &HammerFile,
        robot: (&str, &str),
        blows: &[Blow],
        struck: &[Vec<[f64; 5]>],
    ) -> Recording {
        let rows = || {
            blows
                .iter()
                .zip(struck)
                .flat_map(|(b, r)| r.iter().map(move |row| (b, row)))
        };
        let column = |k: usize| rows().map(|(_, row)| row[k]).collect();
        Recording {
            facts: self.facts(file, robot),
            columns: vec![
                "direction",
                "hit",
                "time_s",
                "force_N",
                "ax_m_s2",
                "ay_m_s2",
                "az_m_s2",
            ],
            words: rows().map(|(blow, _)| DIRECTIONS[blow.axis]).collect(),
            decimals: vec![0, 4, 2, 4, 4, 4],
            values: std::iter::once(rows().map(|(blow, _)| blow.hit as f64).collect())
                .chain((0..5).map(column))
                .collect(),
        }
    }

    fn facts(&self, file: &HammerFile, (robot, source): (&str, &str)) -> Vec<String> {
        let mut facts = head("hammer", robot, source);
        facts.extend([
            format!("joint_angles_deg = {:?}", self.joint_angles_deg),
            format!(
                "accelerometer_noise_m_s2 = {:?}",
                self.instrument.accelerometer_noise
            ),
        ]);
        let play = if file.backlash {
            "with the play of truth.toml"
        } else {
            "without play"
        };
        facts.push(format!("condition = \"{play}\""));
        let role = file.role.as_deref();
        facts.extend(role.map(|role| format!("role = {}", toml::Value::from(role))));
        facts
    }

    fn check(&self, name: &str) -> Outcome<()> {
        let i = &self.instrument;
        let positive = [i.interval_s, i.length_s, self.peak[0], self.pulse_s[0]];
        let rows = (i.length_s / i.interval_s) * (3 * self.hits) as f64;
        let sound = positive.iter().all(|x| *x > 0.0 && x.is_finite());
        if sound && self.hits > 0 && i.steps > 0 && rows * (i.steps as f64) < 1e8 {
            return Ok(());
        }
        Err(Problem::new(
            format!("{name}: no hammer test has these numbers"),
            "give positive times, forces and hits, and fewer than 100 million steps",
        ))
    }
}

/// Site of the spring that a load cycle tests.
fn site(test: &LoadCycleTruth) -> String {
    let tilt = if test.axis == "tilt" { "-tilt" } else { "" };
    format!("A{}{tilt}", test.joint)
}

fn spring<'a>(robot: &'a mut Robot, site: &str) -> Option<&'a mut Spring> {
    robot
        .springs_mut()
        .find(|(name, _)| name == site)
        .map(|(_, spring)| spring)
}
