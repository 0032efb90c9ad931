//! `ident lobes`: how deep one may cut at which speed before chatter starts.

mod account;
mod along;
mod input;

use super::output::{print, print_result};
use super::{Ending, Verb, arguments, parsed};
use crate::cutting::directional::Directional;
use crate::cutting::mean::engagement;
use crate::cutting::stability::{Multiplier, Passing, TipMode, limit};
use crate::cutting::wave::{Cut, Side};
use crate::cutting::{Material, Tool};
use crate::ground::problem::{Outcome, Problem};
use crate::report::folder;
use crate::sheet::page::Page;
use clap::{ArgMatches, Args};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::path::PathBuf;

/// The verb.
pub const VERB: Verb = Verb {
    name: "lobes",
    about: "Stability lobes: the depth of cut at which chatter starts, over the spindle speed",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// A job (its robot at the start pose), or a file of kind modal
    file: PathBuf,
    /// Spindle speeds, rev/min [default: half to one and a half times the tool's]
    #[arg(long, value_name = "FROM:TO:STEP")]
    rpm: Option<String>,
    /// Spectral radius per tooth passing at one speed (rev/min) and depth (mm)
    #[arg(long, value_name = "RPM,DEPTH_MM")]
    at: Option<String>,
    /// Deepest cut that is looked at, mm [default: the flute, else the diameter]
    #[arg(long, value_name = "MM")]
    depth_mm: Option<f64>,
    /// The least depth at the stations of a job's path, at the tool's speed or over --rpm
    #[arg(long, conflicts_with_all = ["at", "station"])]
    along: bool,
    /// The robot where the tool is after this arc length of the job's path [default: the start pose]
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    station: Option<f64>,
    /// Hits on the tool's tip, or FRFs there (hammer test or universal file): its modes are added
    #[arg(long, value_name = "FILE")]
    tool_frf: Option<PathBuf>,
    /// Side of the stock for a job: slot, up or down [default: slot]
    #[arg(long, value_parser = ["slot", "up", "down"])]
    cut: Option<String>,
    /// Width of cut for a job, mm [default: the diameter]
    #[arg(long, value_name = "MM")]
    width_mm: Option<f64>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write no report
    #[arg(long)]
    dry_run: bool,
}

/// What vibrates and what cuts.
#[derive(Clone)]
struct Case {
    inputs: Vec<(String, String)>,
    name: String,
    modes: Vec<TipMode>,
    tool: Tool,
    material: Material,
    width_m: f64,
    side: Side,
    spindle_rad_s: Option<f64>,
    remarks: Vec<String>,
}

/// One speed.
struct Limit {
    rpm: f64,
    depth_m: Option<f64>,
    chatter_hz: Option<f64>,
}

/// Chip at which laws that are not linear are judged, m.
const CHIP: f64 = 5e-5;
/// Shallowest depth that is looked at, share of the deepest.
const SHALLOWEST: f64 = 1e-4;
/// Most that the limit may move when nodes are added.
const CONVERGED: f64 = 5e-3;
/// Factor from number of nodes to number of nodes, and the largest that is tried.
const FINER: f64 = 1.3;
const FINEST: f64 = 4.0;

impl Case {
    /// The cut at a depth.
    fn directional(&self, depth_m: f64) -> Directional {
        let cut = Cut {
            spindle_rad_s: 1.0,
            feed_m_s: 0.0,
            depth_m,
            width_m: self.width_m,
            side: self.side,
        };
        let angles = engagement(&cut, self.tool.radius_m);
        Directional::new(&self.tool, &self.material, angles, depth_m, CHIP)
    }

    fn passing(&self, rpm: f64, depth_m: f64, refine: f64) -> Passing {
        let passing_s = 60.0 / rpm / self.tool.teeth as f64;
        Passing::new(&self.modes, &self.directional(depth_m), passing_s, refine)
    }

    fn multiplier(&self, rpm: f64, depth_m: f64, refine: f64) -> Multiplier {
        self.passing(rpm, depth_m, refine).multiplier(depth_m)
    }

    fn limit(&self, rpm: f64, deepest_m: f64, refine: f64) -> Limit {
        let straight = !self.directional(deepest_m).depends_on_depth();
        let ready = straight.then(|| self.passing(rpm, deepest_m, refine));
        let radius = |depth: f64| match &ready {
            Some(passing) => passing.radius(depth),
            None => self.passing(rpm, depth, refine).radius(depth),
        };
        let depth = limit(radius, SHALLOWEST * deepest_m, deepest_m);
        let chatter_hz = |depth: f64| {
            let depth = depth.max(SHALLOWEST * deepest_m);
            self.multiplier(rpm, depth, refine).frequency_hz
        };
        Limit {
            rpm,
            depth_m: depth,
            chatter_hz: depth.map(chatter_hz),
        }
    }

    /// How many times the usual nodes it takes until the limit stands still at some of the speeds.
    fn refinement(&self, speeds: &[f64], deepest_m: f64) -> f64 {
        let mut probes = vec![speeds[0], speeds[speeds.len() / 2]];
        probes.dedup();
        let at = |refine: f64| -> Vec<Option<f64>> {
            let limit = |rpm: &f64| self.limit(*rpm, deepest_m, refine).depth_m;
            probes.iter().map(limit).collect()
        };
        let stands = |pair: (&Option<f64>, &Option<f64>)| match pair {
            (Some(a), Some(b)) => (a - b).abs() <= CONVERGED * b,
            (a, b) => a.is_some() == b.is_some(),
        };
        let (mut refine, mut before) = (1.0, at(1.0));
        while refine < FINEST {
            let finer = at(FINER * refine);
            if before.iter().zip(&finer).all(stands) {
                break;
            }
            (refine, before) = (FINER * refine, finer);
        }
        refine
    }
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    if arguments.along {
        return along::run(&arguments);
    }
    let case = input::read(&arguments)?;
    let deepest = deepest(&arguments, &case.tool)?;
    if let Some(at) = &arguments.at {
        return one(&arguments, &case, at);
    }
    let speeds = speeds(&arguments, &case)?;
    let refine = case.refinement(&speeds, deepest);
    let limits: Vec<Limit> = speeds
        .par_iter()
        .map(|rpm| case.limit(*rpm, deepest, refine))
        .collect();
    let lobes = account::Lobes {
        case: &case,
        limits: &limits,
        deepest_m: deepest,
        refine,
    };
    let report = written(&arguments, &format!("lobes-{}", case.name), || lobes.page())?;
    match arguments.json {
        true => print_result("lobes", &case.inputs, lobes.json())?,
        false => print(&lobes.text(report.as_deref()))?,
    }
    Ok(Ending::Done)
}

/// The report, unless none is wanted.
fn written(arguments: &Arguments, name: &str, page: impl Fn() -> Page) -> Outcome<Option<PathBuf>> {
    if arguments.dry_run {
        return Ok(None);
    }
    let place = crate::measurement::workspace::Place::of(&arguments.file);
    let written = folder::write_as(&place.reports(), &format!("{name}.html"), &page())?;
    Ok(written.last().cloned())
}

fn one(arguments: &Arguments, case: &Case, at: &str) -> Outcome<Ending> {
    let (rpm, depth_mm) = point(at)?;
    within_flute(&case.tool, depth_mm).map_err(|p| p.in_column("--at"))?;
    let mut found = case.multiplier(rpm, 1e-3 * depth_mm, 1.0);
    for refine in [1.4, 2.0, 2.8] {
        let finer = case.multiplier(rpm, 1e-3 * depth_mm, refine);
        let moved = (finer.radius - found.radius).abs();
        found = finer;
        if moved < 1e-6 {
            break;
        }
    }
    match arguments.json {
        true => print_result(
            "lobes",
            &case.inputs,
            account::one(rpm, depth_mm, &found, case),
        )?,
        false => print(&account::sentence(rpm, depth_mm, &found))?,
    }
    // a question, and no limit that was set
    Ok(Ending::Done)
}

fn point(text: &str) -> Outcome<(f64, f64)> {
    let numbers: Vec<f64> = text
        .split(',')
        .filter_map(|t| t.trim().parse().ok())
        .collect();
    match numbers.as_slice() {
        [rpm, depth] if good(*rpm) && good(*depth) && *rpm >= SLOWEST => Ok((*rpm, *depth)),
        _ => Err(Problem::new(
            format!("`{text}` is no speed and depth"),
            "write for example --at 5000,1.0: rev/min and mm, both above zero",
        )
        .in_column("--at")),
    }
}

fn good(x: f64) -> bool {
    x.is_finite() && x > 0.0 && x < 1e6
}

/// Slowest spindle that is looked at, rev/min.
const SLOWEST: f64 = 100.0;
/// Most speeds of one run.
const MOST_SPEEDS: f64 = 5000.0;

/// Above the flutes nothing cuts.
fn within_flute(tool: &Tool, depth_mm: f64) -> Outcome<()> {
    let flute_mm = 1e3 * tool.flute_m;
    match depth_mm <= flute_mm * (1.0 + 1e-9) {
        true => Ok(()),
        false => Err(Problem::new(
            format!("is {depth_mm} mm deep, and the flutes end at {flute_mm:.3} mm"),
            "ask for a depth within the flutes, or correct flute_mm of the tool",
        )),
    }
}

fn deepest(arguments: &Arguments, tool: &Tool) -> Outcome<f64> {
    match arguments.depth_mm {
        Some(mm) if good(mm) => within_flute(tool, mm)
            .map(|()| 1e-3 * mm)
            .map_err(|p| p.in_column("--depth-mm")),
        Some(mm) => Err(
            Problem::new(format!("is {mm}"), "give a depth above zero in mm")
                .in_column("--depth-mm"),
        ),
        None if tool.flute_m.is_finite() => Ok(tool.flute_m),
        None => Ok(2.0 * tool.radius_m),
    }
}

fn speeds(arguments: &Arguments, case: &Case) -> Outcome<Vec<f64>> {
    let Some(text) = &arguments.rpm else {
        let own = case
            .spindle_rad_s
            .map_or(10_000.0, |w| w.abs() * 60.0 / TAU);
        return Ok((0..=100)
            .map(|i| own * (0.5 + 0.01 * f64::from(i)))
            .collect());
    };
    let numbers: Vec<f64> = text
        .split(':')
        .filter_map(|t| t.trim().parse().ok())
        .collect();
    let refuse = || {
        Problem::new(
            format!("`{text}` is no range of speeds"),
            format!("write for example --rpm 5000:20000:100, from {SLOWEST} rev/min, at most {MOST_SPEEDS} speeds"),
        )
        .in_column("--rpm")
    };
    let [from, to, step] = numbers.as_slice() else {
        return Err(refuse());
    };
    let count = ((to - from) / step + 1e-9).floor();
    let right = good(*from) && good(*to) && good(*step) && from >= &SLOWEST && to >= from;
    match right && count < MOST_SPEEDS {
        true => Ok((0..=count as usize)
            .map(|i| from + i as f64 * step)
            .collect()),
        false => Err(refuse()),
    }
}
