//! From a job, its path and its robot to joint angles over time.

use super::cell::{Cell, JOINTS};
use super::exceeded::{Exceeded, JointUse, exceeded, passages, uses};
use super::follow::Miss;
use super::ride::{Ride, Run};
use super::spin::{SpinLaw, mean_compliance};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::measurement::job::{self, Job};
use crate::measurement::toolpath::Toolpath;
use crate::path::double_s::Phase;
use crate::path::element::programme;
use crate::path::orientation::Turning;
use crate::path::profile::Step;
use crate::path::timeline::{Feeds, Stage};
use crate::path::{Drawing, Path, Quaternion, Timeline};
use crate::robot::Robot;

/// Rapid motions run at this multiple of the feed if the job does not say.
const RAPID: f64 = 5.0;

/// The commanded motion at one cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Time, s.
    pub t: f64,
    /// Arc length, m.
    pub s: f64,
    /// Tip, m, workpiece frame.
    pub point: V3,
    /// Tool frame in the workpiece frame.
    pub orientation: Quaternion,
    /// Joint angles, rad.
    pub q: [f64; JOINTS],
    /// Feed, m/s.
    pub feed: f64,
}

/// The feed as it was kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedUse {
    /// The feed of cuts asked for, m/s: the job's, else the highest of the path.
    pub asked: f64,
    /// Share of the length that runs at the speed asked for there.
    pub held_share: f64,
    /// Lowest speed outside of starts and stops, m/s.
    pub min: f64,
    /// Share of the path's acceleration and jerk that is used, so that no joint accelerates harder than
    /// it can; below 1 only where the feed adapts.
    pub eased: f64,
}

/// A planned job.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Robot and part.
    pub cell: Cell,
    /// The drawn path.
    pub path: Path,
    /// The turn about the spindle.
    pub spin: SpinLaw,
    /// The law of time.
    pub timeline: Timeline,
    /// The speeds asked for.
    pub feeds: Feeds,
    /// Controller cycle, s.
    pub cycle: f64,
    /// One row per cycle.
    pub rows: Vec<Row>,
    /// The feed.
    pub feed: FeedUse,
    /// The joints.
    pub joints: Vec<JointUse>,
    /// What the robot cannot do.
    pub exceeded: Vec<Exceeded>,
    /// Passages through the wrist's singularity: time (s), arc length (m).
    pub passages: Vec<[f64; 2]>,
    /// Mean compliance normal to the path with the turn about the spindle carried along without
    /// twist, and with the turn chosen, m/N; `None`: no free turn, or a rigid robot.
    pub compliance: Option<[f64; 2]>,
}

/// A place of the path that the robot does not reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unreached {
    /// When it would be there, s.
    pub t: f64,
    /// The tip, m, workpiece frame.
    pub point: V3,
    /// Line of the path file.
    pub line: usize,
    /// How far it is.
    pub miss: Miss,
}

impl Unreached {
    /// The refusal, without its file.
    pub fn problem(&self) -> Problem {
        let [x, y, z] = self.point.map(|x| x * 1e3);
        let far = match self.miss.reach {
            Some([least, most]) => format!(
                ": the wrist would have to be {:.3} m from A2, the arm reaches {least:.3} to {most:.3} m",
                self.miss.needed
            ),
            None => String::new(),
        };
        Problem::new(
            format!(
                "the robot cannot reach the way to this point, at ({x:.3}, {y:.3}, {z:.3}) mm{far}"
            ),
            "place the part nearer with [workpiece], or turn the tool another way",
        )
        .at_line(self.line)
    }

    /// The refusal as a limit exceeded.
    pub fn exceeded(&self) -> Exceeded {
        let reach = self.miss.reach.map(|[least, most]| {
            if self.miss.needed < least {
                least
            } else {
                most
            }
        });
        Exceeded {
            what: "reach",
            site: "arm".into(),
            at: self.t,
            line: self.line,
            value: self.miss.needed,
            limit: reach.unwrap_or(f64::NAN),
        }
    }
}

/// Plans a job; the inner result is the place that cannot be reached.
///
/// # Errors
/// A path without motion, without feed, a robot that does not suit.
pub fn plan(job: &Job, toolpath: &Toolpath, robot: &Robot) -> Outcome<Result<Plan, Unreached>> {
    let cell = Cell::of(job, robot)?;
    let programme = programme(toolpath, &cell.holding())?;
    let drawing = Drawing {
        blend_radius: job.blend_radius,
        turning: match job.orientation {
            job::Turning::Blend => Turning::Blend,
            job::Turning::Radius(radius) => Turning::Radius(radius),
            job::Turning::Whole => Turning::Whole,
        },
    };
    let path = Path::draw(programme, &drawing);
    let feeds = feeds(job, &path).map_err(|problem| problem.in_file(&toolpath.path))?;
    let spin = SpinLaw::of(&cell, &path, job.spin);
    let ride = Ride {
        job,
        cell: &cell,
        path: &path,
        spin: &spin,
    };
    let asked = feeds.steps(&path);
    ride.bounded(&asked)?;
    let Run {
        timeline,
        rows,
        eased,
    } = match ride.within_limits(&asked) {
        Ok(run) => run,
        Err(unreached) => return Ok(Err(unreached)),
    };
    let joints = uses(&cell, &rows, job.cycle);
    let exceeded = exceeded(&cell, &rows, &joints, |s| path.line(s));
    let feed = FeedUse {
        eased,
        ..feed_use(
            &path,
            &timeline,
            &asked,
            feeds.feed.unwrap_or(feeds.fallback),
        )
    };
    Ok(Ok(Plan {
        compliance: compared(&cell, &path, &spin),
        passages: passages(&cell, &rows),
        cycle: job.cycle,
        feeds,
        feed,
        joints,
        exceeded,
        timeline,
        rows,
        spin,
        cell,
        path,
    }))
}

/// Compliance with the turn carried along, and with the one chosen.
fn compared(cell: &Cell, path: &Path, spin: &SpinLaw) -> Option<[f64; 2]> {
    let free = path.programme.free_spin;
    let carried = free.then(|| mean_compliance(cell, path, &SpinLaw::none(cell)))?;
    Some([carried?, mean_compliance(cell, path, spin)?])
}

/// The speeds of the job.
fn feeds(job: &Job, path: &Path) -> Outcome<Feeds> {
    let cuts = path.programme.elements.iter().filter(|e| !e.rapid);
    let highest = cuts.filter_map(|e| e.feed).fold(0.0, f64::max);
    let feed = job.feed.or(Some(highest).filter(|feed| *feed > 0.0));
    let rapid = job.rapid.or(feed.map(|feed| RAPID * feed));
    match (feed.or(job.rapid), rapid) {
        (Some(fallback), Some(rapid)) => Ok(Feeds {
            feed: job.feed,
            fallback,
            rapid,
        }),
        _ => Err(Problem::new(
            "states no feed, nor does the job",
            "write feed_mm_min into the job",
        )),
    }
}

fn feed_use(path: &Path, timeline: &Timeline, asked: &[Step], feed: f64) -> FeedUse {
    let travels = timeline.stages.iter().filter_map(|stage| match stage {
        Stage::Travel(phases) => Some(phases),
        Stage::Turn(..) => None,
    });
    let (mut held, mut least) = (0.0, f64::INFINITY);
    for phases in travels {
        held += phases
            .iter()
            .map(|phase| held_length(phase, asked))
            .sum::<f64>();
        least = least.min(lowest(phases));
    }
    FeedUse {
        asked: feed,
        held_share: (held / path.length).min(1.0),
        min: least,
        eased: 1.0,
    }
}

fn is_steady(phase: &Phase) -> bool {
    phase.a == 0.0 && phase.j == 0.0
}

/// Length of a phase that runs at the speed asked for, m.
fn held_length(phase: &Phase, asked: &[Step]) -> f64 {
    let middle = phase.at(phase.begin + 0.5 * phase.duration)[0];
    let step = asked.get(asked.partition_point(|step| step.end < middle));
    let kept = is_steady(phase) && step.is_some_and(|step| phase.v >= step.speed * (1.0 - 1e-9));
    if kept { phase.v * phase.duration } else { 0.0 }
}

/// Lowest speed between the start and the stop of a travel; its peak if it never runs steadily, m/s.
fn lowest(phases: &[Phase]) -> f64 {
    let first = phases.iter().position(is_steady);
    let last = phases.iter().rposition(is_steady);
    match (first, last) {
        (Some(first), Some(last)) => {
            let inside = phases[first..=last].iter().map(|phase| phase.v);
            inside.fold(f64::INFINITY, f64::min)
        }
        _ => phases.iter().map(|phase| phase.v).fold(0.0, f64::max),
    }
}
