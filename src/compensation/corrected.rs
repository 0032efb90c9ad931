//! A job corrected: its path moved, its program, what is left with and without, and what was checked.

use super::calm::calm;
use super::executed::executed;
use super::limits::{Certainty, certainty};
use super::method::METHODS;
use super::online::Sensor;
use super::proof::{Checked, proof};
use super::remaining::{Size, Station, remaining};
use super::shifted::shifted;
use super::text::text;
use super::{Correction, Method, Search, Task, search};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::measurement::workspace::job_results;
use crate::path::programs::{Exporter, ProgramFile};
use crate::process::Planned;
use crate::process::chatter::{Chatter, chatter, or_chatter};
use crate::process::run::NOTHING_CUT;
use crate::process::setup::{Setup, Support};
use crate::process::uncertainty::{self, Doubt, Moved};
use std::path::PathBuf;

/// How a job is to be corrected.
pub struct Request {
    /// How the correction is found.
    pub method: &'static Method,
    /// Language of the program.
    pub exporter: &'static Exporter,
    /// Robot and material on which it is judged, if not those of the job.
    pub plant: Option<Planned>,
    /// What a force sensor sees, for methods that measure.
    pub sensor: Sensor,
    /// What carries the tool.
    pub support: Support,
}

/// Whether the part will be within its tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Met {
    /// Certainly.
    Yes,
    /// As expected, it will not.
    No,
    /// The interval reaches beyond it, or nothing is stated.
    NotCertain,
}

impl Met {
    /// As in the JSON document.
    pub fn word(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::No => "no",
            Self::NotCertain => "not-certain",
        }
    }

    /// From what is left (m), what it will not exceed (m) and the tolerance.
    pub fn of(max: f64, at_most: Option<f64>, tolerance: Option<f64>) -> Self {
        match (at_most, tolerance) {
            (_, Some(tolerance)) if max > tolerance => Self::No,
            (Some(at_most), Some(tolerance)) if at_most <= tolerance => Self::Yes,
            _ => Self::NotCertain,
        }
    }
}

/// A corrected job.
pub struct Corrected {
    /// The job as it was planned.
    pub planned: Planned,
    /// What it was judged on, if not on its own robot.
    pub plant: Option<Planned>,
    /// How the correction was found.
    pub method: &'static Method,
    /// The correction, and how the search for it ended.
    pub found: Search,
    /// The corrected path as a file, and the programs that run it.
    pub text: String,
    /// The programs of the corrected path, the main file first.
    pub programs: Vec<ProgramFile>,
    /// How far the part would be off without correction.
    pub before: Size,
    /// How far it is off with it.
    pub after: Size,
    /// What is left along the path, without and with correction.
    pub stations: [Vec<Station>; 2],
    /// Rapid motions are slowed to the feed.
    pub slowed: bool,
    /// What the method that it improves on leaves, by its name.
    pub beside: Option<(&'static str, Vec<Station>)>,
    /// How well that is known.
    pub certainty: Certainty,
    /// What is stated as uncertain.
    pub doubts: Vec<Doubt>,
    /// Whether the part will be within its tolerance.
    pub met: Met,
    /// What was checked along the corrected path.
    pub checked: Vec<Checked>,
    /// Whether the corrected part chatters.
    pub chatter: Option<Chatter>,
    /// What of the stock is gone without a force, in sentences.
    pub not_cut: Vec<String>,
}

/// Corrects a planned job.
///
/// # Errors
/// What milling needs and the job does not say; a motion that cannot be; a language that cannot say it.
pub fn correct(planned: Planned, request: Request) -> Outcome<Corrected> {
    let Request {
        method,
        exporter,
        plant,
        sensor,
        support,
    } = request;
    let in_job = |problem: Problem| problem.in_file(&planned.job.path);
    if planned.toolpath.corrected {
        return Err(Problem::new(
            "is a corrected path: what is left of it would be measured from its commands, not from the part that was drawn",
            "name the path as it was drawn in the job",
        )
        .in_file(&planned.toolpath.path));
    }
    let calmed = match support {
        Support::Coupled => calm(&planned)?,
        _ => None,
    };
    let base = calmed.as_ref().unwrap_or(&planned);
    let (drawn, setup) = (planned.setup(None)?, base.setup(None)?);
    let of_plant = |setup: &Setup| {
        plant
            .as_ref()
            .map_or(Ok(setup.clone()), |p| of_plant(setup, p))
    };
    let truth = of_plant(&setup)?;
    let inputs = inputs(&planned, plant.as_ref());
    let synthetic = planned.toolpath.synthetic || planned.job.synthetic;
    let written = |found: &Correction| text(&base.plan, found, method.name, &inputs, synthetic);
    let as_run = |text: &str| executed(base, &corrected_path(&planned), text);
    let way_of = |found: &Correction| match method.live {
        true => shifted(&base.plan, found),
        false => Ok(as_run(&written(found))?.way),
    };
    let task = Task {
        setup: &setup,
        truth: &truth,
        plan: &base.plan,
        support,
        sensor,
        way_of: &way_of,
    };
    let uncorrected = of_plant(&drawn)?;
    let (found, first) = rayon::join(
        || search(method, &task),
        || uncorrected.run(support, |_| {}),
    );
    let first = first.map_err(|problem| or_chatter(&uncorrected, support, problem));
    let (first, _) = first.map_err(in_job)?;
    if first.removed_m3 == 0.0 {
        let [what, remedy] = NOTHING_CUT;
        return Err(in_job(Problem::new(what, remedy)));
    }
    let found = found.map_err(in_job)?;
    let text = written(&found.correction);
    let executed = (!method.live).then(|| as_run(&text)).transpose()?;
    let way = match &executed {
        Some(executed) => executed.way.clone(),
        None => shifted(&base.plan, &found.correction).map_err(in_job)?,
    };
    let runner = executed.as_ref().map_or(base, |e| &e.planned);
    let programs = runner.programs(exporter, &inputs)?;
    let corrected = |setup: &Setup| Setup {
        way: way.clone(),
        ..setup.clone()
    };
    let model = corrected(&setup);
    let doubts = uncertainty::doubts(&setup.robot, &setup, &planned.coefficient_stds());
    let run = |setup: &Setup| Ok(setup.run(support, |_| {}).map_err(in_job)?.0);
    let (runs, moved) = rayon::join(
        || {
            let of_truth = corrected(&truth);
            let second = run(&of_truth)?;
            let chatter = chatter(&of_truth, support, &second).map_err(in_job)?;
            let of_model = plant.as_ref().map(|_| run(&model)).transpose()?;
            Ok((second, chatter, of_model))
        },
        || Moved::of(&model, support, &doubts).map_err(in_job),
    );
    let ((second, chatter, of_model), moved) = (runs?, moved?);
    let before = remaining(&first, &planned.plan.path);
    let after = remaining(&second, &planned.plan.path);
    let expected = of_model.as_ref().unwrap_or(&second);
    let left = remaining(expected, &planned.plan.path);
    let beside = beside(method, &task).map_err(in_job)?;
    let certainty = certainty(&model, &planned.plan.path, &moved, &left).map_err(in_job)?;
    let size = Size::of(&after);
    let checked = proof(&planned.plan, &way, &found.correction, &second);
    Ok(Corrected {
        met: Met::of(
            size.max_m,
            // of what chatters nothing is certain
            certainty.at_most_m.filter(|_| chatter.is_none()),
            planned.job.limits.tolerance,
        ),
        before: Size::of(&before),
        after: size,
        stations: [before, after],
        slowed: calmed.is_some(),
        beside,
        text,
        programs,
        planned,
        plant,
        method,
        found,
        certainty,
        doubts,
        checked,
        chatter,
        not_cut: second.not_cut(),
    })
}

/// What the method that a method improves on leaves.
fn beside(method: &Method, task: &Task) -> Outcome<Option<(&'static str, Vec<Station>)>> {
    let Some(other) = METHODS.iter().find(|m| Some(m.name) == method.beside) else {
        return Ok(None);
    };
    let found = search(other, task)?;
    let corrected = Setup {
        way: shifted(task.plan, &found.correction)?,
        ..task.truth.clone()
    };
    let (milled, _) = corrected.run(task.support, |_| {})?;
    let left = remaining(&milled, &task.plan.path);
    Ok(Some((other.name, left)))
}

/// Where the corrected path goes.
pub fn corrected_path(planned: &Planned) -> PathBuf {
    job_results(&planned.job.path).join("compensated.csv")
}

/// The job's motion, stock and tool with the robot and the material of the plant.
fn of_plant(setup: &Setup, plant: &Planned) -> Outcome<Setup> {
    let other = plant.setup(None)?;
    Ok(Setup {
        robot: other.robot,
        material: other.material,
        ..setup.clone()
    })
}

/// Path and hash of every file, the job first.
pub fn inputs(planned: &Planned, plant: Option<&Planned>) -> Vec<(String, String)> {
    let mut all = planned.inputs.clone();
    for input in plant.iter().flat_map(|plant| &plant.inputs) {
        if !all.contains(input) {
            all.push(input.clone());
        }
    }
    all
}

impl Corrected {
    /// Whether the part will be within its tolerance and everything that was checked is within its limits.
    pub fn is_proven(&self) -> bool {
        self.met == Met::Yes && self.checked.iter().all(|c| c.ok)
    }

    /// Whether the plant's job mills something else, of which nothing is taken.
    pub fn plant_mills_else(&self) -> bool {
        let way = |p: &Planned| -> Vec<(V3, bool)> {
            let moves = p.toolpath.moves.iter();
            moves.map(|one| (one.to, one.rapid)).collect()
        };
        let part = |p: &Planned| (p.job.workpiece.clone(), p.job.cutter, p.job.feed);
        let own = &self.planned;
        let differs = |p: &Planned| way(p) != way(own) || part(p) != part(own);
        self.plant.as_ref().is_some_and(differs)
    }

    /// By how much the largest deviation fell, percent.
    pub fn reduction_percent(&self) -> Option<f64> {
        (self.before.max_m > 0.0).then(|| 100.0 * (1.0 - self.after.max_m / self.before.max_m))
    }
}
