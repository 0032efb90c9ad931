//! One marker for each point.

use super::canvas::{Area, Fault, Frame, group, layer, tenths};
use super::marks::{path, stroke};
use super::style::{Look, Shape};
use super::thin::Point;
use crate::ground::problem::Outcome;
use plotters::element::{Circle, Polygon};
use plotters::style::{Color, WHITE};
use std::fmt::Write as _;

/// Inks points in axis coordinates.
pub(super) fn ink(points: &[Point], frame: &Frame, look: &Look) -> Outcome<String> {
    if look.cloud {
        return Ok(cloud(points, frame, look));
    }
    layer(frame, "", |area| {
        points
            .iter()
            .try_for_each(|point| marker(area, *point, frame, look))
    })
}

/// Thousands of points as one path of dots: an element for each would make a file of megabytes.
fn cloud(points: &[Point], frame: &Frame, look: &Look) -> String {
    let mut dots = String::new();
    // Steps from dot to dot are shorter to write than places.
    let mut pen = [0, 0];
    for [x, y] in points {
        let place = [frame.place_x(*x), frame.place_y(*y)].map(|px| i64::from(tenths(px)));
        let _ = write!(dots, "m{},{}h1", place[0] - pen[0], place[1] - pen[1]);
        pen = [place[0] + 1, place[1]];
    }
    if dots.is_empty() {
        return dots;
    }
    let (r, g, b) = (look.color.0, look.color.1, look.color.2);
    let size = tenths(2.0 * look.radius);
    let end = if look.shape == Shape::Disc {
        "round"
    } else {
        "square"
    };
    let ink = format!("fill=\"none\" stroke=\"#{r:02X}{g:02X}{b:02X}\" stroke-width=\"{size}\"");
    group(
        "",
        &format!("<path {ink} stroke-linecap=\"{end}\" d=\"{dots}\"/>\n"),
    )
}

fn marker(area: &Area, [x, y]: Point, frame: &Frame, look: &Look) -> Result<(), Fault> {
    let per_unit = frame.pixels().per_unit;
    let (right, up) = (look.radius / per_unit[0], look.radius / per_unit[1]);
    let place = |corner: &Point| [x + corner[0] * right, y + corner[1] * up];
    let mut outline: Vec<Point> = look.shape.corners().iter().map(place).collect();
    let Some(first) = outline.first().copied() else {
        let radius = tenths(look.radius);
        return Ok(area.draw(&Circle::new((x, y), radius, look.color.filled()))?);
    };
    if look.shape != Shape::Cross {
        let inside = if look.shape.hollow() {
            WHITE
        } else {
            look.color
        };
        let corners: Vec<(f64, f64)> = outline.iter().map(|p| (p[0], p[1])).collect();
        area.draw(&Polygon::new(corners, inside.filled()))?;
        // Closed beyond the first corner, so that the joint there is like the others.
        let second = outline[1];
        outline.extend([first, second]);
    }
    Ok(area.draw(&path(&outline, stroke(look.color, 1.4)))?)
}

#[cfg(test)]
mod tests {
    use super::super::scale::Scale;
    use super::*;
    use plotters::style::BLACK;

    #[test]
    fn a_cloud_is_one_element() {
        let unit = Scale::of(false, [0.0, 1.0].into_iter(), 0.0);
        let frame = Frame {
            left: 10.0,
            top: 0.0,
            width: 100.0,
            height: 50.0,
            x: unit,
            y: unit,
        };
        let look = Look {
            color: BLACK,
            width: 1.0,
            dash: &[],
            shape: Shape::Disc,
            radius: 1.5,
            cloud: true,
        };
        let made = ink(&[[0.0, 0.0], [1.0, 1.0]], &frame, &look).unwrap();
        assert!(made.contains("d=\"m100,500h1m999,-500h1\""), "{made}");
    }
}
