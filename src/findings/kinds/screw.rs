//! A diagnosed screw: its figures.

use super::{Diagnosed, Measured, Source, examined};
use crate::findings::engine::{Found, Judgement};
use crate::findings::screw::Case;
use crate::fit::screw::positions::in_mm;
use crate::fit::suitability::{self, Doubt};
use crate::ground::problem::Outcome;
use crate::measurement::screw::ScrewTest;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use std::path::Path;

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no screw test.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    Ok(examined(Case::new(ScrewTest::read(path)?)))
}

impl Measured for Case {
    fn source(&self) -> Source<'_> {
        Source::of(&self.test, self.test.facts.synthetic)
    }

    fn about(&self) -> String {
        format!("linear axis {}", self.test.stem())
    }

    fn doubts(&self) -> Vec<Doubt> {
        suitability::screw::doubts(&self.test)
    }

    /// The same targets are read run after run: what is no larger than the noise of one reading is plain in all of
    /// them. A lead bows and a screw winds up by some hundredths of their error.
    fn judgement(&self) -> Judgement {
        Judgement {
            peak: 0.8,
            share: 0.03,
            companion_gain: 0.2,
            ..Judgement::default()
        }
    }

    fn before_and_after(&self, found: &Found) -> Vec<Chart> {
        let x = || Axis::new("Target", "mm");
        let mut chart = Chart::new(
            format!("{}-travel", self.test.stem()),
            "Error over the travel",
            "Means of the ways forth and back as measured, and what the named causes make of them; below what they leave of every reading.",
        )
        .synthetic(self.test.facts.synthetic);
        let mut panel = Panel::new(x(), Axis::new("Actual − target", "µm"));
        for (name, side) in [("forward", -0.5), ("backward", 0.5)] {
            if self.side.contains(&side) {
                panel = panel
                    .with(Series::points(
                        format!("{name}, measured"),
                        self.mean(&found.missed, side),
                    ))
                    .with(Series::line(
                        format!("{name}, named causes"),
                        self.mean(&found.explained, side),
                    ));
            }
        }
        chart = chart.with(panel);
        let left = self
            .test
            .readings
            .iter()
            .zip(&found.left)
            .map(|(r, l)| [in_mm(r.target), l * 1e6]);
        chart = chart.with(
            Panel::new(x(), Axis::new("Left", "µm")).with(Series::points("left", left.collect())),
        );
        vec![chart]
    }

    fn remaining_figures(&self, found: &Found) -> Vec<Chart> {
        let points = found
            .left
            .iter()
            .enumerate()
            .map(|(i, l)| [(i + 1) as f64, l * 1e6]);
        let panel = Panel::new(Axis::new("Reading", ""), Axis::new("Left", "µm"))
            .with(Series::points("left", points.collect()));
        vec![
            Chart::new(
                format!("{}-left", self.test.stem()),
                "What is left, in the order of the readings",
                "A drift or a step here is something that happened during the test.",
            )
            .with(panel)
            .synthetic(self.test.facts.synthetic),
        ]
    }

    fn remarks(&self, _: &Found) -> Vec<String> {
        self.sight
            .sentence()
            .map(|s| format!("{}{}.", s[..1].to_uppercase(), &s[1..]))
            .into_iter()
            .collect()
    }
}

impl Case {
    /// Means per target of one direction: mm, µm.
    fn mean(&self, values: &[f64], side: f64) -> Vec<[f64; 2]> {
        let mut sums: Vec<(f64, f64, f64)> = Vec::new();
        for (i, reading) in self
            .test
            .readings
            .iter()
            .enumerate()
            .filter(|(i, _)| self.side[*i] == side)
        {
            match sums.iter_mut().find(|s| s.0 == reading.target) {
                Some(sum) => (sum.1, sum.2) = (sum.1 + values[i], sum.2 + 1.0),
                None => sums.push((reading.target, values[i], 1.0)),
            }
        }
        sums.sort_by(|a, b| a.0.total_cmp(&b.0));
        sums.iter()
            .map(|(x, sum, n)| [in_mm(*x), sum / n * 1e6])
            .collect()
    }
}
