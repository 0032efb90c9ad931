//! `ident diagnose --next N`: which set-ups on the whole robot would tell most.

mod figure;
mod tables;

use super::kind::KINDS;
use super::{Arguments, campaign};
use crate::cli::Ending;
use crate::cli::output::{print, print_result, tell};
use crate::cli::run::place;
use crate::cli::validate::fits;
use crate::findings::next_setups::{Chosen, Desk, Plan, Tells};
use crate::fit::axis_tests::{self, AxisTest};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use crate::measurement::leading::{front_of, kind_of};
use crate::measurement::workspace::{Place, only_of_kind, resolve};
use crate::measurement::workspace_test::{DIRECTIONS, WorkspaceTest};
use crate::report::{folder, text};
use crate::robot::check;
use crate::robot::load::{Loaded, load};
use crate::sheet::page::{Block, Page, Tone};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The kind of measurement that a plan continues.
const KIND: &str = "workspace";
/// Other kinds that name the robot of a campaign.
const NAMING: [&str; 3] = ["hammer", "load-cycle", "joint-motion"];

/// What a plan starts from.
struct Start {
    place: Place,
    base: Loaded,
    tests: Vec<AxisTest>,
    points: Option<WorkspaceTest>,
    synthetic: bool,
}

/// Runs the verb with `--next`.
pub fn run(arguments: &Arguments, count: usize) -> Outcome<Ending> {
    let start = start(&arguments.files)?;
    let desk = Desk::new(&start.base.robot, &start.tests, start.points.as_ref());
    let open = start.open()?;
    let plan = desk.plan(count, &open);
    let page = page(&start, &plan, open.len());
    let mut report = None;
    if !arguments.dry_run {
        let written = folder::write_as(&start.place.reports(), "next.html", &page)?;
        report = written.last().cloned();
    }
    match arguments.json {
        true => print_result("diagnose", &start.inputs(), body(&plan, report.as_deref()))?,
        false => print(&account(&plan, open.len(), report.as_deref()))?,
    }
    Ok(Ending::Done)
}

fn start(files: &[PathBuf]) -> Outcome<Start> {
    match files {
        [] => in_campaign(place(None)?),
        [folder] if folder.is_dir() => in_campaign(place(Some(folder))?),
        [file] => {
            let (path, said) = resolve(file)?;
            said.iter().for_each(|s| tell(s));
            of_points(Place::of(&path), &path)
        }
        several => Err(Problem::new(
            format!(
                "--next plans for one robot, and {} files are given",
                several.len()
            ),
            "give one file of kind workspace, or the folder of the campaign",
        )),
    }
}

fn in_campaign(place: Place) -> Outcome<Start> {
    match place.files_of(KIND)?.is_empty() {
        true => of_name(place),
        false => {
            let path = only_of_kind(&place.measurements(), KIND)?;
            of_points(place, &path)
        }
    }
}

/// Continues a workspace test.
fn of_points(place: Place, path: &Path) -> Outcome<Start> {
    let kind = kind_of(path).map_err(|problem| problem.in_file(path))?;
    if kind.as_deref().is_some_and(|kind| kind != KIND) {
        let remedy = "give a file of kind workspace, or the folder of the campaign";
        let said = "--next plans set-ups on the whole robot, which this file says nothing about";
        return Err(Problem::new(said, remedy).in_file(path));
    }
    let test = WorkspaceTest::read(path)?;
    let base = load(&test.facts.robot, Some(path)).map_err(|p| p.in_file(path))?;
    fits(&base.robot, &test)?;
    Ok(Start {
        tests: axis_tests::read(&place.fits(), &place.measurements())?,
        synthetic: test.facts.synthetic,
        points: Some(test),
        place,
        base,
    })
}

/// Begins with the robot that other measurements of the campaign name.
fn of_name(place: Place) -> Outcome<Start> {
    for kind in NAMING {
        for path in place.files_of(kind)? {
            let Ok(front) = front_of(&path) else {
                continue;
            };
            if let Some(name) = front.text("robot").map_err(|p| p.in_file(&path))? {
                let base = load(name, Some(&path)).map_err(|p| p.in_file(&path))?;
                elastic(&base)?;
                return Ok(Start {
                    tests: axis_tests::read(&place.fits(), &place.measurements())?,
                    synthetic: front.synthetic(),
                    points: None,
                    place,
                    base,
                });
            }
        }
    }
    let remedy = "add `# robot = \"kr210\"` to the front matter of one of them";
    Err(
        Problem::new("holds no measurement that names its robot", remedy)
            .in_file(&place.measurements()),
    )
}

fn elastic(base: &Loaded) -> Outcome<()> {
    match base.robot.is_elastic() {
        true => check::bodies(&base.robot),
        false => {
            let what = format!("nothing in the robot `{}` is elastic", base.robot.name);
            let remedy = "add `drive = { stiffness_Nm_rad = .. }` to its joints";
            Err(Problem::new(what, remedy))
        }
    }
}

impl Start {
    /// Pairs of places that the diagnosis of these points cannot tell apart.
    fn open(&self) -> Outcome<Vec<(String, String)>> {
        let diagnosed = KINDS.iter().any(|kind| kind.0 == KIND);
        let Some(test) = self.points.as_ref().filter(|_| diagnosed) else {
            return Ok(Vec::new());
        };
        let one = campaign::one(&test.path, &self.place, &self.tests)?;
        let mut pairs = Vec::new();
        for group in &one.found.answer().groups {
            for (i, a) in group.sites.iter().enumerate() {
                let others = group.sites[..i].iter().filter(|b| *b != a);
                pairs.extend(others.map(|b| (b.clone(), a.clone())));
            }
        }
        pairs.sort();
        pairs.dedup();
        Ok(pairs)
    }

    fn inputs(&self) -> Vec<(String, String)> {
        let points = self.points.iter();
        let points = points.map(|t| (t.path.display().to_string(), t.sha256.clone()));
        let tests = self.tests.iter();
        let tests = tests.map(|t| (t.path.display().to_string(), t.sha256.clone()));
        points.chain([self.base.input()]).chain(tests).collect()
    }
}

fn page(start: &Start, plan: &Plan, open: usize) -> Page {
    let title = match start.place.campaign.as_str() {
        "" => format!("What to measure next on {}", start.base.robot.name),
        name => format!("What to measure next: {name}"),
    };
    let points = start
        .points
        .as_ref()
        .map_or(0, |t| t.facts.joint_angles.len());
    let subtitle = format!(
        "{} with {} axis tests and {points} points; {} set-ups compared",
        start.base.path,
        start.tests.len(),
        plan.compared
    );
    let mut page = Page::new(title, subtitle);
    page.synthetic = start.synthetic;
    page.with(Block::verdict(Tone::Neutral, tables::sentence(plan, open)))
        .with(Block::heading("The set-ups"))
        .with(Block::Table(tables::setups(plan)))
        .with(Block::Chart(figure::poses(
            &start.base.robot,
            plan,
            start.synthetic,
        )))
        .with(Block::heading("What they leave open"))
        .with(Block::Table(tables::spreads(plan)))
}

fn account(plan: &Plan, open: usize, report: Option<&Path>) -> String {
    let mut said = text::indented(&tables::sentence(plan, open), 0);
    said.push_str(&format!("\n{}", text::table(&tables::setups(plan))));
    if let Some(path) = report {
        said.push_str(&format!("\nreport {}\n", path.display()));
    }
    said
}

fn body(plan: &Plan, report: Option<&Path>) -> Value {
    let numbered = plan.chosen.iter().enumerate();
    let next: Vec<Value> = numbered.map(|(i, one)| setup(i + 1, one)).collect();
    json!({
        "next": next,
        "gain_nats": plan.chosen.iter().map(|one| one.gain).sum::<f64>(),
        "compared": plan.compared,
        "noise": {
            "displacement_m_N": plan.noise.slope,
            "setup_repeatability": plan.noise.repeatability,
            "measured": plan.noise.measured,
        },
        "report": report.map(|path| path.display().to_string()),
    })
}

fn setup(rank: usize, one: &Chosen) -> Value {
    let degrees: Vec<f64> = one
        .setting
        .angles
        .iter()
        .map(|q| rounded(q / DEGREE))
        .collect();
    let tells = match &one.tells {
        Tells::Apart { sites, correlation } => json!({"sites": sites, "correlation": correlation}),
        Tells::Size { site, std } => json!({"sites": [site], "relative_std": std}),
    };
    json!({
        "rank": rank,
        "joint_angles_deg": degrees,
        "tool": one.setting.reach.word(),
        "direction": DIRECTIONS[one.setting.direction],
        "sensor": one.setting.seat.name(),
        "gain_nats": one.gain,
        "tells": tells,
    })
}

/// Four decimals, as controllers show.
fn rounded(degrees: f64) -> f64 {
    (degrees * 1e4).round() / 1e4
}
