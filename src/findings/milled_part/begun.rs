//! A part and its job, milled as the job says and with springs alone, before it is decided which of them carries the tool in every trial.

use super::carried::Carried;
use super::counted::Counted;
use super::stations::{Row, Station, placed, rows, spreads};
use super::still::{Probe, Simulated, is_still, lacks};
use super::tried::left;
use super::uncertain::Known;
use super::{Case, LEAST, probe, seen};
use crate::findings::engine::{Found, Nuisance, Statement};
use crate::ground::problem::Outcome;
use crate::ground::spatial::dot;
use crate::ground::stats::{difference, rms};
use crate::measurement::milled_part::PartTest;
use crate::process::setup::{Setup, Support};
use crate::process::{self, Planned};
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
    /// Milled as the job says; by springs alone where that runs away.
    coupled: Milled,
    /// Whether it does: robot and cut drive one another until the job cannot go on, although the part was milled.
    runs_away: bool,
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

/// What a case is made of.
pub(super) struct Own {
    /// The job as it is simulated with what carries the tool.
    pub milled: Milled,
    /// That.
    pub carried: Carried,
    /// What the swing would add to a part at rest, row by row, m; empty otherwise.
    pub swing: Vec<f64>,
}

/// Nats by which what is missed must be less ragged before a file counts otherwise than along the drawn path. Chosen looking at 29 files by a
/// stranger that count from point to point: 18 were that much better so, 10 told nothing, one the contrary, before spreads counted in it. No file
/// that counts along the drawn path set it.
const PLAINLY: f64 = 2.0;

/// How a file counts: as usual, or as it may as well where that plainly fits better. Springs alone tell: a swing that the part may not show
/// differs from place to place.
fn likeliest(
    (usual, other): (Counted, Option<Counted>),
    test: &PartTest,
    setup: &Setup,
) -> Outcome<Counted> {
    let Some(other) = other else {
        return Ok(usual);
    };
    let (run, _) = setup.run(Support::Static, |_| {})?;
    let ragged = |counted: &Counted| {
        let milled = Milled::of((test, counted), setup, &run);
        milled.map_or(f64::INFINITY, |milled| milled.ragged(test))
    };
    let is_other = ragged(&other) < ragged(&usual) - PLAINLY;
    Ok(if is_other { other } else { usual })
}

impl Begun {
    /// Of a file and the job that it names.
    ///
    /// # Errors
    /// The job cannot be milled, or the file has a place that is not on its path.
    pub fn of(test: PartTest, planned: Planned) -> Outcome<Self> {
        let setup = planned.setup(None)?;
        // what no run could be made of is refused, and not taken for a run that could not go on
        setup.structure(Support::Coupled)?;
        let run = |support| setup.run(support, |_| {}).map(|run| run.0);
        let (run, runs_away) = match run(Support::Coupled) {
            Ok(run) => (run, false),
            Err(problem) => (run(Support::Static).map_err(|_| problem)?, true),
        };
        let ways = Counted::ways(&test, &planned.toolpath, &setup.way);
        let counted = likeliest(ways, &test, &setup)?;
        let coupled = Milled::of((&test, &counted), &setup, &run)?;
        let alone = left(&setup, &coupled.stations, Support::Static)?;
        let alone = seen(&coupled.rows, &alone);
        let swing = difference(&coupled.simulated, &alone);
        let sways = !runs_away && rms(&swing) > SWAYS * probe(&test).max(LEAST);
        let is_still = sways && coupled.is_still(&alone, &test);
        Ok(Self {
            swing: if sways { swing } else { Vec::new() },
            is_still,
            coupled,
            runs_away,
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
        let (run, _) = self.setup.run(Support::Static, |_| {})?;
        let milled = Milled::of((&self.test, &self.counted), &self.setup, &run)?;
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
            _ if self.runs_away => Carried::Away,
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
        if self.carried != Carried::AtRest {
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
        run: &process::run::Outcome,
    ) -> Outcome<Self> {
        let stations = placed((test, counted), setup, run).map_err(|p| p.in_text(&test.path))?;
        let rows = rows(&stations);
        let left = rows
            .iter()
            .map(|row| dot(row.across, stations[row.station].deviation));
        Ok(Self {
            simulated: left.collect(),
            steps: run.steps,
            rows,
            stations,
        })
    }

    /// How ragged is what it misses, nats: what causes do is mostly smooth from place to place, and a place that is taken for another one is not,
    /// where the cut changes between them. Wild places count little; one where nothing is cut as much as one that stands out.
    fn ragged(&self, test: &PartTest) -> f64 {
        let (stations, rows) = (&self.stations, &self.rows);
        let spread = spreads(stations, rows, probe(test), 1.0);
        let cost = |steps: f64| (0.5 * steps * steps).ln_1p();
        let least = probe(test).max(LEAST);
        let when = |i: &usize| stations[rows[*i].station].time_s;
        let missed = |i: usize| rows[i].measured - self.simulated[i];
        let of = |left: bool| {
            let mut own: Vec<usize> = (0..rows.len()).filter(|i| rows[*i].left == left).collect();
            own.sort_by(|a, b| when(a).total_cmp(&when(b)));
            let step = |pair: &[usize]| {
                let [a, b] = [pair[0], pair[1]];
                let spread = spread[a].hypot(spread[b]);
                cost((missed(b) - missed(a)) / spread) + (spread / least).ln()
            };
            own.windows(2).map(step).sum::<f64>()
        };
        let each = test.readings.iter().flat_map(|reading| reading.deviation);
        let measured: Vec<f64> = each.filter(|x| x.is_finite()).collect();
        let left_out = test.readings.len() - stations.len();
        of(true) + of(false) + left_out as f64 * cost(rms(&measured) / least)
    }

    fn is_still(&self, alone: &[f64], test: &PartTest) -> bool {
        let simulated = Simulated {
            coupled: &self.simulated,
            alone,
        };
        is_still((&self.stations, &self.rows), &simulated, Probe::of(test))
    }
}
