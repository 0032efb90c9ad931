//! A diagnosed joint motion: its figures and what it stores.

use super::{Diagnosed, Source};
use crate::findings::Answer;
use crate::findings::joint_motion::{JointFinding, MotionDiagnosis, diagnose, judgement};
use crate::fit::joint_motion_store::{SCHEMA, StoredCause, StoredMotion, StoredValue};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::ground::stats::largest;
use crate::measurement::joint_motion::JointMotion;
use crate::robot;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::prefix;
use serde_json::{Map, Value, json};
use std::path::Path;

struct Motion {
    file: JointMotion,
    found: MotionDiagnosis,
}

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no joint motion, or the robot it names cannot be read.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    let file = JointMotion::read(path)?;
    let named = file.facts.robot.as_deref();
    let robot = named
        .map(|name| robot::load(name, Some(path)))
        .transpose()?;
    let found = diagnose(&file, robot.as_ref().map(|r| &r.robot));
    Ok(Box::new(Motion { file, found }))
}

impl Diagnosed for Motion {
    fn answer(&self) -> &Answer {
        &self.found.answer
    }

    fn source(&self) -> Source<'_> {
        Source::new(
            &self.file.path,
            &self.file.sha256,
            self.file.facts.synthetic,
        )
    }

    fn about(&self) -> String {
        let sites: Vec<&str> = self.found.joints.iter().map(|j| j.site.as_str()).collect();
        let robot = self.file.facts.robot.as_deref();
        format!(
            "motion of {} of {}",
            sites.join(", "),
            robot.unwrap_or("an unnamed robot")
        )
    }

    fn before_and_after(&self) -> Vec<Chart> {
        self.found.joints.iter().map(|j| self.measured(j)).collect()
    }

    fn remaining(&self) -> Vec<Chart> {
        vec![self.left()]
    }

    fn remarks(&self) -> Vec<String> {
        self.found.remarks.clone()
    }

    fn model(&self) -> Outcome<Option<String>> {
        self.stored().text().map(Some)
    }

    fn more(&self) -> Map<String, Value> {
        let mut map = Map::new();
        map.insert("parameters".into(), json!(self.found.parameters));
        map.insert("remarks".into(), json!(self.found.remarks));
        map.insert("judgement".into(), json!(judgement()));
        map
    }
}

impl Motion {
    fn stem(&self) -> String {
        let stem = self.file.path.file_stem().unwrap_or_default();
        stem.to_string_lossy().to_string()
    }

    fn stored(&self) -> StoredMotion {
        let answer = &self.found.answer;
        let value = |(name, value, unit): &(&str, f64, &str)| StoredValue {
            name: (*name).into(),
            value: *value,
            unit: (*unit).into(),
        };
        let causes = answer.causes.iter().map(|c| StoredCause {
            effect: c.effect.into(),
            site: c.site.clone(),
            parameters: c.parameters.iter().map(value).collect(),
        });
        let input = files::name(&self.file.path);
        StoredMotion {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            input,
            input_sha256: self.file.sha256.clone(),
            synthetic: self.file.facts.synthetic,
            robot: self.file.facts.robot.clone(),
            verdict: answer.verdict.name().into(),
            causes: causes.collect(),
            parameters: self.found.parameters.clone(),
        }
    }

    /// Twist over time and over speed, measured against simulated and explained, and what is left.
    fn measured(&self, joint: &JointFinding) -> Chart {
        let data = &joint.data;
        let (scale, unit) = prefix(largest(&data.twist), "rad");
        let left = joint.residual();
        let (fine, fine_unit) = prefix(largest(&left), "rad");
        let time = || Axis::new("Time", "s");
        let twist = || Axis::new("Link − motor", unit.clone());
        let over = |x: &[f64], y: &[f64], scale: f64| -> Vec<[f64; 2]> {
            x.iter().zip(y).map(|(x, y)| [*x, scale * y]).collect()
        };
        let speed: Vec<f64> = data.speed.iter().map(|v| v.to_degrees()).collect();
        let curves = |panel: Panel, x: &[f64]| {
            panel
                .with(Series::line("measured", over(x, &data.twist, scale)))
                .with(Series::dotted(
                    "present simulation",
                    over(x, &joint.simulated, scale),
                ))
                .with(Series::dashed(
                    "with the named causes",
                    over(x, &joint.explained, scale),
                ))
        };
        Chart::new(
            format!("{}-{}-twist", self.stem(), joint.site.to_lowercase()),
            format!("{}: difference of the encoders", joint.site),
            format!(
                "Link angle less motor angle of {} in {}, its mean taken out. From top to bottom: over time; over speed, where a delay is a straight line; what the named causes leave.",
                joint.site,
                self.stem()
            ),
        )
        .synthetic(self.file.facts.synthetic)
        .with(curves(Panel::new(time(), twist()), &data.time))
        .with(curves(
            Panel::new(Axis::new("Joint speed", "deg/s"), twist()),
            &speed,
        ))
        .with(
            Panel::new(time(), Axis::new("Left", fine_unit))
                .with(Series::line("what is left", over(&data.time, &left, fine))),
        )
    }

    /// What is left over torque, joint by joint.
    fn left(&self) -> Chart {
        let chart = Chart::new(
            format!("{}-left", self.stem()),
            "What no named cause explains, over torque",
            "Measured less explained difference of the encoders over the motor's torque on the link side. A spring that the model misses would be a slope, a gap a step at zero.",
        )
        .synthetic(self.file.facts.synthetic);
        self.found.joints.iter().fold(chart, |chart, joint| {
            let left = joint.residual();
            let (scale, unit) = prefix(largest(&left), "rad");
            let (load_scale, load_unit) = prefix(largest(&joint.data.torque), "N·m");
            let torque = joint.data.torque.iter();
            let points = torque.zip(&left).map(|(t, y)| [t * load_scale, y * scale]);
            chart.with(
                Panel::new(
                    Axis::new("Torque", load_unit),
                    Axis::new(format!("Left at {}", joint.site), unit),
                )
                .with(Series::points("what is left", points.collect())),
            )
        })
    }
}
