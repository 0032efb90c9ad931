//! The report page of `ident screw`.

use super::{Judged, motion, tables};
use crate::fit::screw::Account;
use crate::fit::screw::positions::{Target, in_mm};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::page::{Block, Page, Tone};

/// The page.
pub fn page(judged: &Judged) -> Page {
    let readings: usize = judged.tests.iter().map(|test| test.readings.len()).sum();
    let subtitle = format!(
        "{readings} readings at {} targets",
        judged.account.targets.len()
    );
    let mut page = Page::new(format!("Linear axis {}", judged.stem()), subtitle);
    page.synthetic = judged.table.synthetic;
    page = page.with(Block::verdict(Tone::Neutral, tables::sentence(judged)));
    for remark in judged.remarks() {
        page = page.with(Block::verdict(Tone::Attention, capital(&remark)));
    }
    page = page
        .with(Block::heading("Error over the travel"))
        .with(Block::Chart(errors(
            judged,
            &judged.account,
            "",
            "as measured",
        )));
    if let Some((_, before)) = &judged.before {
        page = page.with(Block::Chart(errors(judged, before, "-before", "before")));
    }
    page = page
        .with(Block::Table(tables::figures(judged)))
        .with(Block::heading("Groups of quadratics"))
        .with(Block::Chart(groups(judged)))
        .with(Block::Table(tables::groups(judged)));
    if let Some(least) = tables::least(judged) {
        page = page.with(Block::details(
            "The least number of groups",
            vec![Block::Table(least)],
        ));
    }
    if judged.motion.is_empty() {
        return page;
    }
    page.with(Block::heading("The axis in motion"))
        .with(Block::Chart(motion::chart(judged)))
        .with(Block::Table(motion::table(judged)))
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    format!("{}{}.", first.unwrap_or_default(), letters.as_str())
}

fn axes() -> (Axis, Axis) {
    (
        Axis::new("Target", "mm"),
        Axis::new("Actual − target", "µm"),
    )
}

/// Means of both directions with their k s bands.
fn errors(judged: &Judged, account: &Account, ending: &str, state: &str) -> Chart {
    let (x, y) = axes();
    let mut panel = Panel::new(x, y);
    let k = account.figures.coverage;
    type Side = fn(&Target) -> &Vec<f64>;
    let sides: [(&str, Side); 2] = [("forward", |t| &t.forward), ("backward", |t| &t.backward)];
    for (name, side) in sides {
        let band = account.targets.iter().filter_map(|t| {
            let (mean, s) = (Target::middle(side(t))?, Target::deviation(side(t))?);
            Some([in_mm(t.at), (mean - k * s) * 1e6, (mean + k * s) * 1e6])
        });
        let band: Vec<[f64; 3]> = band.collect();
        if !band.is_empty() {
            panel = panel.with(Series::band(format!("{name} ± {k} s"), &band));
        }
        let mean = account
            .targets
            .iter()
            .filter_map(|t| Some([in_mm(t.at), Target::middle(side(t))? * 1e6]));
        let mean: Vec<[f64; 2]> = mean.collect();
        if !mean.is_empty() {
            panel = panel.with(Series::line(format!("{name}, mean"), mean));
        }
    }
    let caption = "The distance of the two lines is the backlash, their common shape the error of the pitch, the bands what does not repeat.";
    Chart::new(
        format!("{}-error{ending}", judged.stem()),
        format!("Error over the travel, {state}"),
        caption,
    )
    .with(panel)
    .synthetic(judged.table.synthetic)
}

/// Stretches of the curve of one group.
const CURVE: i32 = 24;

/// Mean error with the quadratics, and what they leave.
fn groups(judged: &Judged) -> Chart {
    let account = &judged.account;
    let mean: Vec<[f64; 2]> = account
        .kept
        .iter()
        .filter_map(|t| Some([in_mm(t.at), t.mean()? * 1e6]))
        .collect();
    let (mut curve, mut rest) = (Vec::new(), Vec::new());
    let mut points = mean.iter();
    for group in &account.groups {
        for point in points.by_ref().take(group.points) {
            rest.push([point[0], point[1] - group.at(point[0])]);
        }
        for i in 0..=CURVE {
            let share = f64::from(i) / f64::from(CURVE);
            let x = group.from_mm + share * (group.to_mm - group.from_mm);
            curve.push([x, group.at(x)]);
        }
        curve.push([group.to_mm, f64::NAN]);
    }
    let (x, y) = axes();
    let left = Panel::new(x.clone(), Axis::new("Left", "µm"))
        .with(Series::points("mean less quadratics", rest))
        .noted(format!("limit ± {} µm", judged.limit_um));
    Chart::new(
        format!("{}-groups", judged.stem()),
        "Mean error in groups of quadratics",
        "Each group holds as many targets as the limit of the residual allows; correcting along the quadratics does not disturb the speed as a point table does.",
    )
    .with(Panel::new(x, y).with(Series::points(judged.account.mean_of(), mean)).with(Series::line("quadratics", curve)))
    .with(left)
    .synthetic(judged.table.synthetic)
}
