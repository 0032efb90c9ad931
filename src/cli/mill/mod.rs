//! `ident mill`: the material is removed by the tool that the soft robot carries; where the part will
//! be wrong, and by how much.

mod account;
mod figures;
mod json;
mod page;

use super::output::{print, print_result, tell};
use super::progress::Progress;
use super::{Ending, Verb, arguments, parsed};
use crate::compensation::corrected::Met;
use crate::cutting::cutter::Cutter;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::norm;
use crate::ground::stats::Z95;
use crate::measurement::recorded_joints::RecordedJoints;
use crate::measurement::workspace::job_results;
use crate::planning::Plan;
use crate::process::Planned;
use crate::process::chatter::{Chatter, chatter, or_chatter};
use crate::process::course;
use crate::process::recorded::Recorded;
use crate::process::run::{Cut, Outcome as Milled};
use crate::process::setup::{Setup, Support};
use crate::process::uncertainty::{self, Doubt, Moved};
use crate::report::folder;
use clap::{ArgMatches, Args};
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "mill",
    about: "Mill a job with the soft robot: forces, and where the part will be wrong",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// The job file (kind = "job") with robot, path, tool, material and stock
    job: PathBuf,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Nothing gives way: forces only
    #[arg(long)]
    rigid: bool,
    /// Springs only: deflection is compliance times force, and the sag since the start of the path (default: robot and cut
    /// coupled in time)
    #[arg(long = "static", conflicts_with = "rigid")]
    springs: bool,
    /// Recorded joint angles (kind trajectory or joint-motion) drive the robot instead of the plan
    #[arg(long, value_name = "FILE")]
    joints: Option<PathBuf>,
    /// Step of time in the cut, µs (default: 3 degrees of the spindle)
    #[arg(long, value_name = "US", allow_hyphen_values = true)]
    step_us: Option<f64>,
    /// Do not ask what the uncertainty of springs and coefficients does to the deviation
    #[arg(long)]
    no_interval: bool,
    /// Write no course and no report
    #[arg(long)]
    dry_run: bool,
    /// Report progress on standard error even without a terminal
    #[arg(long)]
    progress: bool,
}

impl Arguments {
    fn support(&self) -> Support {
        match (self.rigid, self.springs) {
            (true, _) => Support::Rigid,
            (_, true) => Support::Static,
            _ => Support::Coupled,
        }
    }
}

/// The largest deviation, and how sure it is.
struct Worst {
    /// Index of its station.
    station: usize,
    /// m
    size: f64,
    /// 95 % interval, m; `None`: no uncertainty is stated.
    ci95: Option<[f64; 2]>,
}

/// A milled job.
struct Result {
    planned: Planned,
    setup: Setup,
    support: Support,
    milled: Milled,
    left: Cutter,
    worst: Option<Worst>,
    doubts: Vec<Doubt>,
    driven: Option<Driven>,
    /// Whether it chatters.
    chatter: Option<Chatter>,
    /// Whether an interval was asked for.
    asked: bool,
    /// Whether a step of time was.
    step_asked: bool,
}

/// The joint angles that drove the robot in the place of the plan.
struct Driven {
    joints: RecordedJoints,
    recorded: Recorded,
    /// How far along the path they lead, m, where it would cut beyond that.
    ends_at: Option<f64>,
}

impl Driven {
    fn of(plan: &Plan, file: &Path) -> Outcome<Self> {
        let joints = RecordedJoints::read(file)?;
        Ok(Self {
            recorded: Recorded::of(plan, &joints)?,
            joints,
            ends_at: None,
        })
    }

    fn input(&self) -> (String, String) {
        let path = self.joints.path.display().to_string();
        (path, self.joints.sha256.clone())
    }
}

/// What was written.
#[derive(Default)]
struct Written {
    course: Option<PathBuf>,
    report: Option<PathBuf>,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let result = act(&arguments)?;
    let written = match arguments.dry_run {
        true => Written::default(),
        false => write(&result)?,
    };
    match arguments.json {
        true => print_result(
            "mill",
            &result.planned.inputs,
            json::body(&result, &written),
        )?,
        false => print(&account::text(&result, &written))?,
    }
    for remark in account::remarks(&result) {
        tell(&format!("{}: {remark}", result.planned.job.path.display()));
    }
    Ok(Ending::attention_if(result.needs_attention()))
}

fn act(arguments: &Arguments) -> Outcome<Result> {
    let step_s = step(arguments.step_us)?;
    let mut planned = Planned::read(&arguments.job)?;
    let coupled = arguments.support() == Support::Coupled;
    let mut setup = planned.setup(step_s.filter(|_| coupled))?;
    let driven = arguments.joints.as_deref();
    let mut driven = driven
        .map(|file| Driven::of(&planned.plan, file))
        .transpose()?;
    if let Some(driven) = &driven {
        planned.inputs.push(driven.input());
        setup.way = driven.recorded.way.clone();
    }
    let support = arguments.support();
    let progress = Progress::new(PARTS, arguments.progress);
    let told = Cell::new(0);
    let (mut milled, left) = setup
        .run(support, |share| {
            let part = (share * PARTS as f64) as usize;
            while told.get() < part.min(PARTS) {
                told.set(told.get() + 1);
                progress.done(&format!("{} %", 100 * told.get() / PARTS));
            }
        })
        .map_err(|problem| or_chatter(&setup, support, problem).in_file(&planned.job.path))?;
    let chatter =
        chatter(&setup, support, &milled).map_err(|problem| problem.in_file(&planned.job.path))?;
    progress.finish();
    if let Some(driven) = &mut driven {
        driven.recorded.add_to(&mut milled);
        driven.ends_at = driven.recorded.ends_before(&planned.plan, &left);
    }
    let doubts = match arguments.no_interval || support == Support::Rigid {
        true => Vec::new(),
        false => uncertainty::doubts(&setup.robot, &setup, &planned.coefficient_stds()),
    };
    let worst = worst(&setup, &milled, &doubts)?;
    Ok(Result {
        planned,
        setup,
        support,
        milled,
        left,
        worst,
        doubts,
        driven,
        chatter,
        asked: !arguments.no_interval,
        step_asked: step_s.is_some(),
    })
}

/// Pieces of progress.
const PARTS: usize = 20;

fn step(step_us: Option<f64>) -> Outcome<Option<f64>> {
    match step_us {
        Some(us) if !(us > 0.0 && us.is_finite()) => Err(Problem::new(
            format!("`--step-us` is {us}"),
            "give a positive number of microseconds, or leave it out",
        )),
        us => Ok(us.map(|us| us * 1e-6)),
    }
}

/// The largest deviation in the cut, with what is uncertain moved one by one.
fn worst(setup: &Setup, milled: &Milled, doubts: &[Doubt]) -> Outcome<Option<Worst>> {
    let size = |cut: &Cut| norm(cut.deviation);
    let Some(station) = milled.worst(size) else {
        return Ok(None);
    };
    let cut = milled.course[station];
    let ci95 = match doubts.is_empty() {
        true => None,
        false => {
            let moved = Moved::of(setup, Support::Static, doubts)?;
            let changes = moved.changes(setup, &[cut.time_s])?;
            let half = Z95 * uncertainty::spread(&changes, 0, cut.deviation);
            Some([(size(&cut) - half).max(0.0), size(&cut) + half])
        }
    };
    Ok(Some(Worst {
        station,
        size: size(&cut),
        ci95,
    }))
}

impl Result {
    /// Whether what the tool deviates from its commands is what the part deviates from its drawing.
    fn judges_the_part(&self) -> bool {
        self.milled.removed_m3 > 0.0 && !self.planned.toolpath.corrected && self.ends_at().is_none()
    }

    /// Whether the part allows what is deviated, by all of its interval; `None`: it states no tolerance, or is not milled.
    fn met(&self) -> Option<Met> {
        let tolerance = self.planned.job.limits.tolerance;
        let tolerance = tolerance.filter(|_| self.judges_the_part())?;
        let worst = self.worst.as_ref()?;
        let high = worst.ci95.map_or(worst.size, |[_, high]| high);
        // of what chatters nothing is certain
        let high = self.chatter.is_none().then_some(high);
        Some(Met::of(worst.size, high, Some(tolerance)))
    }

    /// How far along the path recorded joint angles lead, m, where it would cut beyond that.
    fn ends_at(&self) -> Option<f64> {
        self.driven.as_ref()?.ends_at
    }

    /// A limit of the robot or of the part is or may be exceeded, or the part is not milled.
    fn needs_attention(&self) -> bool {
        let holds = self.met().is_none_or(|met| met == Met::Yes);
        let is_whole = self.milled.removed_m3 > 0.0 && self.ends_at().is_none();
        let is_allowed = self.planned.plan.exceeded.is_empty() && self.cut_in_rapid().is_none();
        !(holds && is_whole && is_allowed && self.chatter.is_none())
    }

    /// Where a rapid motion cuts first, m of the path.
    fn cut_in_rapid(&self) -> Option<f64> {
        let path = &self.planned.plan.path;
        self.milled.cut_in_rapid(|s| path.is_rapid(s))
    }
}

/// Writes everything, or nothing.
fn write(result: &Result) -> Outcome<Written> {
    let place = job_results(&result.planned.job.path);
    let course = place.join("course.csv");
    let text = course::text(
        &result.milled.course,
        &result.planned.inputs,
        result.support.name(),
    );
    let files = vec![(course.clone(), text)];
    let report = folder::write_with(files, &place, "mill.html", &page::page(result))?;
    Ok(Written {
        course: Some(course),
        report: Some(report),
    })
}
