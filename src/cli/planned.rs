//! A job read and planned, with everything that it rests on: where `mill` and `compensate` begin.

use crate::ground::problem::Outcome;
use crate::measurement::job::Job;
use crate::measurement::toolpath::Toolpath;
use crate::planning::{Plan, plan};
use crate::process::setup::Setup;
use crate::process::uncertainty::NORMAL95;
use crate::robot::load::load;
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

impl Planned {
    /// Reads and plans a job.
    ///
    /// # Errors
    /// Whatever cannot be read; a place that the robot does not reach.
    pub fn read(path: &Path) -> Outcome<Self> {
        let job = Job::read(path)?;
        let toolpath = Toolpath::read(&job.toolpath)?;
        Self::of(job, toolpath)
    }

    /// Plans a job along a path.
    ///
    /// # Errors
    /// As [`Planned::read`].
    pub fn of(job: Job, toolpath: Toolpath) -> Outcome<Self> {
        let robot = load(&job.robot, Some(&job.path))?;
        let mut inputs = vec![
            (job.path.display().to_string(), job.sha256.clone()),
            (toolpath.path.display().to_string(), toolpath.sha256.clone()),
            robot.input(),
        ];
        let further = toolpath.inputs.iter().chain(&job.inputs);
        inputs.extend(further.map(|(path, hash)| (path.display().to_string(), hash.clone())));
        let plan = plan(&job, &toolpath, &robot.robot)?
            .map_err(|unreached| unreached.problem().in_file(&toolpath.path))?;
        Ok(Self {
            job,
            toolpath,
            plan,
            inputs,
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
        let values = material.cutting.iter().chain(&material.edge);
        let stds = values.zip(&material.ci95).map(|(value, ci95)| {
            let own = ci95.map(|[low, high]| (high - low) / (2.0 * NORMAL95 * value.abs()));
            own.filter(|s| s.is_finite()).or(material.rel_std)
        });
        stds.collect()
    }
}
