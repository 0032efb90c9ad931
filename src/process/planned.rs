//! A job read and planned, with everything that it rests on: where every verb of a part begins.

use super::setup::Setup;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::stats::Z95;
use crate::measurement::job::Job;
use crate::measurement::toolpath::Toolpath;
use crate::path::programs::{Exporter, ProgramFile};
use crate::planning::program::program;
use crate::planning::{Plan, Unreached, plan};
use crate::robot::load::load;
use crate::sheet::number::significant;
use std::f64::consts::TAU;
use std::path::Path;

/// A planned job.
pub struct Planned {
    /// The job.
    pub job: Job,
    /// Its path.
    pub toolpath: Toolpath,
    /// Its plan.
    pub plan: Plan,
    /// Path and SHA-256 of every file, the job first.
    pub inputs: Vec<(String, String)>,
}

/// A job with a place that its robot does not reach.
pub struct Unplanned {
    /// Where, and by how much.
    pub unreached: Unreached,
    /// Path and SHA-256 of every file, the job first.
    pub inputs: Vec<(String, String)>,
    /// The refusal.
    pub problem: Problem,
}

/// Least feed per tooth, m: no edge takes chips so far below its own radius, and hours of cutting would be simulated
/// tooth by tooth.
const THINNEST: f64 = 1e-7;

/// Refuses a feed that no cutter works at: that of the job, which holds for all, or of a line of the path.
fn check_feeds(job: &Job, toolpath: &Toolpath) -> Outcome<()> {
    let Some(cutter) = &job.cutter else {
        return Ok(());
    };
    for step in toolpath.moves.iter().skip(1).filter(|step| !step.rapid) {
        let speed = cutter.spindle.or(step.spindle).map_or(0.0, f64::abs);
        let teeth = cutter.teeth as f64 * speed / TAU;
        let Some(feed) = job.feed.or(step.feed) else {
            continue;
        };
        let problem = match feed {
            slow if slow < THINNEST * teeth => too_slow(feed, teeth),
            // a line of the path may go through air
            fast if job.feed.is_some() && teeth > 0.0 && fast > 0.5 * cutter.diameter * teeth => {
                too_fast(feed, teeth)
            }
            _ => continue,
        };
        return Err(match job.feed {
            Some(_) => problem.at_key(&job.path, "feed_mm_min"),
            None => problem.at_line(step.line).in_file(&toolpath.path),
        });
    }
    Ok(())
}

/// Feed, m/s, at so many teeth a second.
fn too_slow(feed: f64, teeth: f64) -> Problem {
    let per_tooth = significant(feed / teeth * 1e6, 3);
    no_feed(
        feed,
        &format!("{per_tooth} µm per tooth, which no edge cuts"),
    )
}

fn too_fast(feed: f64, teeth: f64) -> Problem {
    let per_tooth = significant(feed / teeth * 1e3, 3);
    no_feed(
        feed,
        &format!("{per_tooth} mm per tooth, more than the radius of the tool"),
    )
}

fn no_feed(feed: f64, per_tooth: &str) -> Problem {
    Problem::new(
        format!(
            "a feed of {} mm/min is {per_tooth}",
            significant(feed * 60e3, 3)
        ),
        "check the unit of the feed, and the speed of the spindle",
    )
}

impl Planned {
    /// Reads and plans a job.
    ///
    /// # Errors
    /// Whatever cannot be read; a place that the robot does not reach.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::try_read(path)?.map_err(|unplanned| unplanned.problem)
    }

    /// [`Planned::read`], a place out of reach being an answer.
    ///
    /// # Errors
    /// Whatever cannot be read.
    pub fn try_read(path: &Path) -> Outcome<Result<Self, Box<Unplanned>>> {
        let job = Job::read(path)?;
        job.expect_file("path", &job.toolpath)?;
        let toolpath = Toolpath::read(&job.toolpath)?;
        Self::of(job, toolpath)
    }

    /// Plans a job along a path.
    ///
    /// # Errors
    /// As [`Planned::try_read`].
    pub fn of(job: Job, toolpath: Toolpath) -> Outcome<Result<Self, Box<Unplanned>>> {
        check_feeds(&job, &toolpath)?;
        let robot = load(&job.robot, Some(&job.path))?;
        let mut inputs = vec![
            (job.path.display().to_string(), job.sha256.clone()),
            (toolpath.path.display().to_string(), toolpath.sha256.clone()),
            robot.input(),
        ];
        let further = toolpath.inputs.iter().chain(&job.inputs);
        inputs.extend(further.map(|(path, hash)| (path.display().to_string(), hash.clone())));
        Ok(match plan(&job, &toolpath, &robot.robot)? {
            Ok(plan) => Ok(Self {
                job,
                toolpath,
                plan,
                inputs,
            }),
            Err(unreached) => Err(Box::new(Unplanned {
                problem: unreached.problem().in_file(&toolpath.path),
                unreached,
                inputs,
            })),
        })
    }

    /// Made ready to be milled; `step_s` is the step of time, if it is not to be chosen.
    ///
    /// # Errors
    /// What milling needs and the job does not say.
    pub fn setup(&self, step_s: Option<f64>) -> Outcome<Setup> {
        let mut speeds = self.toolpath.moves.iter().filter_map(|m| m.spindle);
        let speed = speeds.rfind(|speed| *speed != 0.0);
        Setup::of(&self.job, &self.plan, speed, step_s)
    }

    /// Relative standard deviations of the six coefficients, where they are stated.
    pub fn coefficient_stds(&self) -> Vec<Option<f64>> {
        let Some(material) = &self.job.material else {
            return Vec::new();
        };
        let values = material.coefficients.iter();
        let stds = values.zip(&material.ci95).map(|(value, ci95)| {
            let own = ci95.map(|[low, high]| (high - low) / (2.0 * Z95 * value.abs()));
            own.filter(|s| s.is_finite()).or(material.rel_std)
        });
        stds.collect()
    }

    /// The plan in the language of a controller, the main file first; `inputs` stand in it as comments.
    ///
    /// # Errors
    /// What the language cannot say.
    pub fn programs(
        &self,
        exporter: &Exporter,
        inputs: &[(String, String)],
    ) -> Outcome<Vec<ProgramFile>> {
        let name = self.toolpath.path.file_stem().unwrap_or_default();
        let comment = |(path, hash): &(String, String)| format!("{path} sha256 {hash}");
        let comments = inputs.iter().map(comment).collect();
        let stated = self.toolpath.moves.iter().find_map(|step| step.spindle);
        let cutter = self.job.cutter.as_ref().and_then(|cutter| cutter.spindle);
        let name = name.to_string_lossy();
        let spindle = cutter.or(stated);
        let program = program(&self.plan, &name, comments, spindle, exporter.turns);
        exporter
            .write(&program)
            .map_err(|problem| problem.in_file(&self.job.path))
    }
}
