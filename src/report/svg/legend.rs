//! The legend, below the data: a sample of each look, and its name.

use super::canvas::Frame;
use super::layout::{MARGIN, SMALL, WIDTH};
use super::letters::{Letters, width};
use super::marks::{self, Pen, Slot};
use super::scale::Scale;
use super::style::{Look, Looks};
use crate::ground::problem::Outcome;
use crate::sheet::chart::{Mark, Series};

/// px of a sample.
const SAMPLE: f64 = 34.0;
const GAP: f64 = 22.0;
const ROW: f64 = 22.0;

/// The legend below `top`, and where it ends.
pub(super) fn ink(looks: &Looks, left: f64, top: f64) -> Outcome<(String, f64)> {
    let named = looks
        .entries()
        .iter()
        .filter(|(series, _)| !series.name.is_empty());
    let mut out = String::new();
    let (mut x, mut y) = (left, top);
    let mut any = false;
    for (series, look) in named {
        let wide = SAMPLE + 8.0 + width(&series.name, SMALL);
        if x > left && x + wide > WIDTH - MARGIN {
            (x, y) = (left, y + ROW);
        }
        out += &sample(series, *look, x, y)?;
        Letters::new(&series.name, x + SAMPLE + 8.0, y + 0.8 * SMALL, SMALL).write(&mut out);
        x += wide + GAP;
        any = true;
    }
    Ok((out, if any { y + ROW } else { top }))
}

/// The series itself in small, drawn by the same pen.
fn sample(series: &Series, look: Look, x: f64, y: f64) -> Outcome<String> {
    let unit = Scale {
        log: false,
        low: 0.0,
        high: 1.0,
        filled: true,
    };
    let frame = Frame {
        left: x,
        top: y,
        width: SAMPLE,
        height: 13.0,
        x: unit,
        y: unit,
    };
    let pen = Pen {
        frame: &frame,
        look,
        budget: 16,
        slot: Slot { place: 0, of: 1 },
    };
    marks::ink(&small(series, look.cloud), &pen)
}

fn small(series: &Series, cloud: bool) -> Series {
    let ends = [0.1, 0.9];
    let (points, between) = match series.mark {
        Mark::Points if cloud => (vec![[0.25, 0.3], [0.5, 0.7], [0.75, 0.4]], None),
        Mark::Points => (vec![[0.5, 0.5]], Some(vec![ends])),
        Mark::Bars => (vec![[0.5, 0.95]], None),
        Mark::Cells => (vec![[0.5, 0.5]], None),
        _ => (vec![[0.0, 0.5], [1.0, 0.5]], Some(vec![ends, ends])),
    };
    let has_band = series.lower_upper.is_some() || series.mark == Mark::Band;
    Series {
        points,
        cell: [0.9, 1.0],
        lower_upper: between.filter(|_| has_band),
        ..series.clone()
    }
}
