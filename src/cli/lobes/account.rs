//! What `ident lobes` says.

use super::{Case, Limit};
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
            Some((rpm, mm)) => format!(
                "The limit is nowhere below {} mm; that is at {rpm:.0} rev/min (looked at down to {deepest} mm).",
                significant(mm, 3)
            ),
        }
    }

    /// The account.
    pub fn text(&self, report: Option<&Path>) -> String {
        let mut text = format!("{}\n\n rev/min  limit mm  chatter Hz\n", self.sentence());
        let step = self.limits.len().div_ceil(MOST_LINES).max(1);
        for l in self.limits.iter().step_by(step) {
            let depth = l
                .depth_m
                .map_or("deeper".into(), |d| significant(1e3 * d, 4));
            let hertz = l.chatter_hz.map_or(String::new(), |f| format!("{f:.1}"));
            text += &format!("{:>8.0}  {depth:>8}  {hertz:>10}\n", l.rpm);
        }
        for remark in &self.case.remarks {
            text += &format!("note: {remark}\n");
        }
        if let Some(path) = report {
            text += &format!("\nreport {}\n", path.display());
        }
        text
    }

    /// The report page.
    pub fn page(&self) -> Page {
        let inputs: Vec<&str> = self.case.inputs.iter().map(|i| i.0.as_str()).collect();
        let mut page = Page::new(format!("Stability: {}", self.case.name), inputs.join(", "))
            .with(Block::verdict(Tone::Neutral, self.sentence()));
        for remark in &self.case.remarks {
            page = page.with(Block::verdict(Tone::Neutral, remark));
        }
        page.with(Block::Chart(self.chart()))
    }

    fn chart(&self) -> Chart {
        let speed = || Axis::new("Spindle speed", "rev/min");
        let depth = |l: &Limit| [l.rpm, l.depth_m.map_or(f64::NAN, |d| 1e3 * d)];
        let hertz = |l: &Limit| [l.rpm, l.chatter_hz.unwrap_or(f64::NAN)];
        Chart::new(
            format!("lobes-{}", self.case.name),
            "Stability lobes",
            "Above: the depth of cut at which chatter starts; where the line is broken there is none down to the deepest cut looked at. Below: the frequency of that chatter.",
        )
        .with(
            Panel::new(speed(), Axis::new("Depth of cut", "mm"))
                .with(Series::line("limit", self.limits.iter().map(depth).collect())),
        )
        .with(
            Panel::new(speed(), Axis::new("Chatter", "Hz"))
                .with(Series::points("chatter", self.limits.iter().map(hertz).collect())),
        )
    }
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
