//! The look of each series: told apart by form and lightness first, by hue last.

use crate::sheet::chart::{Chart, Mark, Series};
use plotters::style::RGBColor;

/// How a series looks wherever it stands in a chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Look {
    pub color: RGBColor,
    /// Width of lines in px.
    pub width: f64,
    /// `stroke-dasharray` in px; empty: solid.
    pub dash: &'static [f64],
    pub shape: Shape,
    /// Half the size of a marker in px.
    pub radius: f64,
    /// Many points behind the line that explains them.
    pub cloud: bool,
}

/// Form of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Disc,
    Square,
    Triangle,
    Diamond,
    Cross,
}

impl Shape {
    /// Its corners in a box from -1 to 1, y upwards; none for a disc.
    pub fn corners(self) -> &'static [[f64; 2]] {
        match self {
            Shape::Disc => &[],
            Shape::Square => &[[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]],
            Shape::Triangle => &[[0.0, 1.1], [1.05, -0.8], [-1.05, -0.8]],
            Shape::Diamond => &[[0.0, 1.2], [1.2, 0.0], [0.0, -1.2], [-1.2, 0.0]],
            Shape::Cross => &[
                [-1.0, -1.0],
                [1.0, 1.0],
                [0.0, 0.0],
                [-1.0, 1.0],
                [1.0, -1.0],
                [0.0, 0.0],
            ],
        }
    }

    /// Drawn as an outline, white inside.
    pub fn hollow(self) -> bool {
        matches!(self, Shape::Square | Shape::Diamond)
    }
}

// Lightness 29, 60, 48, 6, 60, 62 of 100: neighbours in the list differ in grey.
const LINES: [RGBColor; 6] = [
    RGBColor(0x00, 0x44, 0x88),
    RGBColor(0xC7, 0x7C, 0x02),
    RGBColor(0xBB, 0x55, 0x66),
    RGBColor(0x11, 0x11, 0x11),
    RGBColor(0x5B, 0x97, 0xA8),
    RGBColor(0x99, 0x99, 0x33),
];
const BARS: [RGBColor; 5] = [
    RGBColor(0x00, 0x44, 0x88),
    RGBColor(0xE3, 0xBC, 0x5A),
    RGBColor(0xBB, 0x55, 0x66),
    RGBColor(0xC8, 0xC8, 0xC8),
    RGBColor(0x44, 0x44, 0x44),
];
const POINTS: [RGBColor; 4] = [
    RGBColor(0x11, 0x11, 0x11),
    RGBColor(0xC7, 0x7C, 0x02),
    RGBColor(0x00, 0x44, 0x88),
    RGBColor(0xBB, 0x55, 0x66),
];
/// A cloud of points stands behind the line that explains it.
const CLOUD: RGBColor = RGBColor(0x8A, 0x8A, 0x8A);
/// Classes of a map from little to much, light to dark.
const CELLS: [RGBColor; 6] = [
    RGBColor(0xF0, 0xEE, 0xB8),
    RGBColor(0xB4, 0xDC, 0xB2),
    RGBColor(0x69, 0xBF, 0xBB),
    RGBColor(0x2E, 0x93, 0xBC),
    RGBColor(0x22, 0x5D, 0xA3),
    RGBColor(0x14, 0x2C, 0x6A),
];
const BANDS: [RGBColor; 2] = [RGBColor(0x60, 0x60, 0x60), RGBColor(0xC7, 0x7C, 0x02)];

const SHAPES: [Shape; 5] = [
    Shape::Disc,
    Shape::Square,
    Shape::Triangle,
    Shape::Diamond,
    Shape::Cross,
];
const DASHES: [&[f64]; 3] = [&[7.0, 4.0], &[14.0, 4.0], &[12.0, 3.5, 2.0, 3.5]];
const DOTS: [&[f64]; 2] = [&[0.1, 4.0], &[0.1, 8.0]];

/// More points than this are a cloud.
const MANY: usize = 150;

/// The looks of a chart, one for each name and mark, in order of appearance.
#[derive(Debug, Clone)]
pub(super) struct Looks {
    entries: Vec<(Series, Look)>,
}

impl Looks {
    pub fn of(chart: &Chart) -> Self {
        let mut entries: Vec<(Series, Look)> = Vec::new();
        let all = || chart.panels.iter().flat_map(|panel| &panel.series);
        for series in all() {
            if entries.iter().any(|(known, _)| same(known, series)) {
                continue;
            }
            let alike = all().filter(|other| same(other, series));
            let count = alike.map(|other| other.points.len()).max().unwrap_or(0);
            let look = look(series, count, &entries);
            entries.push((head(series), look));
        }
        Self { entries }
    }

    pub fn get(&self, series: &Series) -> Look {
        let found = self.entries.iter().find(|(known, _)| same(known, series));
        found.expect("every series of the chart has a look").1
    }

    /// Series without points and their looks, in order of appearance.
    pub fn entries(&self) -> &[(Series, Look)] {
        &self.entries
    }
}

fn same(a: &Series, b: &Series) -> bool {
    a.name == b.name && a.mark == b.mark
}

/// What a legend needs of a series.
fn head(series: &Series) -> Series {
    Series {
        points: Vec::new(),
        lower_upper: series.lower_upper.as_ref().map(|_| Vec::new()),
        ..series.clone()
    }
}

/// Families share a palette, so that a family's first member always has the first colour.
fn family(mark: Mark) -> u8 {
    match mark {
        Mark::Points => 0,
        Mark::Line | Mark::Dashed | Mark::Dotted => 1,
        Mark::Band => 2,
        Mark::Bars => 3,
        Mark::Cells => 4,
    }
}

fn look(series: &Series, count: usize, before: &[(Series, Look)]) -> Look {
    let mark = series.mark;
    let kin = before
        .iter()
        .filter(|(s, _)| family(s.mark) == family(mark))
        .count();
    let twins = before.iter().filter(|(s, _)| s.mark == mark).count();
    let cloud = count > MANY;
    let color = match mark {
        Mark::Points if kin == 0 && cloud && !series.emphasis => CLOUD,
        Mark::Points => POINTS[kin % POINTS.len()],
        Mark::Band => BANDS[kin % BANDS.len()],
        Mark::Bars => BARS[kin % BARS.len()],
        Mark::Cells => CELLS[kin % CELLS.len()],
        _ => LINES[kin % LINES.len()],
    };
    let dash: &[f64] = match mark {
        Mark::Dashed => DASHES[twins % DASHES.len()],
        Mark::Dotted => DOTS[twins % DOTS.len()],
        _ => &[],
    };
    let dotted = if mark == Mark::Dotted { 0.8 } else { 0.0 };
    Look {
        color,
        width: if series.emphasis { 3.2 } else { 1.6 } + dotted,
        dash,
        shape: SHAPES[kin % SHAPES.len()],
        radius: if cloud { 1.6 } else { 3.4 } * if series.emphasis { 1.25 } else { 1.0 },
        cloud,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::chart::{Axis, Panel};

    #[test]
    fn a_name_keeps_its_look() {
        let panel = || Panel::new(Axis::default(), Axis::default());
        let first = panel()
            .with(Series::line("a", vec![]))
            .with(Series::dashed("b", vec![]));
        let second = panel().with(Series::dashed("b", vec![]));
        let chart = Chart::new("c", "", "").with(first).with(second);
        let looks = Looks::of(&chart);
        assert_eq!(looks.entries().len(), 2);
        assert_eq!(looks.get(&chart.panels[1].series[0]).color, LINES[1]);
    }
}
