//! A diagnosed hammer test: its figures and its extended robot.

use super::hammer_figures;
use super::{Diagnosed, Source};
use crate::findings::belief::Belief;
use crate::findings::hammer::{Diagnosis, diagnose};
use crate::findings::{Answer, Verdict};
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::hammer::HammerRecord;
use crate::measurement::hammer_uff::read_any;
use crate::robot::load::load;
use crate::robot::{Robot, write};
use crate::sheet::chart::Chart;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

struct HammerDiagnosis {
    path: PathBuf,
    record: HammerRecord,
    robot: Robot,
    found: Diagnosis,
}

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no hammer test, names no robot or no pose, or holds no usable hit.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    let record = read_any(path)?;
    if record.given.is_some() {
        let what = "holds frequency responses without the hits behind them";
        let remedy = "diagnose the time records of the hits; `ident damping --frf` and `ident frf --modes` read this file";
        return Err(Problem::new(what, remedy).in_file(path));
    }
    let Some(name) = record.robot.clone() else {
        let problem = Problem::new("names no robot", "write `# robot = \"kr210\"`");
        return Err(problem.in_column("robot").in_file(path));
    };
    let robot = load(&name, Some(path))?.robot;
    let found = diagnose(&record, &robot).map_err(|problem| problem.in_text(path))?;
    Ok(Box::new(HammerDiagnosis {
        path: path.to_path_buf(),
        record,
        robot,
        found,
    }))
}

impl HammerDiagnosis {
    fn stem(&self) -> String {
        let stem = self.path.file_stem().unwrap_or_default();
        format!("{}-diagnosis", stem.to_string_lossy())
    }

    fn labelled(&self, charts: Vec<Chart>) -> Vec<Chart> {
        let synthetic = self.record.synthetic;
        charts.into_iter().map(|c| c.synthetic(synthetic)).collect()
    }
}

impl Diagnosed for HammerDiagnosis {
    fn answer(&self) -> &Answer {
        &self.found.answer
    }

    fn source(&self) -> Source<'_> {
        Source::new(&self.path, &self.record.sha256, self.record.synthetic)
    }

    fn about(&self) -> String {
        format!("hammer test of {}", self.robot.name)
    }

    fn before_and_after(&self) -> Vec<Chart> {
        let charts = hammer_figures::before_and_after(&self.found, &self.stem());
        self.labelled(charts)
    }

    fn remaining(&self) -> Vec<Chart> {
        self.labelled(hammer_figures::remaining(&self.found, &self.stem()))
    }

    fn robot(&self) -> Option<&Robot> {
        Some(&self.robot)
    }

    fn extended(&self) -> Option<&Robot> {
        self.found.extended.as_ref().or(Some(&self.robot))
    }

    fn under(&self, robot: &Robot) -> Option<Box<dyn Diagnosed>> {
        let found = diagnose(&self.record, robot).ok()?;
        Some(Box::new(HammerDiagnosis {
            path: self.path.clone(),
            record: self.record.clone(),
            robot: robot.clone(),
            found,
        }))
    }

    fn remarks(&self) -> Vec<String> {
        let hits = self.found.frf.screened.iter();
        let left_out: Vec<String> = hits
            .filter_map(|hit| Some(format!("{} {} ({})", hit.direction, hit.hit, hit.why()?)))
            .collect();
        let mut said = self.found.frf.remarks.clone();
        if !left_out.is_empty() {
            said.push(format!("Hits left out: {}.", left_out.join("; ")));
        }
        said
    }

    fn belief(&self) -> Option<&Belief> {
        let answer = self.answer();
        let known = answer.verdict != Verdict::UnknownCause && !answer.is_withheld();
        known.then_some(&self.found.belief)
    }

    fn model(&self) -> Outcome<Option<String>> {
        let text = |robot: &Robot| write::labelled(robot, self.record.synthetic);
        Ok(self.found.extended.as_ref().map(text))
    }

    fn more(&self) -> Map<String, Value> {
        let left_out = self.found.frf.screened.iter().filter_map(|hit| {
            let why = hit.why()?;
            Some(json!({"direction": hit.direction, "hit": hit.hit, "why": why}))
        });
        let mut map = Map::new();
        map.insert("hits_rejected".into(), left_out.collect());
        map.insert("remarks".into(), json!(self.found.frf.remarks));
        map
    }
}
