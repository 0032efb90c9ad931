//! The series of a panel, drawn by `plotters`.

use super::canvas::{Area, Fault, Frame, layer, tenths};
use super::cells;
use super::letters::px;
use super::markers;
use super::scale::{Scale, spacing};
use super::style::Look;
use super::thin::{self, Point};
use crate::ground::problem::Outcome;
use crate::sheet::chart::{Mark, Series};
use plotters::element::{PathElement, Polygon, Rectangle};
use plotters::style::{Color, RGBColor, ShapeStyle};

/// More whiskers than this are drawn as a band.
const WHISKERS: usize = 80;

/// More bars than this are drawn as their outline.
const BARS: usize = 300;

/// Where a bar stands among its neighbours.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slot {
    /// Number of series with bars before this one.
    pub place: usize,
    /// Number of series with bars.
    pub of: usize,
}

/// What a series is drawn with.
pub(super) struct Pen<'a> {
    pub frame: &'a Frame,
    pub look: Look,
    /// Points that may be drawn at most, about.
    pub budget: usize,
    pub slot: Slot,
}

/// Inks one series.
pub(super) fn ink(series: &Series, pen: &Pen) -> Outcome<String> {
    match series.mark {
        Mark::Points => points(series, pen),
        Mark::Bars => bars(series, pen),
        Mark::Cells => cells::ink(series, pen.frame, &pen.look),
        Mark::Band => band(series, pen),
        Mark::Line | Mark::Dashed | Mark::Dotted => {
            Ok(band(series, pen)? + &line(&series.points, pen)?)
        }
    }
}

pub(super) fn stroke(color: RGBColor, width: f64) -> ShapeStyle {
    ShapeStyle {
        color: color.to_rgba(),
        filled: false,
        stroke_width: tenths(width),
    }
}

pub(super) fn path(points: &[Point], style: ShapeStyle) -> PathElement<(f64, f64)> {
    PathElement::new(
        points.iter().map(|p| (p[0], p[1])).collect::<Vec<_>>(),
        style,
    )
}

/// Runs of points that can be drawn, in axis coordinates.
fn runs(points: &[Point], x: &Scale, y: &Scale) -> Vec<Vec<Point>> {
    let place = |p: &Point| Some([x.coordinate(p[0])?, y.coordinate(p[1])?]);
    let places: Vec<Option<Point>> = points.iter().map(place).collect();
    let runs = places.split(Option::is_none).filter(|run| !run.is_empty());
    runs.map(|run| run.iter().flatten().copied().collect())
        .collect()
}

fn line(points: &[Point], pen: &Pen) -> Outcome<String> {
    let (frame, look) = (pen.frame, pen.look);
    let mut runs = runs(points, &frame.x, &frame.y);
    // A lone point between gaps would be invisible: give it a round dot.
    runs.iter_mut()
        .filter(|run| run.len() == 1)
        .for_each(|run| run.push(run[0]));
    let pixels = frame.pixels();
    let runs = thin::apart(runs, &pixels, pen.budget / 4, |point| *point);
    let share = pen.budget / runs.len().max(1);
    let pieces = runs
        .iter()
        .flat_map(|run| thin::line(run, &pixels, share.max(4)));
    let pieces: Vec<_> = pieces.collect();
    let travel: f64 = pieces.iter().map(|piece| pixels.rise(piece)).sum();
    let dense = look.dash.is_empty() && travel > DENSE * frame.height;
    let width = if dense { 0.5 * look.width } else { look.width };
    layer(frame, &ends_and_dashes(look.dash), |area| {
        for piece in pieces {
            area.draw(&path(&piece, stroke(look.color, width)))?;
        }
        Ok(())
    })
}

/// A line that goes up and down this often is drawn thinner: its strokes would run together.
const DENSE: f64 = 60.0;

fn ends_and_dashes(dash: &[f64]) -> String {
    let lengths: Vec<String> = dash.iter().map(|d| px(f64::from(tenths(*d)))).collect();
    let dashes = match lengths.is_empty() {
        true => String::new(),
        false => format!(" stroke-dasharray=\"{}\"", lengths.join(" ")),
    };
    // Butt ends keep the gaps of dashes open; dots are round ends of very short dashes.
    let round = dash.first().is_none_or(|d| *d < 1.0);
    let cap = if round { "round" } else { "butt" };
    format!(" stroke-linejoin=\"round\" stroke-linecap=\"{cap}\"{dashes}")
}

/// Each value holds until the next point.
fn stairs(points: &[Point]) -> Vec<Point> {
    let mut stairs = Vec::with_capacity(2 * points.len());
    for pair in points.windows(2) {
        stairs.extend([pair[0], [pair[1][0], pair[0][1]]]);
    }
    stairs.extend(points.last());
    stairs
}

fn points(series: &Series, pen: &Pen) -> Outcome<String> {
    let frame = pen.frame;
    let whiskers = match series.points.len() {
        count if count > WHISKERS => band(series, pen)?,
        _ => layer(frame, "", |area| whiskers(area, series, pen, &|x| x))?,
    };
    let all = runs(&series.points, &frame.x, &frame.y).concat();
    let kept = thin::markers(&all, &frame.pixels(), pen.budget);
    Ok(whiskers + &markers::ink(&kept, frame, &pen.look)?)
}

/// Edges of a band in axis coordinates, in runs.
fn edges(series: &Series, frame: &Frame) -> Vec<Vec<[f64; 3]>> {
    let ends = series.lower_upper.iter().flatten();
    let place = |(p, ends): (&Point, &[f64; 2])| {
        let (low, high) = (frame.y.coordinate(ends[0])?, frame.y.coordinate(ends[1])?);
        Some([frame.x.coordinate(p[0])?, low, high])
    };
    let places: Vec<_> = series.points.iter().zip(ends).map(place).collect();
    let runs = places.split(Option::is_none).filter(|run| !run.is_empty());
    runs.map(|run| run.iter().flatten().copied().collect())
        .collect()
}

fn band(series: &Series, pen: &Pen) -> Outcome<String> {
    let frame = pen.frame;
    let runs = edges(series, frame);
    if runs.is_empty() {
        return Ok(String::new());
    }
    let pixels = frame.pixels();
    let runs = thin::apart(runs, &pixels, pen.budget / 4, |edge| [edge[0], edge[1]]);
    layer(frame, "", |area| {
        for run in runs {
            let run = thin::band(&run, &pixels);
            let above = run.iter().map(|e| (e[0], e[2]));
            let below = run.iter().rev().map(|e| (e[0], e[1]));
            let outline: Vec<(f64, f64)> = above.chain(below).collect();
            area.draw(&Polygon::new(outline, pen.look.color.mix(0.22).filled()))?;
        }
        Ok(())
    })
}

fn bars(series: &Series, pen: &Pen) -> Outcome<String> {
    if series.points.len() > BARS {
        return line(&stairs(&series.points), pen);
    }
    let (frame, look, slot) = (pen.frame, pen.look, pen.slot);
    let room = 0.8 * spacing(&series.points) / slot.of as f64;
    let shift = (slot.place as f64 + 0.5 - 0.5 * slot.of as f64) * room;
    let foot = if frame.y.log { frame.y.low } else { 0.0 };
    let half = 0.46 * room;
    let bars = runs(&series.points, &frame.x, &frame.y).concat();
    let thin_line = format!(" stroke-width=\"{}\"", tenths(0.8));
    let whisker = |area: &Area| whiskers(area, series, pen, &|x| x + shift);
    let boxes = layer(frame, &thin_line, |area| {
        for [x, y] in bars.into_iter().map(|[x, y]| [x + shift, y]) {
            let corners = [(x - half, y.max(foot)), (x + half, y.min(foot))];
            area.draw(&Rectangle::new(corners, look.color.filled()))?;
            area.draw(&Rectangle::new(corners, stroke(EDGE, 0.8)))?;
        }
        Ok(())
    })?;
    Ok(boxes + &layer(frame, "", whisker)?)
}

const EDGE: RGBColor = RGBColor(0x1A, 0x1A, 0x1A);

fn whiskers(
    area: &Area,
    series: &Series,
    pen: &Pen,
    shift: &dyn Fn(f64) -> f64,
) -> Result<(), Fault> {
    let cap = 3.0 / pen.frame.pixels().per_unit[0];
    let color = if series.mark == Mark::Bars {
        EDGE
    } else {
        pen.look.color
    };
    for [x, low, high] in edges(series, pen.frame).concat() {
        let x = shift(x);
        let (left, right) = (x - cap, x + cap);
        for ends in [
            [(x, low), (x, high)],
            [(left, low), (right, low)],
            [(left, high), (right, high)],
        ] {
            area.draw(&PathElement::new(ends.to_vec(), stroke(color, 1.2)))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_split_lines() {
        let scale = Scale::of(false, [0.0, 3.0].into_iter(), 0.0);
        let points = [[0.0, 1.0], [1.0, f64::NAN], [2.0, 1.0], [3.0, 2.0]];
        let lengths: Vec<_> = runs(&points, &scale, &scale).iter().map(Vec::len).collect();
        assert_eq!(lengths, [1, 2]);
    }

    #[test]
    fn stairs_hold_until_the_next() {
        assert_eq!(
            stairs(&[[0.0, 1.0], [1.0, 2.0]]),
            [[0.0, 1.0], [1.0, 1.0], [1.0, 2.0]]
        );
    }
}
