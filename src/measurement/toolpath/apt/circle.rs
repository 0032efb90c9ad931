//! Circles: CIRCLE before one or several GOTO, and TLON between INDIRV and a line (CATIA).

use super::super::points::axis;
use super::super::shape::Arc;
use super::statement::{Statement, numbers};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::{V3, cross, dot, norm, scale, sub};
use std::f64::consts::TAU;

/// A circle that holds for the next GOTO, and for those after it that lie on it too.
#[derive(Debug, Clone, Copy)]
pub(super) struct Circle {
    centre: V3,
    axis: V3,
    radius: Option<f64>,
    /// Angle left until the circle is full, rad; `None` before its first GOTO.
    left: Option<f64>,
    ends: bool,
}

/// How far from the circle a point may lie, m, to lie on it.
const ON_CIRCLE: f64 = 1e-5;

impl Circle {
    /// Of `x,y,z,i,j,k[,r[,...]]`.
    pub(super) fn of(numbers: &[f64], unit: f64) -> Outcome<Self> {
        let [x, y, z, i, j, k, rest @ ..] = numbers else {
            let remedy = "write CIRCLE/x,y,z,i,j,k,radius: centre, axis (right-handed), radius";
            return Err(Problem::new(
                format!("has {} numbers", numbers.len()),
                remedy,
            ));
        };
        Ok(Self {
            centre: [x * unit, y * unit, z * unit],
            axis: axis([*i, *j, *k])?,
            radius: rest.first().map(|r| r.abs() * unit),
            left: None,
            ends: false,
        })
    }

    /// A new feed ends the circle, once it has been used.
    pub(super) fn feed_changes(&mut self) {
        self.ends = self.left.is_some();
    }

    /// The arc to a point; `None` if the circle was used and does not hold any more.
    pub(super) fn arc(&mut self, from: V3, to: V3) -> Outcome<Option<Arc>> {
        let Some(left) = self.left else {
            self.is_on(from)?;
            return Arc::about(from, to, self.centre, self.axis, 0).map(Some);
        };
        let still = norm(sub(to, from)) < ON_CIRCLE;
        let height = dot(sub(to, from), self.axis).abs();
        let apart = (self.radial(to) - self.radial(from)).abs();
        if self.ends || still || height > ON_CIRCLE || apart > ON_CIRCLE {
            return Ok(None);
        }
        let arc = Arc::about(from, to, self.centre, self.axis, 0)?;
        Ok((arc.angle <= left + 1e-6).then_some(arc))
    }

    /// The circle after an arc on it; `None` if it is full.
    pub(super) fn after(mut self, arc: &Arc) -> Option<Self> {
        let left = self.left.unwrap_or(TAU) - arc.angle;
        self.left = Some(left);
        (left > 1e-6).then_some(self)
    }

    fn radial(&self, point: V3) -> f64 {
        let out = sub(point, self.centre);
        norm(sub(out, scale(dot(out, self.axis), self.axis)))
    }

    fn is_on(&self, from: V3) -> Outcome<()> {
        let (found, stated) = (self.radial(from), self.radius.unwrap_or(f64::NAN));
        if (found - stated).abs() > 2.0 * ON_CIRCLE + 1e-4 * found {
            let what = format!(
                "the arc begins {:.4} mm from its centre, its radius is {:.4} mm",
                found * 1e3,
                stated * 1e3
            );
            return Err(Problem::new(
                what,
                "correct the centre or the radius of CIRCLE",
            ));
        }
        Ok(())
    }
}

/// End point and arc of `TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z)`: along the circle in the
/// direction of INDIRV, to the end of the line; the axis of the circle is that of the tool.
pub(super) fn tangent_circle(
    statement: &Statement,
    from: V3,
    direction: V3,
    tool: V3,
    unit: f64,
) -> Outcome<(V3, Arc)> {
    let (centre, radius, stated) = match group(statement, "CIRCLE")?.as_slice() {
        [x, y, z, r] => ([*x, *y, *z], *r, tool),
        [x, y, z, i, j, k, r] => ([*x, *y, *z], *r, axis([*i, *j, *k])?),
        other => return Err(strange("CIRCLE", other.len())),
    };
    let line = group(statement, "LINE")?;
    let [_, _, _, x, y, z] = line.as_slice() else {
        return Err(strange("LINE", line.len()));
    };
    let (centre, to) = (scale(unit, centre), [x * unit, y * unit, z * unit]);
    let sense = dot(cross(sub(from, centre), direction), stated);
    let across = 1e-6 * norm(sub(from, centre)) * norm(direction);
    if sense.abs() <= across {
        let remedy = "INDIRV states the direction in which the circle begins";
        return Err(Problem::new("INDIRV does not say which way round", remedy));
    }
    let arc = Arc::about(from, to, centre, scale(sense.signum(), stated), 0)?;
    let circle = Circle {
        centre,
        axis: arc.axis,
        radius: Some(radius.abs() * unit),
        left: None,
        ends: false,
    };
    circle.is_on(from)?;
    Ok((to, arc))
}

/// The numbers of `(WORD/ ...)`.
fn group(statement: &Statement, word: &str) -> Outcome<Vec<f64>> {
    let text: String = statement.arguments.split_whitespace().collect();
    let start = text.find(&format!("({word}/"));
    let inner = start.and_then(|at| text[at + word.len() + 2..].split(')').next());
    let inner = inner.ok_or_else(|| strange(word, 0))?;
    numbers(inner.trim_start_matches("CANON,"))
}

fn strange(word: &str, found: usize) -> Problem {
    Problem::new(
        format!("TLON with {found} numbers of {word} is not understood"),
        "write TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z), or CIRCLE and GOTO",
    )
}
