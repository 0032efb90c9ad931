//! `ident robot report`: the robot in space, who gives way how much, and its modes as they swing.

use super::remark_text;
use crate::cli::Ending;
use crate::cli::output::{print, print_result};
use crate::experiments::robot_picture::{DrawnMode, chart, mode_blocks, modes, scene};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::ground::units::DEGREE;
use crate::measurement::workspace::Place;
use crate::motion::skeleton::{Share, Skeleton, mean_shares, shares, skeleton};
use crate::report::folder::write_as;
use crate::robot::check;
use crate::robot::load::{Loaded, load};
use crate::sheet::chart::Chart;
use crate::sheet::number::{engineering, fixed};
use crate::sheet::page::{Block, Page, Tone, stem};
use crate::sheet::table::Table;
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Modes that are drawn.
const DRAWN: usize = 6;

/// Arguments of `ident robot report`.
#[derive(Debug, Args)]
pub struct Report {
    /// Built-in name (kr210, kr300) or a robot file, TOML or URDF
    robot: String,
    /// Joint angles in degrees, A1 first [default: every joint at zero]
    #[arg(
        long,
        value_name = "Q1,..,Q6",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    joints_deg: Vec<f64>,
    /// Force at the tool for the shares, N, base frame [default: the mean over x, y and z]
    #[arg(
        long = "force-N",
        value_name = "X,Y,Z",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    force_n: Option<Vec<f64>>,
    /// Print one JSON document instead of text
    #[arg(long)]
    json: bool,
    /// Write no report
    #[arg(long)]
    dry_run: bool,
}

/// Joint angles as typed, in rad: one per joint.
pub(super) fn angles(degrees: &[f64], count: usize) -> Outcome<Vec<f64>> {
    match degrees.len() == count && degrees.iter().all(|q| q.is_finite()) {
        true => Ok(degrees.iter().map(|q| q * DEGREE).collect()),
        false => {
            let what = format!("{} angles for {count} joints", degrees.len());
            let remedy = "give one finite angle per joint, in degrees";
            Err(Problem::new(what, remedy).in_column("--joints-deg"))
        }
    }
}

/// The reports of a robot's campaign, else those of its name.
pub(super) fn results(loaded: &Loaded) -> PathBuf {
    let place = Place::of(Path::new(&loaded.path));
    match place.campaign.is_empty() {
        true => Path::new("reports").join(stem(&loaded.robot.name)),
        false => place.reports(),
    }
}

/// What the report tells.
struct Told {
    loaded: Loaded,
    joints: Vec<f64>,
    robot: Skeleton,
    shares: Vec<Share>,
    modes: Vec<DrawnMode>,
    /// Why there are no modes, if so.
    without_modes: Option<String>,
}

impl Report {
    /// Runs it.
    pub fn run(&self) -> Outcome<Ending> {
        let told = self.told()?;
        let remarks = check::remarks(&told.loaded.robot);
        let written = match self.dry_run {
            true => None,
            false => write_as(&results(&told.loaded), "robot.html", &told.page())?.pop(),
        };
        match self.json {
            true => print_result(
                "robot report",
                &[told.loaded.input()],
                told.json(written.as_ref()),
            )?,
            false => print(&told.text(written.as_ref()))?,
        }
        remarks
            .iter()
            .for_each(|remark| crate::cli::output::tell(&remark_text(remark)));
        Ok(Ending::Done)
    }

    fn told(&self) -> Outcome<Told> {
        let loaded = load(&self.robot, None)?;
        let joints = match self.joints_deg.is_empty() {
            true => vec![0.0; loaded.robot.dof()],
            false => angles(&self.joints_deg, loaded.robot.dof())?,
        };
        let robot = skeleton(&loaded.robot, &joints);
        let shares = match self.force()? {
            Some(force) => shares(&loaded.robot, &joints, force),
            None => mean_shares(&loaded.robot, &joints),
        };
        let (modes, without_modes) = match modes(&loaded.robot, &joints, &robot, DRAWN) {
            Ok(modes) => (modes, None),
            Err(problem) => (Vec::new(), Some(problem.what)),
        };
        Ok(Told {
            loaded,
            joints,
            robot,
            shares,
            modes,
            without_modes,
        })
    }

    fn force(&self) -> Outcome<Option<V3>> {
        let Some(given) = &self.force_n else {
            return Ok(None);
        };
        match given[..] {
            [x, y, z] if given.iter().all(|f| f.is_finite()) && given.iter().any(|f| *f != 0.0) => {
                Ok(Some([x, y, z]))
            }
            _ => {
                let problem = Problem::new(
                    "is no force",
                    "give three numbers, not all zero: --force-N 0,0,-500",
                );
                Err(problem.in_column("--force-N"))
            }
        }
    }
}

impl Told {
    fn posture(&self) -> String {
        let degrees: Vec<String> = self.joints.iter().map(|q| fixed(q / DEGREE, 1)).collect();
        format!("joints at {} °", degrees.join(", "))
    }

    fn page(&self) -> Page {
        let robot = &self.loaded.robot;
        let mut page = Page::new(format!("Robot {}", robot.name), self.posture());
        page = page.with(Block::text(format!("Source: {}", robot.source)));
        for remark in check::remarks(robot) {
            page = page.with(Block::verdict(Tone::Attention, remark_text(&remark)));
        }
        let told = |one: &Share| format!("{} {} %", one.site, fixed(100.0 * one.share, 0));
        let told: Vec<String> = self.shares.iter().map(told).collect();
        let caption = format!(
            "Links as straight lines between the points of the joints. Shares of the deflection of the tool: {}.",
            told.join(", ")
        );
        let figure = Chart::new(
            "robot",
            format!("{}, {}", robot.name, self.posture()),
            caption,
        );
        page = page
            .with(Block::heading("In space"))
            .with(Block::Scene(scene(
                &robot.name,
                &self.robot,
                &self.shares,
                &[],
            )))
            .with(Block::Chart(chart(figure, &self.robot, None)))
            .with(Block::heading("Who gives way"))
            .with(Block::Table(self.table()))
            .with(Block::heading("Modes"));
        if let Some(why) = &self.without_modes {
            page = page.with(Block::text(format!("No modes: {why}.")));
        }
        let modes = mode_blocks(&self.robot, &self.modes, "mode-");
        modes.into_iter().fold(page, Page::with)
    }

    fn table(&self) -> Table {
        let header = ["site", "drive", "bearing", "share of the deflection"];
        let mut table = Table::new("Springs", header).numeric(1..4);
        for share in &self.shares {
            let stiffness = |site: &str| {
                let mut springs = self.loaded.robot.springs();
                let found = springs.find(|(name, _)| name == site);
                found.map_or("-".into(), |(_, spring)| {
                    engineering(spring.stiffness, 3, "N·m/rad")
                })
            };
            table.push([
                share.site.clone(),
                stiffness(&share.site),
                stiffness(&format!("{}-tilt", share.site)),
                format!("{} %", fixed(100.0 * share.share, 1)),
            ]);
        }
        table
    }

    fn text(&self, written: Option<&PathBuf>) -> String {
        let mut text = format!("{}: {}\n", self.loaded.robot.name, self.posture());
        text += &crate::report::text::table(&self.table());
        for mode in &self.modes {
            text += &format!(
                "mode at {} Hz, damping {} %\n",
                fixed(mode.frequency_hz, 2),
                fixed(100.0 * mode.damping_ratio, 2)
            );
        }
        if let Some(why) = &self.without_modes {
            text += &format!("no modes: {why}\n");
        }
        written.map_or(text.clone(), |path| {
            text + &format!("written: {}\n", path.display())
        })
    }

    fn json(&self, written: Option<&PathBuf>) -> Value {
        let share =
            |one: &Share| json!({"site": one.site, "share": one.share, "point_m": one.point});
        let mode = |mode: &DrawnMode| json!({"frequency_Hz": mode.frequency_hz, "damping_ratio": mode.damping_ratio});
        json!({
            "name": self.loaded.robot.name,
            "line_m": self.robot.line,
            "shares": self.shares.iter().map(share).collect::<Vec<_>>(),
            "modes": self.modes.iter().map(mode).collect::<Vec<_>>(),
            "report": written.map(|path| path.display().to_string()),
        })
    }
}
