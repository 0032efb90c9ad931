//! Charts as SVG: `plotters` draws the data, this adds what it lacks (dashes, clouds of points, ticks at
//! round numbers, a legend outside the data, text that stays text).
//!
//! ```
//! use ident::report::svg;
//! use ident::sheet::chart::{Axis, Chart, Panel, Series};
//!
//! let panel = Panel::new(Axis::new("Angle", "mrad"), Axis::new("Moment", "N·m"))
//!     .with(Series::points("measured", vec![[0.0, 0.0], [0.1, 310.0]]))
//!     .with(Series::line("model", vec![[0.0, 0.0], [0.1, 300.0]]));
//! let chart = Chart::new("a6-loop", "Drive of A6", "A made-up loop.").with(panel).synthetic(true);
//! let figure = svg::ink(&chart).unwrap();
//! assert!(figure.starts_with("<svg") && figure.contains("Moment in N·m"));
//! ```

mod axes;
mod canvas;
mod cells;
mod layout;
mod legend;
mod letters;
mod markers;
mod marks;
mod scale;
mod style;
mod thin;
mod ticks;

use super::escape::escape;
use super::wrap::wrap;
use crate::ground::problem::Outcome;
use crate::sheet::chart::{Chart, Mark, Panel, Series};
use crate::sheet::page::stem;
use layout::{LARGE, MARGIN, Placed, SMALL, WIDTH};
use letters::{Anchor, GREY, Letters, px, width};
use marks::{Pen, Slot};
use style::Looks;

/// Points in one figure at most, about: keeps a file below 400 kB.
const BUDGET: usize = 24_000;

/// A figure that stands alone: with title and caption.
pub fn ink(chart: &Chart) -> Outcome<String> {
    draw(chart, &stem(&chart.name), true)
}

/// A figure inside a page that shows title and caption itself; `id` is unique in that page.
pub fn inline(chart: &Chart, id: &str) -> Outcome<String> {
    draw(chart, &stem(id), false)
}

fn draw(chart: &Chart, id: &str, alone: bool) -> Outcome<String> {
    let looks = Looks::of(chart);
    let mut body = String::new();
    let top = header(chart, alone, &mut body);
    let (placed, end) = layout::place(chart, top);
    for panel in &placed {
        body += &ink_panel(panel, &looks, chart)?;
    }
    let left = placed.first().map_or(MARGIN, |panel| panel.frame.left);
    let (names, end) = legend::ink(&looks, left, end)?;
    body += &names;
    let bottom = if alone {
        caption(chart, end, &mut body)
    } else {
        end
    };
    Ok(document(chart, id, bottom + MARGIN - 6.0, &body))
}

fn document(chart: &Chart, id: &str, height: f64, body: &str) -> String {
    let size = (px(WIDTH), px(height.ceil()));
    let (w, h) = (&size.0, &size.1);
    let title = escape(&chart.title);
    let label = if chart.synthetic {
        "Synthetic data. "
    } else {
        ""
    };
    let text = escape(&chart.caption);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
         role=\"img\" aria-labelledby=\"{id}-title {id}-desc\" font-family=\"Helvetica, Arial, sans-serif\">\n\
         <title id=\"{id}-title\">{title}</title>\n<desc id=\"{id}-desc\">{label}{text}</desc>\n\
         <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n{body}</svg>\n"
    )
}

/// Title and label at the top; where the panels may begin.
fn header(chart: &Chart, alone: bool, out: &mut String) -> f64 {
    let mut y = MARGIN;
    let badge = "synthetic data";
    let room = WIDTH - 2.0 * MARGIN - if chart.synthetic { 130.0 } else { 0.0 };
    if alone {
        for line in wrap(&chart.title, room, |text| 1.06 * width(text, LARGE)) {
            y += 1.25 * LARGE;
            Letters::new(&line, MARGIN, y - 4.0, LARGE)
                .bold()
                .write(out);
        }
    }
    if chart.synthetic {
        let baseline = MARGIN + 1.25 * LARGE - 4.0;
        let letters = Letters::new(badge, WIDTH - MARGIN - 8.0, baseline, SMALL);
        letters.anchored(Anchor::End).bold().filled(GREY).write(out);
        y = y.max(MARGIN + 1.25 * LARGE);
    }
    y + 12.0
}

/// The caption below `top`; where it ends.
fn caption(chart: &Chart, top: f64, out: &mut String) -> f64 {
    let lines = wrap(&chart.caption, WIDTH - 2.0 * MARGIN, |text| {
        width(text, SMALL)
    });
    let mut y = top + if lines.is_empty() { 0.0 } else { 6.0 };
    for line in lines {
        y += 1.3 * SMALL;
        Letters::new(&line, MARGIN, y - 4.0, SMALL)
            .filled(GREY)
            .write(out);
    }
    y
}

fn ink_panel(placed: &Placed, looks: &Looks, chart: &Chart) -> Outcome<String> {
    let count: usize = chart.panels.iter().map(|panel| panel.series.len()).sum();
    let panel = placed.panel;
    let mut out = axes::below(placed)?;
    for i in order(panel) {
        let look = looks.get(&panel.series[i]);
        let pen = Pen {
            frame: &placed.frame,
            look,
            budget: BUDGET / count.max(1),
            slot: slot(panel, i),
        };
        out += &marks::ink(&panel.series[i], &pen)?;
    }
    Ok(out + &axes::above(placed)?)
}

/// Bands first, then bars, clouds, lines; emphasised markers on top; else as given.
fn order(panel: &Panel) -> Vec<usize> {
    let rank = |i: &usize| match (panel.series[*i].mark, panel.series[*i].emphasis) {
        (Mark::Band | Mark::Cells, _) => 0,
        (Mark::Bars, _) => 1,
        (Mark::Points, false) => 2,
        // A wide line shows on both sides of a thin one above it.
        (Mark::Line | Mark::Dashed | Mark::Dotted, true) => 3,
        (Mark::Line | Mark::Dashed | Mark::Dotted, false) => 4,
        (Mark::Points, true) => 5,
    };
    let mut order: Vec<usize> = (0..panel.series.len()).collect();
    order.sort_by_key(rank);
    order
}

fn slot(panel: &Panel, i: usize) -> Slot {
    let bars = |series: &[Series]| series.iter().filter(|s| s.mark == Mark::Bars).count();
    Slot {
        place: bars(&panel.series[..i]),
        of: bars(&panel.series).max(1),
    }
}
