//! What happens between two elements: a stop, a blend, or nothing.

use super::curve::Curve;
use super::element::{Element, SAME_PLACE};
use super::nearest::sought;
use crate::ground::vector::{V3, angle, norm, sub};

/// A corner sharper than this is a reversal: a stop (179.9 degrees), rad.
const REVERSAL: f64 = 179.9 / 180.0 * std::f64::consts::PI;
/// Lines that turn by less go on as one, rad.
const COLLINEAR: f64 = 1e-6;
/// An arc or a spline that a neighbour meets at less than this is tangential, rad: nothing is
/// blended there, the curvature jumps, as on the controller.
const TANGENTIAL: f64 = 1e-3;

/// How the path goes through a corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Passage {
    /// It stands still there.
    Stop,
    /// It is rounded.
    Blend,
    /// It runs through: no corner to see.
    Through,
}

/// A corner between an element and the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// The point, m.
    pub point: V3,
    /// How the path goes through it.
    pub passage: Passage,
    /// Change of direction, rad.
    pub angle: f64,
    /// Where the blend begins and ends, m along the elements from the corner.
    pub radius: f64,
    /// The radius asked for, m.
    pub asked: f64,
    /// From the corner to the nearest point of the path, m.
    pub deviation: f64,
    /// Arc length of the path where the corner begins, m.
    pub begin: f64,
    /// Arc length of the path where it ends, m.
    pub end: f64,
    /// Line of the file that gave the point.
    pub line: usize,
}

impl Corner {
    /// Judges the corner between two elements. `asked`: the blend radius of the job, m, see [`Element::asked_blend`]; `halted`: the tool turns on the spot there.
    pub fn between(before: &Element, after: &Element, asked: Option<f64>, halted: bool) -> Self {
        let length = before.curve.length();
        let (end, start) = (before.curve.end(length), after.curve.end(0.0));
        let angle = angle(end.tangent, start.tangent);
        let asked = match before.rapid && !after.rapid {
            true => 0.0,
            false => before.asked_blend(asked),
        };
        let room = 0.5 * length.min(after.curve.length());
        let straight = before.curve.is_line() && after.curve.is_line();
        let through = angle < if straight { COLLINEAR } else { TANGENTIAL };
        let radius = asked.min(room);
        let passage = match (halted || angle > REVERSAL, through, radius > SAME_PLACE) {
            (true, ..) => Passage::Stop,
            (_, true, _) => Passage::Through,
            (.., true) => Passage::Blend,
            (.., false) => Passage::Stop,
        };
        let radius = match passage {
            Passage::Stop => 0.0,
            _ => radius,
        };
        Self {
            point: end.point,
            passage,
            angle,
            radius,
            asked,
            deviation: 0.0,
            begin: 0.0,
            end: 0.0,
            line: before.line,
        }
    }

    /// The curve that rounds it, and how far it passes from the point.
    pub fn blend(&self, before: &Curve, after: &Curve) -> (Curve, f64) {
        let from = before.end(before.length() - self.radius);
        let blend = Curve::blend(&from, &after.end(self.radius));
        let symmetric = before.is_line() && after.is_line();
        let deviation = match symmetric {
            true => norm(sub(blend.point(0.5 * blend.length()), self.point)),
            false => distance(&blend, self.point),
        };
        (blend, deviation)
    }

    /// Whether a short element made the blend smaller than asked for.
    pub fn is_shrunk(&self) -> bool {
        self.passage == Passage::Blend && self.radius < self.asked - SAME_PLACE
    }
}

/// Distance from a point to the nearest one of a curve, m.
fn distance(curve: &Curve, to: V3) -> f64 {
    let (point, feed) = (|s| curve.point(s), |s| curve.end(s).tangent);
    let place = sought(point, feed, to, 0.0..=curve.length());
    norm(sub(curve.point(place), to))
}
