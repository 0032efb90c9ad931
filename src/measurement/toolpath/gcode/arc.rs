//! Arcs of G2 and G3: centre by I, J, K or radius by R, in one of three planes.

use super::super::shape::Arc;
use super::block::Block;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::{V3, add, cross, dot, norm, scale, sub};

/// Plane of an arc; its normal is the axis that is not in its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Plane {
    XY,
    ZX,
    YZ,
}

impl Plane {
    fn normal_axis(self) -> usize {
        match self {
            Self::XY => 2,
            Self::ZX => 1,
            Self::YZ => 0,
        }
    }

    fn normal(self) -> V3 {
        let mut normal = [0.0; 3];
        normal[self.normal_axis()] = 1.0;
        normal
    }
}

/// The words of an arc, m.
pub(super) struct Words {
    centre: [Option<f64>; 3],
    absolute: bool,
    radius: Option<f64>,
    /// Whole turns beyond the first.
    turns: usize,
}

/// Most turns of a helix in one block.
const MOST_TURNS: f64 = 1000.0;
/// Rounding of a radius, m and share.
const ROUNDING: (f64, f64) = (1e-5, 1e-4);

impl Words {
    pub(super) fn of(block: &Block, unit: f64, absolute: bool) -> Outcome<Self> {
        let scaled = |letter| block.value(letter).map(|value| value * unit);
        Ok(Self {
            centre: [scaled('I'), scaled('J'), scaled('K')],
            absolute,
            radius: scaled('R'),
            turns: turns(block.value('P'))?,
        })
    }

    /// The arc from one point to another.
    ///
    /// # Errors
    /// Neither centre nor radius, or both, or ones that do not fit the ends.
    pub(super) fn arc(&self, plane: Plane, clockwise: bool, from: V3, to: V3) -> Outcome<Arc> {
        let sense = if clockwise { -1.0 } else { 1.0 };
        let axis = scale(sense, plane.normal());
        let centre = match (self.radius, self.centre) {
            (Some(radius), [None, None, None]) => by_radius(radius, axis, from, to)?,
            (None, [None, None, None]) => return Err(without_centre()),
            (None, _) => self.stated(plane, from)?,
            (Some(_), _) => {
                let remedy = "write the centre (I, J, K) or the radius (R)";
                return Err(Problem::new("has both centre and radius", remedy));
            }
        };
        Arc::about(from, to, centre, axis, self.turns)
    }

    fn stated(&self, plane: Plane, from: V3) -> Outcome<V3> {
        let across = plane.normal_axis();
        if self.centre[across].is_some_and(|along| !self.absolute && along != 0.0) {
            let remedy = "select the plane of the arc with G17 (I J), G18 (I K) or G19 (J K)";
            return Err(Problem::new(
                "the centre lies outside the plane of the arc",
                remedy,
            ));
        }
        let mut centre = from;
        for axis in (0..3).filter(|axis| *axis != across) {
            centre[axis] = match (self.absolute, self.centre[axis]) {
                (false, offset) => from[axis] + offset.unwrap_or(0.0),
                (true, Some(place)) => place,
                (true, None) => return Err(without_centre()),
            };
        }
        Ok(centre)
    }
}

fn turns(p: Option<f64>) -> Outcome<usize> {
    match p {
        None => Ok(0),
        Some(p) if p.fract() == 0.0 && (1.0..=MOST_TURNS).contains(&p) => Ok(p as usize - 1),
        Some(p) => Err(Problem::new(
            format!("P{p} is no number of turns"),
            "write a whole number from 1, or leave P out",
        )),
    }
}

fn without_centre() -> Problem {
    Problem::new(
        "an arc without centre and radius",
        "add I, J, K of the plane, or R",
    )
}

/// The centre of the arc of that radius; a negative one makes the way round longer than half.
fn by_radius(radius: f64, axis: V3, from: V3, to: V3) -> Outcome<V3> {
    let way = sub(to, from);
    let chord = sub(way, scale(dot(way, axis), axis));
    let half = 0.5 * norm(chord);
    let short = half - radius.abs();
    if half < 1e-9 || short > ROUNDING.0 + ROUNDING.1 * half {
        let what = format!(
            "no arc of radius {:.4} mm joins points that are {:.4} mm apart",
            radius.abs() * 1e3,
            half * 2e3
        );
        return Err(Problem::new(
            what,
            "correct R, or write the centre with I, J, K",
        ));
    }
    let left = scale(0.5 / half, cross(axis, chord));
    let height = (radius * radius - half * half).max(0.0).sqrt();
    let side = if radius < 0.0 { -height } else { height };
    Ok(add(add(from, scale(0.5, chord)), scale(side, left)))
}
