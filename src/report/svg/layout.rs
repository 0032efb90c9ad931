//! Where everything stands: from a chart to places in px.

use super::canvas::Frame;
use super::letters::width;
use super::scale::{self, Scale};
use super::ticks::{Ticks, ticks};
use crate::report::wrap::wrap;
use crate::sheet::chart::{Chart, Panel};

/// Width of every figure: full width of a page, and half of it still readable.
pub(super) const WIDTH: f64 = 720.0;
/// Air at the outer edges.
pub(super) const MARGIN: f64 = 14.0;
/// Size of tick labels, legend and notes.
pub(super) const SMALL: f64 = 15.0;
/// Size of axis labels.
pub(super) const NORMAL: f64 = 16.0;
/// Size of the title.
pub(super) const LARGE: f64 = 16.0;

/// One panel in its place.
pub(super) struct Placed<'a> {
    pub panel: &'a Panel,
    pub frame: Frame,
    pub x: Ticks,
    pub y: Ticks,
    /// False where the panel below shows the same x axis.
    pub labels_x: bool,
    /// Names of categories, broken into lines; turned if a single word is too wide.
    pub categories: Vec<Vec<String>>,
    pub turned: bool,
    /// Baseline of the label of the x axis.
    pub label_y: f64,
}

/// Height of a data area: stacked panels are flatter.
fn height(panels: usize) -> f64 {
    match panels {
        0 | 1 => 360.0,
        2 => 230.0,
        _ => 170.0,
    }
}

/// Height of the data area of a map.
const MAP: f64 = 320.0;
/// Width of the data area of a map, about: tick labels take the rest.
const MAP_WIDTH: f64 = WIDTH - 90.0;

/// The panels of a chart below `top`, and where they end.
pub(super) fn place(chart: &Chart, top: f64) -> (Vec<Placed<'_>>, f64) {
    let height = match chart.panels.iter().any(|panel| panel.equal) {
        true => MAP,
        false => height(chart.panels.len()),
    };
    let scales = scales(&chart.panels, height);
    let vertical =
        |(panel, (_, y)): (&Panel, &(Scale, Scale))| ticks(y, &panel.y.unit, height, SMALL, false);
    let y_ticks: Vec<Ticks> = chart.panels.iter().zip(&scales).map(vertical).collect();
    let left = left(&y_ticks, &chart.panels);
    let mut y = top;
    let mut placed = Vec::new();
    for (i, (panel, vertical)) in chart.panels.iter().zip(y_ticks).enumerate() {
        let frame = Frame {
            left,
            top: y + if panel.note.is_some() { 20.0 } else { 0.0 },
            width: WIDTH - left - MARGIN - 8.0,
            height,
            x: scales[i].0,
            y: scales[i].1,
        };
        let labels_x = chart
            .panels
            .get(i + 1)
            .is_none_or(|next| !shared(panel, next));
        let (one, end) = dress(panel, frame, vertical, labels_x);
        placed.push(one);
        y = end + if labels_x { 18.0 } else { 12.0 };
    }
    (placed, y)
}

/// Scales of x and y for each panel.
fn scales(panels: &[Panel], height: f64) -> Vec<(Scale, Scale)> {
    let of_group = |group: &[Panel]| {
        let x = scale::x_of(&group.iter().collect::<Vec<_>>());
        let both = group.iter().map(|panel| (x, scale::y_of(panel)));
        let mut both = both.collect::<Vec<_>>();
        if group.iter().any(|panel| panel.equal) {
            scale::equalise(&mut both, MAP_WIDTH / height);
        }
        both
    };
    panels.chunk_by(shared).flat_map(of_group).collect()
}

/// Left edge of all data areas: room for the widest label, and for turned names of categories.
fn left(ticks: &[Ticks], panels: &[Panel]) -> f64 {
    let labels = ticks.iter().flat_map(|ticks| &ticks.major);
    let widths = labels.map(|tick| width(&tick.label, SMALL));
    let labels = MARGIN + 1.5 * NORMAL + widths.fold(20.0, f64::max) + 10.0;
    let names = panels
        .iter()
        .map(|panel| MARGIN + overhang(&panel.categories, WIDTH - 2.0 * labels));
    names.fold(labels, f64::max)
}

/// How far turned names of categories reach beyond the left edge of a data area of this width.
fn overhang(names: &[String], area: f64) -> f64 {
    let room = area / names.len().max(1) as f64;
    if !broken(names, room - 6.0).1 {
        return 0.0;
    }
    let reach =
        |(i, name): (usize, &String)| COSLANT * width(name, SMALL) - (i as f64 + 0.5) * room;
    names.iter().enumerate().map(reach).fold(0.0, f64::max)
}

/// Neighbours that share an x axis.
fn shared(a: &Panel, b: &Panel) -> bool {
    a.x == b.x && a.categories == b.categories
}

fn dress(panel: &Panel, frame: Frame, y: Ticks, labels_x: bool) -> (Placed<'_>, f64) {
    let horizontal = match panel.categories.is_empty() {
        true => ticks(&frame.x, &panel.x.unit, frame.width, SMALL, true),
        false => Ticks::default(),
    };
    let room = frame.width / panel.categories.len().max(1) as f64 - 6.0;
    let (categories, turned) = broken(&panel.categories, room);
    let labels = match (labels_x, panel.categories.is_empty()) {
        (false, _) => 0.0,
        (_, true) => SMALL + 8.0,
        _ => 8.0 + depth(&categories, turned),
    };
    let named = labels_x && !scale::label(&panel.x, horizontal.exponent).is_empty();
    let label_y = frame.bottom() + labels + NORMAL + 3.0;
    let end = if named {
        label_y + 4.0
    } else {
        frame.bottom() + labels
    };
    let placed = Placed {
        panel,
        frame,
        x: horizontal,
        y,
        labels_x,
        categories,
        turned,
        label_y,
    };
    (placed, end)
}

fn broken(names: &[String], room: f64) -> (Vec<Vec<String>>, bool) {
    let measure = |text: &str| width(text, SMALL);
    let lines = |name: &String| wrap(name, room, measure);
    let broken: Vec<_> = names.iter().map(lines).collect();
    if broken.iter().flatten().all(|line| measure(line) <= room) {
        return (broken, false);
    }
    (names.iter().map(|name| vec![name.clone()]).collect(), true)
}

/// Sine of the angle of turned category names.
const SLANT: f64 = 0.574;
/// Its cosine.
const COSLANT: f64 = 0.819;
/// That angle in degrees.
pub(super) const SLANT_DEGREES: f64 = -35.0;

fn depth(categories: &[Vec<String>], turned: bool) -> f64 {
    if turned {
        let widths = categories.iter().flatten().map(|name| width(name, SMALL));
        return SMALL + SLANT * widths.fold(0.0, f64::max);
    }
    1.2 * SMALL * categories.iter().map(Vec::len).max().unwrap_or(0) as f64
}
