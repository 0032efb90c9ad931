//! Grid, frame, ticks and labels of a panel.

use super::canvas::{Area, Fault, Frame, layer, tenths};
use super::layout::{MARGIN, NORMAL, Placed, SLANT_DEGREES, SMALL};
use super::letters::{Anchor, GREY, Letters};
use super::scale;
use crate::ground::problem::Outcome;
use plotters::element::{PathElement, Rectangle};
use plotters::style::{Color, RGBColor, ShapeStyle};

const GRID: RGBColor = RGBColor(0xE2, 0xE2, 0xE2);
const ZERO: RGBColor = RGBColor(0xA8, 0xA8, 0xA8);
const EDGE: RGBColor = RGBColor(0x4A, 0x4A, 0x4A);

/// What lies under the series: grid lines, and a stronger one at zero.
pub(super) fn below(placed: &Placed) -> Outcome<String> {
    let frame = &placed.frame;
    layer(frame, "", |area| {
        let level =
            |at: f64, color| rule(area, [(frame.x.low, at), (frame.x.high, at)], color, 0.8);
        let upright =
            |at: f64, color| rule(area, [(at, frame.y.low), (at, frame.y.high)], color, 0.8);
        for tick in &placed.x.major {
            upright(tick.at, GRID)?;
        }
        for tick in &placed.y.major {
            level(tick.at, GRID)?;
        }
        if frame.y.filled && !frame.y.log && frame.y.low < 0.0 && frame.y.high > 0.0 {
            level(0.0, ZERO)?;
        }
        Ok(())
    })
}

fn rule(area: &Area, ends: [(f64, f64); 2], color: RGBColor, width: f64) -> Result<(), Fault> {
    let style = ShapeStyle {
        color: color.to_rgba(),
        filled: false,
        stroke_width: tenths(width),
    };
    area.draw(&PathElement::new(ends.to_vec(), style))?;
    Ok(())
}

/// What lies over the series: frame, tick marks and all texts.
pub(super) fn above(placed: &Placed) -> Outcome<String> {
    let mut out = frame(placed)?;
    if placed.labels_x {
        horizontal(placed, &mut out);
    }
    vertical(placed, &mut out);
    remarks(placed, &mut out);
    names(placed, &mut out);
    Ok(out)
}

/// Names of places, to the upper right of each.
fn names(placed: &Placed, out: &mut String) {
    let frame = &placed.frame;
    if placed.panel.names.is_empty() {
        return;
    }
    // A white rim keeps a name readable on a line.
    out.push_str("<g paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"4\">\n");
    for ([x, y], name) in &placed.panel.names {
        let (x, y) = (frame.place_x(*x) + 8.0, frame.place_y(*y) - 6.0);
        Letters::new(name, x, y, NORMAL).bold().write(out);
    }
    out.push_str("</g>\n");
}

fn frame(placed: &Placed) -> Outcome<String> {
    let frame = &placed.frame;
    let width = format!(" stroke-width=\"{}\"", tenths(1.0));
    let per = frame.pixels().per_unit;
    layer(frame, &width, |area| {
        let low = (frame.x.low, frame.y.low);
        let corners = [low, (frame.x.high, frame.y.high)];
        area.draw(&Rectangle::new(corners, EDGE.to_rgba()))?;
        // Ticks point inwards; the grid does the rest.
        let x_tick =
            |at: f64, px: f64| rule(area, [(at, low.1), (at, low.1 + px / per[1])], EDGE, 1.0);
        let y_tick =
            |at: f64, px: f64| rule(area, [(low.0, at), (low.0 + px / per[0], at)], EDGE, 1.0);
        placed
            .x
            .major
            .iter()
            .try_for_each(|tick| x_tick(tick.at, 5.0))?;
        placed.x.minor.iter().try_for_each(|at| x_tick(*at, 3.0))?;
        placed
            .y
            .major
            .iter()
            .try_for_each(|tick| y_tick(tick.at, 5.0))?;
        placed.y.minor.iter().try_for_each(|at| y_tick(*at, 3.0))
    })
}

fn horizontal(placed: &Placed, out: &mut String) {
    let frame = &placed.frame;
    for tick in &placed.x.major {
        let (x, y) = (frame.place_x(tick.at), frame.bottom() + SMALL + 4.0);
        Letters::new(&tick.label, x, y, SMALL)
            .anchored(Anchor::Middle)
            .write(out);
    }
    for (i, lines) in placed.categories.iter().enumerate() {
        category(lines, frame.place_x(i as f64), placed, out);
    }
    let label = scale::label(&placed.panel.x, placed.x.exponent);
    if !label.is_empty() {
        let middle = frame.left + 0.5 * frame.width;
        let letters = Letters::new(&label, middle, placed.label_y, NORMAL);
        letters.anchored(Anchor::Middle).write(out);
    }
}

fn category(lines: &[String], x: f64, placed: &Placed, out: &mut String) {
    let top = placed.frame.bottom() + SMALL + 4.0;
    for (row, line) in lines.iter().enumerate() {
        let y = top + 1.2 * SMALL * row as f64;
        let letters = Letters::new(line, x, y, SMALL);
        match placed.turned {
            true => letters
                .anchored(Anchor::End)
                .turned(SLANT_DEGREES)
                .write(out),
            false => letters.anchored(Anchor::Middle).write(out),
        }
    }
}

fn vertical(placed: &Placed, out: &mut String) {
    let frame = &placed.frame;
    for tick in &placed.y.major {
        let (x, y) = (frame.left - 7.0, frame.place_y(tick.at) + 0.35 * SMALL);
        Letters::new(&tick.label, x, y, SMALL)
            .anchored(Anchor::End)
            .write(out);
    }
    let label = scale::label(&placed.panel.y, placed.y.exponent);
    if !label.is_empty() {
        let (x, y) = (MARGIN + 0.7 * NORMAL, frame.top + 0.5 * frame.height);
        let letters = Letters::new(&label, x, y, fitting(&label, frame));
        letters.anchored(Anchor::Middle).turned(-90.0).write(out);
    }
}

/// A long label beside a flat panel is set smaller rather than into its neighbour.
fn fitting(label: &str, frame: &Frame) -> f64 {
    let wide = super::letters::width(label, NORMAL);
    (NORMAL * (frame.height + 14.0) / wide.max(1.0)).clamp(9.0, NORMAL)
}

fn remarks(placed: &Placed, out: &mut String) {
    let frame = &placed.frame;
    if let Some(note) = &placed.panel.note {
        Letters::new(note, frame.left, frame.top - 7.0, SMALL)
            .filled(GREY)
            .write(out);
    }
    if !(frame.x.filled && frame.y.filled) {
        let (x, y) = (
            frame.left + 0.5 * frame.width,
            frame.top + 0.5 * frame.height,
        );
        let letters = Letters::new("no data", x, y, NORMAL).anchored(Anchor::Middle);
        letters.filled(GREY).write(out);
    }
}
