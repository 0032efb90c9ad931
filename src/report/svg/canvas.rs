//! Where `plotters` draws: its SVG back end, on a grid of tenths of a pixel.

use super::letters::px;
use super::scale::Scale;
use super::thin::Pixels;
use crate::ground::problem::{Outcome, Problem};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::{Cartesian2d, DrawingArea, IntoDrawingArea, SVGBackend};

/// The data area of a panel in px, and what it shows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    pub x: Scale,
    pub y: Scale,
}

/// A `plotters` drawing area over axis coordinates.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
/// What `plotters` may fail with.
pub(super) type Fault = Box<dyn std::error::Error>;

/// `plotters` knows whole pixels only: it gets ten for one.
const TENTHS: f64 = 10.0;

/// A length for `plotters`.
pub(super) fn tenths(px: f64) -> u32 {
    (px * TENTHS).round() as u32
}

impl Frame {
    /// px of an x coordinate.
    pub fn place_x(&self, at: f64) -> f64 {
        self.left + (at - self.x.low) / (self.x.high - self.x.low) * self.width
    }

    /// px of a y coordinate.
    pub fn place_y(&self, at: f64) -> f64 {
        self.bottom() - (at - self.y.low) / (self.y.high - self.y.low) * self.height
    }

    /// px of the lower edge.
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// px of the right edge.
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Its pixels, for thinning.
    pub fn pixels(&self) -> Pixels {
        Pixels {
            origin: [self.x.low, self.y.low],
            per_unit: [
                self.width / (self.x.high - self.x.low),
                self.height / (self.y.high - self.y.low),
            ],
        }
    }

    fn coordinates(&self) -> Cartesian2d<RangedCoordf64, RangedCoordf64> {
        let place = |px: f64| tenths(px) as i32;
        // Pixels count downwards, values upwards.
        Cartesian2d::new(
            self.x.low..self.x.high,
            self.y.low..self.y.high,
            (
                place(self.left)..place(self.right()),
                place(self.bottom())..place(self.top),
            ),
        )
    }
}

/// One layer of ink: a group with what `plotters` cannot say (dashes, markers, line ends) as attributes.
pub(super) fn layer(
    frame: &Frame,
    attributes: &str,
    draw: impl FnOnce(&Area) -> Result<(), Fault>,
) -> Outcome<String> {
    let mut ink = String::new();
    draw_on(&mut ink, frame, draw).map_err(|fault| {
        Problem::new(
            format!("the figure cannot be drawn ({fault})"),
            "report this with the data that were drawn",
        )
    })?;
    Ok(group(attributes, &content(&ink)))
}

/// Elements on the grid of tenths.
pub(super) fn group(attributes: &str, elements: &str) -> String {
    let scale = px(1.0 / TENTHS);
    format!("<g transform=\"scale({scale})\"{attributes}>\n{elements}</g>\n")
}

fn draw_on(
    ink: &mut String,
    frame: &Frame,
    draw: impl FnOnce(&Area) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let size = (tenths(frame.right()), tenths(frame.bottom()));
    let root: DrawingArea<SVGBackend, Shift> =
        SVGBackend::with_string(ink, size).into_drawing_area();
    let area = root.apply_coord_spec(frame.coordinates());
    draw(&area)?;
    area.present()?;
    Ok(())
}

/// The elements that `plotters` drew, without its `svg` element and without what says nothing.
fn content(ink: &str) -> String {
    let elements = ink
        .lines()
        .filter(|line| !line.starts_with("<svg") && *line != "</svg>");
    let tidy = |line: &str| line.replace(" opacity=\"1\"", "").replace(" \"", "\"") + "\n";
    elements.map(tidy).collect()
}
