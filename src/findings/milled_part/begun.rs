//! A part and its job, milled as the job says and with springs alone, before it is decided which of them carries the tool in every trial.

use super::counted::Counted;
use super::stations::{Row, Station, placed, rows};
use super::still::{Probe, Simulated, is_still, lacks};
use super::tried::left;
use super::uncertain::Known;
use super::{Case, LEAST, probe, seen};
use crate::findings::engine::{Found, Nuisance, Statement};
use crate::ground::problem::Outcome;
use crate::ground::spatial::dot;
use crate::ground::stats::{difference, rms};
use crate::measurement::milled_part::PartTest;
use crate::process::Planned;
use crate::process::setup::{Setup, Support};
use std::sync::Arc;

/// Deviations of the probe, rms, from which the swing of the robot shows on the part. A choice, no measurement.
const SWINGS: f64 = 2.0;
/// The same from which it is asked whether the part shows that swing. A choice, no measurement.
const SWAYS: f64 = 0.2;
/// Steps of the simulated job beyond which trials are not coupled in time: some two hundred of them take minutes then. A choice for
/// time, no measurement.
const LONGEST: usize = 1_500_000;

/// A part that was milled as the job says.
pub struct Begun {
    /// The file.
    pub(super) test: Arc<PartTest>,
    /// The job.
    pub(super) planned: Arc<Planned>,
    /// The same, ready to be milled.
    pub(super) setup: Setup,
    /// How the file counts its arc length.
    pub(super) counted: Counted,
    /// Milled as the job says.
    coupled: Milled,
    /// What the swing adds to every row of it, m.
    swing: Vec<f64>,
    /// Whether the part plainly shows nothing of that.
    is_still: bool,
}

/// The job as it is simulated, where it was probed.
#[derive(Clone)]
pub(super) struct Milled {
    pub stations: Vec<Station>,
    pub rows: Vec<Row>,
    /// What is left, row by row, m.
    pub simulated: Vec<f64>,
    /// Steps of the run.
    steps: usize,
}

/// What carries the tool, and why.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Carried {
    /// Springs: the robot hardly swings.
    BySprings,
    /// Springs: it is simulated to swing, and the part shows none of it.
    AtRest,
    /// Springs: it swings, in a job too long for trials coupled in time.
    Unheard,
    /// Robot and cut coupled in time.
    InTime,
}

/// What a case is made of.
pub(super) struct Own {
    /// The job as it is simulated with what carries the tool.
    pub milled: Milled,
    /// That.
    pub carried: Carried,
    /// What the swing would add to a part at rest, row by row, m; empty otherwise.
    pub swing: Vec<f64>,
}

impl Begun {
    /// Of a file and the job that it names.
    ///
    /// # Errors
    /// The job cannot be milled, or the file has a place that is not on its path.
    pub fn of(test: PartTest, planned: Planned) -> Outcome<Self> {
        let setup = planned.setup(None)?;
        let counted = Counted::of(&test, &planned.toolpath, &setup.way);
        let coupled = Milled::of((&test, &counted), &setup, Support::Coupled)?;
        let alone = left(&setup, &coupled.stations, Support::Static)?;
        let alone = seen(&coupled.rows, &alone);
        let swing = difference(&coupled.simulated, &alone);
        let sways = rms(&swing) > SWAYS * probe(&test).max(LEAST);
        let is_still = sways && coupled.is_still(&alone, &test);
        Ok(Self {
            swing: if sways { swing } else { Vec::new() },
            is_still,
            coupled,
            counted,
            setup,
            test: Arc::new(test),
            planned: Arc::new(planned),
        })
    }

    /// Whether trials can be coupled in time.
    pub(super) fn is_short(&self) -> bool {
        self.coupled.steps <= LONGEST
    }

    /// Whether the robot swings so much that the part could show it.
    fn shows(&self) -> bool {
        rms(&self.swing) > SWINGS * probe(&self.test).max(LEAST)
    }

    /// The part of a robot that does not swing, where that has to be asked: it is simulated to, and what causes do may hide that the part shows
    /// none of it ([`Case::rests`]).
    ///
    /// # Errors
    /// As [`Begun::of`].
    pub fn at_rest(&self) -> Outcome<Option<Case>> {
        let is_asked = self.shows() && !self.is_still;
        is_asked.then(|| self.resting()).transpose()
    }

    fn resting(&self) -> Outcome<Case> {
        let milled = Milled::of((&self.test, &self.counted), &self.setup, Support::Static)?;
        let times = |m: &Milled| m.stations.iter().map(|s| s.time_s).collect::<Vec<_>>();
        let swinging = match times(&milled) == times(&self.coupled) {
            true => self.coupled.simulated.clone(),
            // other places are cut: the same run, told at these
            false => {
                let coupled = left(&self.setup, &milled.stations, Support::Coupled)?;
                seen(&milled.rows, &coupled)
            }
        };
        let own = Own {
            swing: difference(&swinging, &milled.simulated),
            carried: Carried::AtRest,
            milled,
        };
        Case::of(self, own)
    }

    /// The part as its job says, but of a robot that is plainly still.
    ///
    /// # Errors
    /// As [`Begun::of`].
    pub fn case(&self) -> Outcome<Case> {
        if self.is_still {
            return self.resting();
        }
        let carried = match (self.shows(), self.is_short()) {
            (true, true) => Carried::InTime,
            (true, false) => Carried::Unheard,
            (false, _) => Carried::BySprings,
        };
        let own = Own {
            swing: Vec::new(),
            carried,
            milled: self.coupled.clone(),
        };
        Case::of(self, own)
    }
}

impl Case {
    /// Whether a part that springs alone were taken to carry shows none of the swing beside what was found and all that is uncertain, and
    /// little besides.
    pub fn rests(&self, found: &Found) -> bool {
        if !self.shows_no_swing {
            return false;
        }
        let known = self.stated().uncertain.iter();
        let known = known.filter(|(known, _)| *known != Known::Swing);
        let blamed = found.blamed.iter().map(|blamed| Nuisance {
            column: blamed.part.clone(),
            spread: f64::INFINITY,
        });
        let missed = Statement {
            reading: difference(&self.missed, &self.swing),
            nuisances: known.map(|k| k.1.clone()).chain(blamed).collect(),
            ..self.bare()
        };
        let less: Vec<f64> = self.swing.iter().map(|x| -x).collect();
        lacks(&missed, &less, Probe::of(&self.test))
    }
}

impl Milled {
    fn of(
        (test, counted): (&PartTest, &Counted),
        setup: &Setup,
        support: Support,
    ) -> Outcome<Self> {
        let (milled, _) = setup.run(support, |_| {})?;
        let stations =
            placed((test, counted), setup, &milled).map_err(|p| p.in_text(&test.path))?;
        let rows = rows(&stations);
        let left = rows
            .iter()
            .map(|row| dot(row.across, stations[row.station].deviation));
        Ok(Self {
            simulated: left.collect(),
            steps: milled.steps,
            rows,
            stations,
        })
    }

    fn is_still(&self, alone: &[f64], test: &PartTest) -> bool {
        let simulated = Simulated {
            coupled: &self.simulated,
            alone,
        };
        is_still((&self.stations, &self.rows), &simulated, Probe::of(test))
    }
}
