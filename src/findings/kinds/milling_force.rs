//! Diagnosed cuts: their figures.

use super::{Diagnosed, Measured, Source, examined};
use crate::findings::engine::{Found, Judgement};
use crate::findings::milling_force::{Case, CutSamples};
use crate::fit::suitability::{self, Doubt};
use crate::ground::problem::Outcome;
use crate::measurement::milling_force::{IN_AIR, MillingForce};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use std::f64::consts::TAU;
use std::path::Path;

/// Peak of a cause's own part below which it is too small to be named, in noise deviations over the root of the revolutions. An
/// offset acts on all readings alike and has no more of a peak than of a mean: at 2 one of 1.2 deviations was put aside,
/// and a drift named for it (seed 434 of `tests/judge`). On seeds 433 to 436 1 finds one single cause
/// more than 1.5 and as many untrue ones; the more careful is kept.
const PEAK: f64 = 1.5;

/// Places of a revolution that are drawn.
const PLACES: usize = 120;
/// Cuts that are drawn.
const DRAWN: usize = 4;
/// Times by which what is left may scatter beyond the noise, stated and estimated from neighbours (who do not see slow
/// noise). Set on seeds 201 to 204 of `tests/judge`.
const NOISE_BEYOND: [f64; 2] = [1.7, 2.5];
/// Share of all that is named below which a cause is none, whatever the laws of the others miss
/// (`Effect::law_error`): a zero of the sensor is plain beside a speed that shifts every wave. Set on seeds
/// 401 to 405 of `tests/judge`, with 0.03 and 0.09 tried.
const LEAST_SHARE: f64 = 0.005;
/// Share of itself that no law of a cutting force comes nearer to nature. Two clean files of seeds 481 to 483 of `tests/judge` had
/// a cause that explained 0.0003 and 0.0006 of the force, and of five more that were looked at the least one 0.017.
const LAW: f64 = 1e-3;
/// Nats that what is smaller than that is worth. On 60 cuts by a stranger 17 of 24 single causes and 6 of 15 pairs were named with 14 (12 and 4
/// without it, 15 and 5 with 25), the same 11 of 12 clean ones left alone.
const FAINT: f64 = 14.0;
/// Points over time that are drawn.
const POINTS: usize = 600;

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no record of milling forces.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    Ok(examined(Case::new(MillingForce::read(path)?)))
}

impl Measured for Case {
    fn source(&self) -> Source<'_> {
        Source::new(
            &self.file().path,
            &self.file().sha256,
            self.file().facts.synthetic,
        )
    }

    fn about(&self) -> String {
        match self.cuts().len() {
            1 => "the forces of a cut".into(),
            n => format!("the forces of {n} cuts"),
        }
    }

    fn doubts(&self) -> Vec<Doubt> {
        suitability::milling_force::doubts(self.file())
    }

    /// A cut repeats itself with every revolution of the spindle: what is smaller than the noise of one reading is
    /// plain in so many, and a zero of the sensor, which is the same in all cuts, in those of all. Another width shows on a narrow part of
    /// the turn. What scatters far beyond the noise is none.
    fn judgement(&self) -> Judgement {
        let usual = Judgement::default();
        let cuts = self.cuts().len() as f64;
        Judgement {
            peak: PEAK / self.revolutions().max(1.0).sqrt(),
            exact_peak: Some(PEAK / (self.revolutions() * cuts).max(1.0).sqrt()),
            faint_nats: FAINT,
            peak_above: 0.995,
            share: LEAST_SHARE,
            negligible: LAW * self.force_rms(),
            noise_beyond: NOISE_BEYOND[usize::from(self.file().facts.sensor_noise_n.is_none())],
            ..usual
        }
    }

    fn before_and_after(&self, found: &Found) -> Vec<Chart> {
        let drawn = self.cuts().iter().enumerate().take(DRAWN);
        drawn.map(|(i, cut)| self.wave(i, cut, found)).collect()
    }

    fn remaining_figures(&self, found: &Found) -> Vec<Chart> {
        let mut panel = Panel::new(Axis::new("Time", "s"), Axis::new("Left", "N"));
        for (k, name) in ["Fx", "Fy", "Fz"].iter().enumerate() {
            let all = self.cuts().iter().flat_map(|cut| {
                let rows = 0..cut.time.len();
                rows.map(|i| [cut.time[i], found.left[3 * (cut.first + i) + k]])
            });
            let all: Vec<[f64; 2]> = all.collect();
            let every = all.len().div_ceil(POINTS).max(1);
            let points = all.into_iter().step_by(every).collect();
            panel = panel.with(Series::points(*name, points));
        }
        vec![
            Chart::new(
                format!("{}-left", self.file().stem()),
                "What is left over time",
                "Measured force on the tool less the simulation with the named causes. A slope is a drift; what differs from cut to cut is a fact of the cut.",
            )
            .with(panel)
            .synthetic(self.file().facts.synthetic),
        ]
    }

    fn remarks(&self, _: &Found) -> Vec<String> {
        let mut remarks = Vec::new();
        if self.file().facts.nominal.is_none() {
            remarks.push("No `nominal` coefficients are stated: those of a fit stand in, and coefficients cannot be blamed.".into());
        }
        let in_air = self.file().in_air;
        if in_air > 0 {
            remarks.push(format!("{in_air} rows are left out {IN_AIR}."));
        }
        remarks
    }
}

impl Case {
    /// One cut over the turn of the spindle: measured, simulated, simulated with the named causes.
    fn wave(&self, number: usize, cut: &CutSamples, found: &Found) -> Chart {
        let mut chart = Chart::new(
            format!("{}-cut-{}", self.file().stem(), number + 1),
            format!("Force on the tool in cut {}", number + 1),
            "Means over the turn of the spindle: measured, simulated as stated, and simulated with the named causes.",
        )
        .synthetic(self.file().facts.synthetic);
        for (k, name) in ["Fx", "Fy", "Fz"].iter().enumerate() {
            let row = |i: usize| 3 * (cut.first + i) + k;
            let measured = |i: usize| cut.measured[i][k];
            let before = self.folded(cut, &|i| measured(i) - found.missed[row(i)]);
            let after = self.folded(cut, &|i| measured(i) - found.left[row(i)]);
            let panel = Panel::new(Axis::new("Angle of tooth 1", "°"), Axis::new(*name, "N"))
                .with(Series::points("measured", self.folded(cut, &measured)))
                .with(Series::line("as stated", before))
                .with(Series::line("with the named causes", after));
            chart = chart.with(panel);
        }
        chart
    }

    /// Means over the angle of tooth 1, degrees.
    fn folded(&self, cut: &CutSamples, of: &dyn Fn(usize) -> f64) -> Vec<[f64; 2]> {
        let mut sums = vec![(0.0, 0.0); PLACES];
        let angles = cut.present.scene.angles(&cut.present.p);
        for (i, angle) in angles.iter().enumerate() {
            let place = (angle.rem_euclid(TAU) / TAU * PLACES as f64) as usize % PLACES;
            sums[place].0 += of(i);
            sums[place].1 += 1.0;
        }
        let seen = sums.iter().enumerate().filter(|(_, s)| s.1 > 0.0);
        seen.map(|(i, s)| [(i as f64 + 0.5) * 360.0 / PLACES as f64, s.0 / s.1])
            .collect()
    }
}
