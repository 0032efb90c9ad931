//! A path, ridden again and again until its joints keep their limits.

use super::adapt::{Demand, caps, demand, excess};
use super::cell::Cell;
use super::follow::Follower;
use super::plan::{Row, Unreached};
use super::spin::SpinLaw;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::job::Job;
use crate::path::double_s::{Limits, Phase};
use crate::path::profile::{Step, lower};
use crate::path::timeline::Stage;
use crate::path::{Path, Timeline};

/// More rows than this are refused.
const MOST_ROWS: f64 = 1e7;
/// Feeds are lowered again at most this often.
const ROUNDS: usize = 40;
/// Acceleration along the path is lowered a little further than asked.
const EASED: f64 = 0.98;

/// A path, ridden again and again until the joints keep their speeds and accelerations.
pub struct Ride<'a> {
    /// What is asked for.
    pub job: &'a Job,
    /// Robot and part.
    pub cell: &'a Cell,
    /// The drawn path.
    pub path: &'a Path,
    /// The turn about the spindle.
    pub spin: &'a SpinLaw,
}

/// A ride that is done.
pub struct Run {
    /// The law of time.
    pub timeline: Timeline,
    /// One row per cycle.
    pub rows: Vec<Row>,
    /// The share of the path's acceleration that it uses.
    pub eased: f64,
}

impl Ride<'_> {
    fn limits(&self) -> Limits {
        Limits {
            acceleration: self.job.limits.path_acceleration,
            jerk: self.job.limits.path_jerk,
        }
    }

    /// Refuses what would take more rows than anybody can use.
    ///
    /// # Errors
    /// Too many rows.
    pub fn bounded(&self, asked: &[Step]) -> Outcome<()> {
        let timeline = Timeline::run(self.path, asked, &self.limits(), &[]);
        let rows = timeline.duration / self.job.cycle;
        match rows <= MOST_ROWS {
            true => Ok(()),
            false => Err(Problem::new(
                format!("would take {:.3e} s, {rows:.1e} cycles", timeline.duration),
                "check the units of path, feed and limits, or choose a longer cycle_ms",
            )
            .in_file(&self.job.path)),
        }
    }

    /// At the speeds asked for, or as near to them as the job allows and the joints demand.
    ///
    /// # Errors
    /// A place that the robot does not reach.
    pub fn within_limits(&self, asked: &[Step]) -> Result<Run, Unreached> {
        let (mut limits, mut eased) = (self.limits(), 1.0);
        let turns = self.path.halts.iter().map(|halt| halt.turns.len()).sum();
        let (mut steps, mut slow) = (asked.to_vec(), vec![1.0; turns]);
        let mut run = self.run(&steps, &limits, &slow)?;
        for _ in 0..ROUNDS {
            let demand = demand(self.cell, &run.1, self.job.cycle);
            let caps = self.caps(&demand, &run.1);
            let mut slower = self.job.adapt && self.slow_turns(&run, &mut slow);
            if self.job.adapt && demand.ease > 1.0 {
                eased *= EASED / demand.ease;
                limits = self.limits().scaled(eased);
                slower = true;
            }
            match caps {
                Some(caps) => steps = lower(&steps, &caps),
                None if !slower => break,
                None => {}
            }
            run = self.run(&steps, &limits, &slow)?;
        }
        let (timeline, rows) = run;
        Ok(Run {
            timeline,
            rows,
            eased,
        })
    }

    fn caps(&self, demand: &Demand, rows: &[Row]) -> Option<Vec<Step>> {
        let may = |s: f64| self.job.adapt || self.path.is_rapid(s);
        caps(demand, rows, self.job.cycle, self.path.length, may)
    }

    fn run(
        &self,
        steps: &[Step],
        limits: &Limits,
        slow: &[f64],
    ) -> Result<(Timeline, Vec<Row>), Unreached> {
        let timeline = Timeline::run(self.path, steps, limits, slow);
        let mut follower = Follower::new(self.cell);
        let states = timeline.sample(self.path, self.job.cycle);
        let row = |(k, state): (usize, crate::path::timeline::State)| {
            let orientation = self.spin.apply(state.s, state.orientation);
            let t = k as f64 * self.job.cycle;
            let pose = self.cell.in_base(state.point, orientation);
            let q = follower.next(&pose).map_err(|miss| Unreached {
                t,
                point: state.point,
                line: self.path.line(state.s),
                miss,
            })?;
            Ok(Row {
                t,
                s: state.s,
                point: state.point,
                orientation,
                q,
                feed: state.feed,
            })
        };
        let rows = states.into_iter().enumerate().map(row);
        let rows = rows.collect::<Result<Vec<Row>, Unreached>>()?;
        Ok((timeline, rows))
    }

    /// Slows the turns on the spot in which a joint is too fast; whether there was one.
    fn slow_turns(&self, run: &(Timeline, Vec<Row>), slow: &mut [f64]) -> bool {
        let (timeline, rows) = run;
        let turns = timeline.stages.iter().filter_map(|stage| match stage {
            Stage::Turn(.., phases) => Some(phases),
            Stage::Travel(_) => None,
        });
        let mut found = false;
        for (phases, slow) in turns.zip(slow) {
            let during = |row: &&Row| is_during(phases, row.t);
            let rows: Vec<Row> = rows.iter().filter(during).copied().collect();
            let excess = excess(self.cell, &rows, self.job.cycle);
            if excess > 1.0 {
                *slow *= 0.98 / excess;
                found = true;
            }
        }
        found
    }
}

fn is_during(phases: &[Phase], t: f64) -> bool {
    let ends = phases.first().zip(phases.last());
    ends.is_some_and(|(first, last)| t >= first.begin && t <= last.begin + last.duration)
}
