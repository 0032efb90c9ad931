//! A diagnosed force sensor: its figures.

use super::{Diagnosed, Measured, Source, examined};
use crate::findings::engine::{Found, Judgement};
use crate::findings::force_sensor::Case;
use crate::fit::suitability::{self, Doubt};
use crate::ground::problem::Outcome;
use crate::measurement::force_sensor::SensorTest;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use std::path::Path;

/// Times the stated noise at which what is left scatters by more than noise: data sheets are right within a factor of
/// two (as `load_cycle/noise.rs` holds). No other value was tried.
const NOISE_BEYOND: f64 = 2.0;

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no force-sensor test.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    Ok(examined(Case::new(SensorTest::read(path)?)?))
}

impl Measured for Case {
    fn source(&self) -> Source<'_> {
        Source::of(&self.test, self.test.facts.synthetic)
    }

    fn about(&self) -> String {
        match &self.test.facts.robot {
            Some(robot) => format!("force sensor of {robot}"),
            None => "force sensor".into(),
        }
    }

    fn doubts(&self) -> Vec<Doubt> {
        suitability::force_sensor::doubts(&self.test)
    }

    /// Statics add up exactly: a tilt is named beside a weight three thousand times as large. Set on seeds 121 to 129 of
    /// `tests/judge/force_sensor.rs`, with two thousandths tried.
    fn judgement(&self) -> Judgement {
        Judgement {
            peak: 1.0,
            share: 0.0003,
            noise_beyond: match self.test.facts.noise {
                [Some(_), Some(_)] => NOISE_BEYOND,
                _ => f64::INFINITY,
            },
            ..Judgement::default()
        }
    }

    fn before_and_after(&self, found: &Found) -> Vec<Chart> {
        let chart = Chart::new(
            format!("{}-orientations", self.test.stem()),
            "Error over the orientations",
            "Measured less simulated in every reading, before (lines) and after the named causes (points).",
        );
        vec![self.over(
            chart,
            &[("", &found.missed, true), (", after", &found.left, false)],
        )]
    }

    fn remaining_figures(&self, found: &Found) -> Vec<Chart> {
        let chart = Chart::new(
            format!("{}-left", self.test.stem()),
            "What is left over the orientations",
            "One reading that stands out is an outlier; a trend is a drift; anything smooth over neighbouring orientations is a load that no cause explains.",
        );
        vec![self.over(chart, &[("", &found.left, false)])]
    }
}

impl Case {
    /// Forces and moments over the number of the reading.
    fn over(&self, mut chart: Chart, series: &[(&str, &Vec<f64>, bool)]) -> Chart {
        for (label, unit, first, names, factor) in [
            ("Force", "N", 0, ["Fx", "Fy", "Fz"], 1.0),
            ("Moment", "N·m", 3, ["Mx", "My", "Mz"], self.arm),
        ] {
            let mut panel = Panel::new(Axis::new("Reading", ""), Axis::new(label, unit));
            for (ending, values, line) in series {
                for (k, name) in names.iter().enumerate() {
                    let points = (0..self.test.readings.len())
                        .map(|i| [(i + 1) as f64, values[6 * i + first + k] * factor])
                        .collect();
                    let name = format!("{name}{ending}");
                    panel = panel.with(if *line {
                        Series::line(name, points)
                    } else {
                        Series::points(name, points)
                    });
                }
            }
            chart = chart.with(panel);
        }
        chart.synthetic(self.test.facts.synthetic)
    }
}
