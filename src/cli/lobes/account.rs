//! What `ident lobes` says.

use super::{Case, Limit, SHALLOWEST};
use crate::cutting::stability::Multiplier;
use crate::report::json::number;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::significant;
use crate::sheet::page::{Block, Page, Tone};
use serde_json::{Value, json};
use std::path::Path;

/// Limits over the speed.
pub struct Lobes<'a> {
    pub case: &'a Case,
    pub limits: &'a [Limit],
    pub deepest_m: f64,
    pub refine: f64,
}

impl Lobes<'_> {
    /// The body of the JSON.
    pub fn json(&self) -> Value {
        let of = |pick: &dyn Fn(&Limit) -> Option<f64>| -> Value {
            let all = self.limits.iter().map(pick);
            all.map(|v| v.map_or(Value::Null, number)).collect()
        };
        json!({
            "rpm": of(&|l| Some(l.rpm)),
            "limit_depth_mm": of(&|l| l.depth_m.map(|d| 1e3 * d)),
            "chatter_Hz": of(&|l| l.chatter_hz),
            "searched_to_mm": number(1e3 * self.deepest_m),
            "nodes_factor": number(self.refine),
            "least": self.least().map(|(rpm, mm)| json!({"rpm": number(rpm), "depth_mm": number(mm)})),
            "remarks": self.case.remarks,
        })
    }

    fn least(&self) -> Option<(f64, f64)> {
        let all = self
            .limits
            .iter()
            .filter_map(|l| Some((l.rpm, 1e3 * l.depth_m?)));
        all.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn sentence(&self) -> String {
        let deepest = significant(1e3 * self.deepest_m, 3);
        match self.least() {
            None => format!("No chatter down to {deepest} mm at any of these speeds."),
            Some((rpm, 0.0)) => format!(
                "At {rpm:.0} rev/min even the shallowest cut that was looked at chatters, {} mm.",
                significant(1e3 * SHALLOWEST * self.deepest_m, 3)
            ),
            Some((rpm, mm)) => format!(
                "The limit is nowhere below {} mm; that is at {rpm:.0} rev/min (looked at down to {deepest} mm).",
                significant(mm, 3)
            ),
        }
    }

    /// The account.
    pub fn text(&self, report: Option<&Path>) -> String {
        let mut text = format!("{}\n\n rev/min  limit mm  chatter Hz\n", self.sentence());
        lines(
            &mut text,
            self.limits.iter().map(|l| (format!("{:>8.0}", l.rpm), l)),
        );
        closed(text, self.case, report)
    }

    /// The report page.
    pub fn page(&self) -> Page {
        let title = format!("Stability: {}", self.case.name);
        opened(title, self.case, self.sentence()).with(Block::Chart(self.chart()))
    }

    fn chart(&self) -> Chart {
        let chart = Chart::new(
            format!("lobes-{}", self.case.name),
            "Stability lobes",
            "Above: the depth of cut at which chatter starts; where the line is broken there is none down to the deepest cut looked at, where it is zero the shallowest chatters. Below: the frequency of that chatter.",
        );
        let limits = self.limits.iter().map(|l| (l.rpm, l)).collect();
        panels(chart, ["Spindle speed", "rev/min"], limits)
    }
}

/// A page with its verdict and its remarks.
pub fn opened(title: String, case: &Case, sentence: String) -> Page {
    let inputs: Vec<&str> = case.inputs.iter().map(|i| i.0.as_str()).collect();
    let page = Page::new(title, inputs.join(", "));
    let page = page.with(Block::verdict(Tone::Neutral, sentence));
    let with = |page: Page, remark: &String| page.with(Block::verdict(Tone::Neutral, remark));
    case.remarks.iter().fold(page, with)
}

/// Limits and their chatter over anything.
pub fn panels(chart: Chart, [label, unit]: [&str; 2], limits: Vec<(f64, &Limit)>) -> Chart {
    let over = |y: &dyn Fn(&Limit) -> Option<f64>| {
        let point = |(x, l): &(f64, &Limit)| [*x, y(l).unwrap_or(f64::NAN)];
        limits.iter().map(point).collect::<Vec<[f64; 2]>>()
    };
    let depth = over(&|l| l.depth_m.map(|d| 1e3 * d));
    let hertz = over(&|l| l.chatter_hz);
    let axis = || Axis::new(label, unit);
    let above = Panel::new(axis(), Axis::new("Depth of cut", "mm"));
    let below = Panel::new(axis(), Axis::new("Chatter", "Hz"));
    chart
        .with(above.with(Series::line("limit", depth)))
        .with(below.with(Series::points("chatter", hertz)))
}

/// A line of the account for some of the limits, evenly spread.
pub fn lines<'a>(text: &mut String, limits: impl ExactSizeIterator<Item = (String, &'a Limit)>) {
    let step = limits.len().div_ceil(MOST_LINES).max(1);
    for (place, limit) in limits.step_by(step) {
        let depth = limit.depth_m.map(|d| significant(1e3 * d, 4));
        let depth = depth.unwrap_or("deeper".into());
        let hertz = limit
            .chatter_hz
            .map_or(String::new(), |f| format!("{f:.1}"));
        *text += &format!("{place}  {depth:>8}  {hertz:>10}\n");
    }
}

/// The account with its remarks and its report.
pub fn closed(mut text: String, case: &Case, report: Option<&Path>) -> String {
    for remark in &case.remarks {
        text += &format!("note: {remark}\n");
    }
    if let Some(path) = report {
        text += &format!("\nreport {}\n", path.display());
    }
    text
}

/// Lines of the account.
const MOST_LINES: usize = 25;

/// The body of the JSON at one point.
pub fn one(rpm: f64, depth_mm: f64, found: &Multiplier, case: &Case) -> Value {
    json!({
        "at": {"rpm": number(rpm), "depth_mm": number(depth_mm)},
        "spectral_radius": number(found.radius),
        "chatter_Hz": number(found.frequency_hz),
        "stable": found.radius < 1.0,
        "remarks": case.remarks,
    })
}

/// The same in words.
pub fn sentence(rpm: f64, depth_mm: f64, found: &Multiplier) -> String {
    let word = if found.radius < 1.0 {
        "stable"
    } else {
        "chatter"
    };
    format!(
        "{rpm:.0} rev/min, {depth_mm} mm: {word}, spectral radius {:.6} per tooth passing, {:.1} Hz\n",
        found.radius, found.frequency_hz
    )
}
