//! `ident lobes --along`: how deep one may cut at each place of the path.

use super::super::output::{print, print_result};
use super::account::{closed, lines, opened, panels};
use super::{Arguments, Case, Ending, Limit, SHALLOWEST, deepest, input, speeds, written};
use crate::ground::problem::{Outcome, Problem};
use crate::process::tip_modes::{Station, carrier};
use crate::report::json::number;
use crate::sheet::chart::Chart;
use crate::sheet::number::significant;
use crate::sheet::page::{Block, Page};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::Path;

/// Stations of a path, and the shortest way between two, m.
const STATIONS: f64 = 100.0;
const NEAREST: f64 = 1e-3;

const EVERYWHERE: &str = "Everywhere but in rapid motions the tool is taken to cut with this side and width, in the air too; where it plunges, the feed is put across.";

/// The limit at one place of the path.
struct Place {
    s_mm: f64,
    limit: Limit,
}

/// Limits along a path.
struct Along {
    case: Case,
    places: Vec<Place>,
    speeds: Vec<f64>,
    deepest_mm: f64,
}

/// The verb with `--along`.
pub fn run(arguments: &Arguments) -> Outcome<Ending> {
    let (mut case, planned) = input::planned(arguments)?;
    case.remarks.push(EVERYWHERE.into());
    let measured = input::tool_modes(arguments, &mut case)?;
    let deepest_m = deepest(arguments, &case.tool)?;
    let speeds = asked(arguments, &case)?;
    let plan = &planned.plan;
    let stations = Station::along(plan, (plan.path.length / STATIONS).max(NEAREST));
    if stations.is_empty() {
        let remedy = "ask for one place with --station";
        return Err(
            Problem::new("holds rapid motions only", remedy).in_file(&planned.toolpath.path)
        );
    }
    let own = carrier(&planned.job, &plan.cell.robot);
    let here = |station: &Station| -> Outcome<Case> {
        let mut modes = station.modes(&mut own.clone())?;
        modes.extend(&measured);
        Ok(Case {
            modes,
            ..case.clone()
        })
    };
    let middle = here(&stations[stations.len() / 2])?;
    let refine = middle.refinement(&speeds, deepest_m);
    let at = |station: &Station| -> Outcome<Place> {
        Ok(Place {
            s_mm: 1e3 * station.s_m,
            limit: least(&here(station)?, &speeds, deepest_m, refine),
        })
    };
    let places: Outcome<Vec<Place>> = stations.par_iter().map(at).collect();
    let places = places.map_err(|problem| problem.in_file(&planned.job.path))?;
    let name = format!("lobes-along-{}", case.name);
    let along = Along {
        case,
        places,
        speeds,
        deepest_mm: 1e3 * deepest_m,
    };
    let report = written(arguments, &name, || along.page(&name))?;
    match arguments.json {
        true => print_result("lobes", &along.case.inputs, along.json())?,
        false => print(&along.text(report.as_deref()))?,
    }
    Ok(Ending::Done)
}

/// The tool's own speed, or those that were asked for.
fn asked(arguments: &Arguments, case: &Case) -> Outcome<Vec<f64>> {
    match (&arguments.rpm, case.spindle_rad_s) {
        (Some(_), _) => speeds(arguments, case),
        (None, Some(spindle)) => Ok(vec![spindle.abs() * 60.0 / TAU]),
        (None, None) => Err(Problem::new(
            "states no speed of the spindle",
            "add spindle_rpm to [tool], or give speeds with --rpm",
        )
        .in_file(&arguments.file)),
    }
}

/// The shallowest limit of all speeds.
fn least(case: &Case, speeds: &[f64], deepest_m: f64, refine: f64) -> Limit {
    let limits = speeds.iter().map(|rpm| case.limit(*rpm, deepest_m, refine));
    let depth = |l: &Limit| l.depth_m.unwrap_or(f64::INFINITY);
    let found = limits.min_by(|a, b| depth(a).total_cmp(&depth(b)));
    found.unwrap_or(Limit {
        rpm: f64::NAN,
        depth_m: None,
        chatter_hz: None,
    })
}

impl Along {
    fn least(&self) -> Option<&Place> {
        let found = self.places.iter().filter(|p| p.limit.depth_m.is_some());
        found.min_by(|a, b| {
            let depth = |p: &Place| p.limit.depth_m.unwrap_or(f64::INFINITY);
            depth(a).total_cmp(&depth(b))
        })
    }

    fn json(&self) -> Value {
        let station = |p: &Place| {
            let depth = p.limit.depth_m.map(|d| number(1e3 * d));
            json!({
                "s_mm": number(p.s_mm),
                "rpm": number(p.limit.rpm),
                "limit_depth_mm": depth,
                "chatter_Hz": p.limit.chatter_hz.map(number),
            })
        };
        let rpm: Vec<Value> = self.speeds.iter().map(|rpm| number(*rpm)).collect();
        json!({
            "rpm": rpm,
            "stations": self.places.iter().map(station).collect::<Vec<Value>>(),
            "least": self.least().map(station),
            "searched_to_mm": number(self.deepest_mm),
            "remarks": self.case.remarks,
        })
    }

    fn sentence(&self) -> String {
        let deepest = significant(self.deepest_mm, 3);
        let at = match self.speeds.as_slice() {
            [one] => format!("at {one:.0} rev/min"),
            _ => "at any of these speeds".to_string(),
        };
        match self.least().and_then(|p| Some((p, p.limit.depth_m?))) {
            None => format!("No chatter down to {deepest} mm anywhere along the path {at}."),
            Some((place, 0.0)) => format!(
                "After {:.1} mm of way even the shallowest cut that was looked at chatters {at}, {} mm.",
                place.s_mm,
                significant(SHALLOWEST * self.deepest_mm, 3)
            ),
            Some((place, depth)) => format!(
                "The limit is nowhere along the path below {} mm {at}; it is least after {:.1} mm of way.",
                significant(1e3 * depth, 3),
                place.s_mm
            ),
        }
    }

    fn text(&self, report: Option<&Path>) -> String {
        let mut text = format!("{}\n\n  way mm  limit mm  chatter Hz\n", self.sentence());
        let place = |p: &'_ Place| format!("{:>8.1}", p.s_mm);
        lines(&mut text, self.places.iter().map(|p| (place(p), &p.limit)));
        closed(text, &self.case, report)
    }

    fn page(&self, name: &str) -> Page {
        let title = format!("Stability along the path: {}", self.case.name);
        let page = opened(title, &self.case, self.sentence());
        page.with(Block::Chart(self.chart(name)))
    }

    fn chart(&self, name: &str) -> Chart {
        let chart = Chart::new(
            name,
            "Stability along the path",
            "Above: the depth of cut at which chatter starts at each place of the path, rapid motions left out; where the line is broken there is none down to the deepest cut looked at. Below: the frequency of that chatter.",
        );
        let limits = self.places.iter().map(|p| (p.s_mm, &p.limit)).collect();
        panels(chart, ["Way along the path", "mm"], limits)
    }
}
