//! Diagnosed measuring cubes: their figures.

use super::{Diagnosed, Measured, Source, examined};
use crate::findings::cubes::Case;
use crate::findings::engine::{Found, Judgement};
use crate::fit::suitability::{self, Doubt};
use crate::ground::problem::Outcome;
use crate::ground::stats::rms;
use crate::measurement::cubes::CubeTest;
use crate::robot::load;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use std::path::Path;

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no cubes test, or does not fit its robot.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    let test = CubeTest::read(path)?;
    let robot = load(&test.facts.robot, Some(path)).map_err(|p| p.in_file(path))?;
    Ok(examined(Case::new(test, robot.robot)?))
}

impl Measured for Case {
    fn source(&self) -> Source<'_> {
        Source::of(&self.test, self.test.facts.synthetic)
    }

    fn about(&self) -> String {
        format!("measuring cubes of {}", self.test.facts.robot)
    }

    fn doubts(&self) -> Vec<Doubt> {
        suitability::cubes::doubts(&self.test, &self.robot)
    }

    /// A robot's springs add up exactly: a joint of the wrist is named beside a foundation that moves everything ten times
    /// as far. Set on seeds 113 and 114 of `tests/judge`, where 0.003 and 0.03 choose nearly alike.
    fn judgement(&self) -> Judgement {
        Judgement {
            share: 0.01,
            // an arm that hardens was a loose cube, with all that could take its place two and a half times as probable as nothing; no other value
            // was tried
            over_none: 3.0,
            ..Judgement::default()
        }
    }

    fn before_and_after(&self, found: &Found) -> Vec<Chart> {
        let mut chart = Chart::new(
            format!("{}-structure", self.test.stem()),
            "Error over the structure",
            "Root mean square of measured less simulated at every cube, from the foundation to the tool, before and after the named causes.",
        )
        .synthetic(self.test.facts.synthetic);
        for (label, unit, first, factor) in [
            ("Displacement", "µm", 0, 1e6),
            ("Rotation", "µrad", 3, 1e6 / self.arm),
        ] {
            let names = self.test.facts.cubes.iter().map(|cube| cube.name.clone());
            let bars = |name: &str, rows: &[f64]| {
                let cubes = 0..self.test.facts.cubes.len();
                let values: Vec<f64> = cubes
                    .map(|cube| self.rms(rows, cube, first) * factor)
                    .collect();
                Series::bars(name, &values)
            };
            let panel = Panel::new(Axis::new("Cube", ""), Axis::new(label, unit))
                .over(names)
                .with(bars("present simulation", &found.missed))
                .with(bars("with the named causes", &found.left));
            chart = chart.with(panel);
        }
        vec![chart]
    }

    fn remaining_figures(&self, found: &Found) -> Vec<Chart> {
        let points = |kind: usize| {
            let own = self
                .rows
                .iter()
                .zip(&found.left)
                .enumerate()
                .filter(move |(_, (row, _))| row.component / 3 == kind);
            own.map(|(i, (_, left))| [(i + 1) as f64, left * 1e6])
                .collect()
        };
        let panel = Panel::new(Axis::new("Number in the file", ""), Axis::new("Left", "µm"))
            .with(Series::points("displacements", points(0)))
            .with(Series::points(
                "rotations, as displacement of equal noise",
                points(1),
            ));
        vec![
            Chart::new(format!("{}-left", self.test.stem()), "What is left", "Numbers in the order of the file: a block that stands out is one test or one cube.")
                .with(panel)
                .synthetic(self.test.facts.synthetic),
        ]
    }
}

impl Case {
    /// Root mean square at a cube over displacements (from 0) or rotations (from 3), m.
    fn rms(&self, values: &[f64], cube: usize, first: usize) -> f64 {
        let own: Vec<f64> = self
            .rows
            .iter()
            .zip(values)
            .filter(|(r, _)| r.cube == cube && r.component / 3 == first / 3)
            .map(|(_, v)| *v)
            .collect();
        rms(&own)
    }
}
