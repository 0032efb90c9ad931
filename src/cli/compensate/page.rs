//! The report page of `ident compensate`.

use super::super::part_map::{classes, thinned};
use super::account;
use crate::compensation::corrected::{Corrected, Met};
use crate::compensation::remaining::Station;
use crate::ground::files;
use crate::ground::spatial::norm;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::{ABSENT, significant};
use crate::sheet::page::{Block, Page, Tone};
use crate::sheet::table::Table;

/// Most points of one line.
const POINTS: usize = 2000;
/// Most points of a map.
const PLACES: usize = 3000;

/// The page.
pub fn page(result: &Corrected) -> Page {
    let path = &result.planned.toolpath.path;
    let name = files::name(path);
    let subtitle = format!(
        "{} for the robot {}",
        result.planned.job.path.display(),
        result.planned.plan.cell.robot.name
    );
    let mut page = Page::new(format!("Compensated path: {name}"), subtitle);
    page.synthetic = result.planned.toolpath.synthetic || result.planned.job.synthetic;
    let tone = match result.met {
        Met::Yes => Tone::Good,
        Met::No => Tone::Bad,
        Met::NotCertain => Tone::Attention,
    };
    let mut sentences = account::sentences(result).into_iter();
    page = page.with(Block::verdict(tone, sentences.next().unwrap_or_default()));
    page = sentences.fold(page, |page, s| page.with(Block::text(s)));
    page.with(Block::heading("Before and after"))
        .with(Block::Chart(deviations(result)))
        .with(Block::Chart(map(result)))
        .with(Block::heading("What was checked"))
        .with(Block::Table(checked(result)))
}

/// What is left over the path, before and after.
fn deviations(result: &Corrected) -> Chart {
    let over = |stations: &[Station]| {
        // not a number beside the stock: lines end there
        let size = |s: &Station| {
            if s.cutting {
                1e3 * norm(s.left)
            } else {
                f64::NAN
            }
        };
        let seen = |s: &Station| if s.cutting { norm(s.left) } else { -1.0 };
        let kept = thinned(stations, POINTS, seen).into_iter();
        kept.map(|s| [1e3 * s.s_m, size(&s)]).collect::<Vec<_>>()
    };
    let [before, after] = &result.stations;
    let panel = Panel::new(
        Axis::new("Path", "mm"),
        Axis::new("Off the drawn path", "mm"),
    )
    .with(Series::dashed("before", over(before)))
    .with(Series::line("after", over(after)).emphasised());
    Chart::new(
        "compensate-deviation",
        "What is left",
        "Distance of the tool from the drawn path, in the cut, before and after.",
    )
    .with(panel)
    .synthetic(result.planned.job.synthetic)
}

/// The part from above before and after, in the same classes.
fn map(result: &Corrected) -> Chart {
    let top = 1e3 * result.before.max_m;
    let panel = |stations: &[Station], note: &str| {
        let cutting: Vec<Station> = stations.iter().filter(|s| s.cutting).copied().collect();
        let place = |s: &Station| [1e3 * s.at[0], 1e3 * s.at[1]];
        let size = |s: &Station| 1e3 * norm(s.left);
        classes(&thinned(&cutting, PLACES, size), place, size, top, "mm off").noted(note)
    };
    let [before, after] = &result.stations;
    let chart = Chart::new(
        "compensate-map",
        "The part before and after",
        "Distance of the tool from the drawn path, seen along z of the workpiece.",
    )
    .with(panel(before, "before"));
    let chart = result
        .beside
        .iter()
        .fold(chart, |chart, (name, left)| chart.with(panel(left, name)));
    chart
        .with(panel(after, result.method.name))
        .synthetic(result.planned.job.synthetic)
}

fn checked(result: &Corrected) -> Table {
    let header = ["what", "where", "worst", "limit", "unit", "at mm", "holds"];
    let table = Table::new("Along the corrected path", header).numeric([2, 3, 5]);
    result.checked.iter().fold(table, |table, c| {
        table.with([
            c.what.to_string(),
            c.site.clone(),
            significant(c.worst, 4),
            c.limit.map_or(ABSENT.into(), |l| significant(l, 4)),
            c.unit.to_string(),
            format!("{:.1}", 1e3 * c.s_m),
            if c.ok { "yes" } else { "no" }.to_string(),
        ])
    })
}
