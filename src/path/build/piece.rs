//! Stretches of a path of one shape.

use crate::ground::vector::V3;
use crate::path::curve::Curve;
use crate::path::element::Element;

/// A stretch of the path of one shape.
#[derive(Debug, Clone)]
pub struct Piece {
    /// Arc length of the path where it begins, m.
    pub begin: f64,
    /// Its length, m.
    pub length: f64,
    /// What it is.
    pub part: Part,
}

/// What a piece is.
#[derive(Debug, Clone)]
pub enum Part {
    /// Of the element of this index, from this length (m) of it on.
    Element(usize, f64),
    /// The blend after the element of this index.
    Blend(usize, Curve),
}

impl Piece {
    /// Arc length where it ends, m.
    pub fn end(&self) -> f64 {
        self.begin + self.length
    }

    /// Place at the arc length `s` (m) of the path, m.
    pub fn point(&self, s: f64, elements: &[Element]) -> V3 {
        let along = (s - self.begin).clamp(0.0, self.length);
        match &self.part {
            Part::Element(k, from) => elements[*k].curve.point(from + along),
            Part::Blend(_, curve) => curve.point(along),
        }
    }

    /// Direction of travel at the arc length `s` (m) of the path.
    pub fn direction(&self, s: f64, elements: &[Element]) -> V3 {
        let along = (s - self.begin).clamp(0.0, self.length);
        match &self.part {
            Part::Element(k, from) => elements[*k].curve.end(from + along).tangent,
            Part::Blend(_, curve) => curve.end(along).tangent,
        }
    }
}
