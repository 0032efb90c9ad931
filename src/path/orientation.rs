//! Orientations along a path, over its arc length.

use super::curve::Curve;
use super::element::{Element, Programme, SAME_ORIENTATION, SpotTurn};
use super::quaternion::Quaternion;
use crate::ground::vector::{V3, norm, scale};

/// Where the tool turns (`orientation` of a job).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turning {
    /// Elements hold the orientation of their end and turn within the blends.
    Blend,
    /// They turn within this arc length on either side of the corner, m.
    Radius(f64),
    /// In proportion to the distance, over the whole element.
    Whole,
}

/// The orientation on one element, over its own arc length.
#[derive(Debug, Clone)]
pub enum Law {
    /// From an orientation by a rotation vector in its own axes (rad per m); it goes on beyond the ends.
    Steady {
        /// Orientation at the start.
        from: Quaternion,
        /// Rotation vector per length, rad/m.
        rate: V3,
    },
    /// As the spline of this element says.
    Spline(usize),
}

impl Law {
    /// The law of element `index`.
    pub fn of(index: usize, element: &Element, turning: Turning) -> Self {
        if let Curve::Nurbs(_) = element.curve {
            return Self::Spline(index);
        }
        let [from, to] = element.ends;
        match turning {
            Turning::Whole => Self::Steady {
                from,
                rate: scale(1.0 / element.curve.length(), from.way_to(to)),
            },
            _ => Self::hold(to),
        }
    }

    /// Always the same.
    pub fn hold(at: Quaternion) -> Self {
        Self::Steady {
            from: at,
            rate: [0.0; 3],
        }
    }

    /// Orientation at the length `s` (m) from the element's start.
    pub fn at(&self, s: f64, elements: &[Element]) -> Quaternion {
        match self {
            Self::Steady { from, rate } if *rate == [0.0; 3] => *from,
            Self::Steady { from, rate } => from.turned(scale(s, *rate)),
            Self::Spline(index) => match &elements[*index].curve {
                Curve::Nurbs(nurbs) => {
                    let u = nurbs.table.parameter(&nurbs.curve, s);
                    nurbs.curve.orientation(u)
                }
                _ => elements[*index].ends[1],
            },
        }
    }
}

/// A stretch of the path that turns in one way, over the arc length of the path.
#[derive(Debug, Clone)]
pub struct Span {
    /// Arc length where it begins, m.
    pub begin: f64,
    /// Arc length where it ends, m.
    pub end: f64,
    /// What it follows, with the arc length of the path at which the law has its zero, m.
    pub law: (Law, f64),
    /// What it changes over to: smoothly, up to the second derivative.
    pub next: Option<(Law, f64)>,
}

impl Span {
    /// Orientation at the arc length `s` (m).
    pub fn at(&self, s: f64, elements: &[Element]) -> Quaternion {
        let from = self.law.0.at(s - self.law.1, elements);
        let Some((next, zero)) = &self.next else {
            return from;
        };
        let to = next.at(s - zero, elements);
        let share = ((s - self.begin) / (self.end - self.begin)).clamp(0.0, 1.0);
        from.turned(scale(smooth(share), from.way_to(to)))
    }
}

/// From 0 to 1 with first and second derivative zero at both ends.
fn smooth(x: f64) -> f64 {
    x * x * x * (10.0 + x * (6.0 * x - 15.0))
}

/// The turns that a stop before element `index` needs: those the file asks for, and then the one to
/// the orientation with which the next element begins.
pub fn turns_at(
    programme: &Programme,
    index: usize,
    before: Option<Quaternion>,
    after: Option<Quaternion>,
) -> Vec<SpotTurn> {
    let first = programme.turns.partition_point(|turn| turn.before < index);
    let own = programme.turns[first..].iter();
    let mut turns: Vec<SpotTurn> = own
        .take_while(|turn| turn.before == index)
        .copied()
        .collect();
    let at = turns.last().map(|turn| turn.ends[1]).or(before);
    if let (Some(at), Some(after)) = (at, after)
        && norm(at.way_to(after)) > SAME_ORIENTATION
    {
        turns.push(SpotTurn {
            before: index,
            ends: [at, after],
            line: programme.elements[index.saturating_sub(1)].line,
        });
    }
    turns
}
