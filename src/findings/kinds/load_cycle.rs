//! A diagnosed load cycle: its figures and its extended model.

use super::present::{Base, Origin, of_fit, of_robot};
use super::{Diagnosed, Source};
use crate::experiments::load_cycle::Curves;
use crate::findings::Answer;
use crate::findings::engine::Judgement;
use crate::findings::load_cycle::{Diagnosis, Settings, diagnose};
use crate::fit::store::StoredFit;
use crate::ground::problem::Outcome;
use crate::measurement::load_cycle::LoadCycle;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::prefix;
use serde_json::{Map, Value, json};
use std::path::Path;

struct CycleDiagnosis {
    file: LoadCycle,
    found: Diagnosis,
    /// Where the present simulation came from, if not from the file.
    origin: Option<Origin>,
    /// What kept the present simulation from being read.
    remark: Option<String>,
}

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no load cycle.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    let mut file = LoadCycle::read(path)?;
    let (base, remark) = match of_robot(&mut file) {
        Ok(base) => (base, None),
        Err(problem) => (
            None,
            Some(format!("There is no nominal stiffness: {problem}")),
        ),
    };
    Ok(beside(file, base, remark))
}

/// Diagnoses a file of this kind, the present simulation being an earlier fit.
///
/// # Errors
/// The file is no load cycle, or the fit is none of the same joint.
pub fn diagnosed_with(path: &Path, fit: &Path) -> Outcome<Box<dyn Diagnosed>> {
    let mut file = LoadCycle::read(path)?;
    let base = of_fit(&mut file, fit)?;
    Ok(beside(file, Some(base), None))
}

fn beside(file: LoadCycle, base: Option<Base>, remark: Option<String>) -> Box<dyn Diagnosed> {
    let (present, origin) = base.map_or((None, None), |base| (base.present, Some(base.origin)));
    let settings = Settings {
        present,
        ..Settings::default()
    };
    let found = diagnose(&file, &settings);
    Box::new(CycleDiagnosis {
        file,
        found,
        origin,
        remark,
    })
}

impl Diagnosed for CycleDiagnosis {
    fn answer(&self) -> &Answer {
        &self.found
    }

    fn source(&self) -> Source<'_> {
        Source::new(
            &self.file.path,
            &self.file.sha256,
            self.file.facts.synthetic,
        )
    }

    fn about(&self) -> String {
        let robot = self.file.facts.robot.as_deref();
        format!(
            "{} of {}",
            self.file.site(),
            robot.unwrap_or("an unnamed robot")
        )
    }

    fn present(&self) -> Option<String> {
        self.origin.as_ref().map(Origin::sentence)
    }

    fn remarks(&self) -> Vec<String> {
        self.remark.iter().cloned().collect()
    }

    fn more(&self) -> Map<String, Value> {
        let origin = self.origin.as_ref();
        let of = |o: &Origin| ("present".to_string(), o.json());
        let judged = |j: &Judgement| ("judgement".to_string(), json!(j));
        let judged = self.found.judgement.as_ref().map(judged);
        origin.map(of).into_iter().chain(judged).collect()
    }

    fn before_and_after(&self) -> Vec<Chart> {
        vec![before_and_after(self)]
    }

    fn remaining(&self) -> Vec<Chart> {
        vec![remaining(self)]
    }

    fn model(&self) -> Outcome<Option<String>> {
        self.stored().text().map(Some)
    }
}

impl CycleDiagnosis {
    fn stored(&self) -> StoredFit {
        let found = &self.found;
        StoredFit::of(&self.file, &found.model, &found.p, &found.data.scene)
    }
}

/// Measured against simulated: the readings, what the present simulation misses and the extended
/// model explains, and what is left.
fn before_and_after(result: &CycleDiagnosis) -> Chart {
    let found = &result.found;
    let (load, reading) = match found.imposed {
        false => (&found.data.scene.load, &found.data.reading),
        true => (&found.data.reading, &found.data.scene.load),
    };
    let beyond = format!(
        "{} − simulation",
        match found.imposed {
            false => result.file.port.deflection_name(),
            true => result.file.port.load_name(),
        }
    );
    let curves = Curves {
        file: &result.file,
        time: &found.data.scene.time,
        load,
        reading,
        model: &found.extended,
        name: "extended model",
        reference: (&beyond, &found.simulated),
        imposed: found.imposed,
    };
    let simulated = curves.prediction(&found.simulated);
    Chart::new(
        format!("{}-diagnosis", result.file.stem()),
        format!("{}: measured against simulated", result.file.site()),
        format!(
            "Load cycle {} of {}, {} rows. From top to bottom: the readings; what the present simulation misses, over load and over time; what is left with the named causes in the model.",
            result.file.stem(),
            result.file.facts.robot.as_deref().unwrap_or("an unnamed robot"),
            result.file.load.len()
        ),
    )
    .synthetic(result.file.facts.synthetic)
    .with(
        curves
            .loops()
            .with(Series::dashed("present simulation", simulated)),
    )
    .with(curves.beyond_over_load())
    .with(curves.beyond_over_time())
    .with(curves.residual_over_time())
}

fn remaining(result: &CycleDiagnosis) -> Chart {
    let shape = &result.found.unexplained;
    let largest = shape
        .shape
        .iter()
        .chain(&shape.over_time)
        .fold(0.0_f64, |m, p| m.max(p[1].abs()));
    let load = result.found.data.scene.load_scale;
    let (ys, yu) = prefix(largest, result.found.unit);
    let (name, unit) = match result.found.imposed {
        false => (result.file.port.load_name(), result.file.port.load_unit()),
        true => (
            result.file.port.deflection_name(),
            result.file.port.deflection_unit(),
        ),
    };
    let (xs, xu) = prefix(load, unit);
    let scaled = |points: &[[f64; 2]], xs: f64| {
        points
            .iter()
            .map(|p| [p[0] * xs, p[1] * ys])
            .collect::<Vec<_>>()
    };
    let axis = || Axis::new("Mean residual", yu.clone());
    let noise = result.found.discrepancy.noise_rms * ys;
    let band = |points: &[[f64; 2]], xs: f64| {
        let edges: Vec<[f64; 3]> = points.iter().map(|p| [p[0] * xs, -noise, noise]).collect();
        Series::band("± noise of one reading", &edges)
    };
    Chart::new(
        format!("{}-remaining", result.file.stem()),
        "What no named cause explains",
        "Mean of measured − extended model in twelve bins of load and of time. The band, for scale, is the noise of one reading.",
    )
    .synthetic(result.file.facts.synthetic)
    .with(
        Panel::new(Axis::new(name, xu), axis())
            .with(band(&shape.shape, xs))
            .with(Series::line("mean residual", scaled(&shape.shape, xs))),
    )
    .with(
        Panel::new(Axis::new("Time", "s"), axis())
            .with(band(&shape.over_time, 1.0))
            .with(Series::line("mean residual", scaled(&shape.over_time, 1.0))),
    )
}
