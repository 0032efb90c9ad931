//! One path from a programme: corners blended, orientations laid along it.

mod piece;
mod turning;

use super::corner::{Corner, Passage};
use super::curve::Curve;
use super::element::{Programme, SpotTurn};
use super::orientation::{Span, Turning};
use super::quaternion::Quaternion;
use crate::ground::vector::V3;
pub use piece::{Part, Piece};
use rayon::prelude::*;

/// How a path is drawn through its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawing {
    /// Distance from the corner at which a blend begins, m; 0: stops. `None`: the file's own, else 0.
    pub blend_radius: Option<f64>,
    /// Where the tool turns.
    pub turning: Turning,
}

/// A place where the tip stands still, with its turns.
#[derive(Debug, Clone)]
pub struct Halt {
    /// Arc length, m.
    pub at: f64,
    /// Turns on the spot.
    pub turns: Vec<SpotTurn>,
}

/// A drawn path over its true arc length.
#[derive(Debug, Clone)]
pub struct Path {
    /// What was programmed.
    pub programme: Programme,
    /// The blend distance that was asked for, m; `None`: the file's own.
    pub blend_radius: Option<f64>,
    /// The shapes in order; they join without gaps.
    pub pieces: Vec<Piece>,
    /// The corner after each element but the last.
    pub corners: Vec<Corner>,
    /// Orientations in order; they join without gaps.
    pub spans: Vec<Span>,
    /// Start, stops and end, in order.
    pub halts: Vec<Halt>,
    /// Length, m.
    pub length: f64,
}

/// On which side of a halt an orientation is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Before its turns.
    Before,
    /// After them.
    After,
}

impl Path {
    /// Draws the path.
    pub fn draw(programme: Programme, drawing: &Drawing) -> Self {
        let corners = corners(&programme, drawing.blend_radius);
        let mut path = Self {
            programme,
            blend_radius: drawing.blend_radius,
            pieces: Vec::new(),
            corners,
            spans: Vec::new(),
            halts: Vec::new(),
            length: 0.0,
        };
        path.lay_pieces();
        path.lay_turning(drawing.turning);
        path
    }

    fn lay_pieces(&mut self) {
        let elements = &self.programme.elements;
        let blends: Vec<Option<(Curve, f64)>> = self
            .corners
            .par_iter()
            .enumerate()
            .map(|(k, corner)| {
                let draw = || corner.blend(&elements[k].curve, &elements[k + 1].curve);
                (corner.passage == Passage::Blend).then(draw)
            })
            .collect();
        let (mut s, mut cut) = (0.0, 0.0);
        for (k, blend) in blends.into_iter().chain([None]).enumerate() {
            let rounded = blend.is_some();
            let corner = self.corners.get_mut(k);
            let gone = corner
                .as_ref()
                .filter(|_| rounded)
                .map_or(0.0, |c| c.radius);
            let length = elements[k].curve.length() - cut - gone;
            if length > 1e-12 {
                self.pieces.push(Piece {
                    begin: s,
                    length,
                    part: Part::Element(k, cut),
                });
                s += length;
            }
            let Some(corner) = corner else { break };
            corner.begin = s;
            if let Some((curve, deviation)) = blend {
                let length = curve.length();
                corner.deviation = deviation;
                self.pieces.push(Piece {
                    begin: s,
                    length,
                    part: Part::Blend(k, curve),
                });
                s += length;
            }
            corner.end = s;
            cut = gone;
        }
        self.length = s;
    }

    /// The piece at the arc length `s` (m).
    pub fn piece(&self, s: f64) -> &Piece {
        let after = self.pieces.partition_point(|piece| piece.begin <= s);
        &self.pieces[after.max(1) - 1]
    }

    /// Place at the arc length `s` (m), m.
    pub fn point(&self, s: f64) -> V3 {
        self.piece(s).point(s, &self.programme.elements)
    }

    /// Orientation at the arc length `s` (m); `side` decides where the tool turns on the spot.
    pub fn orientation(&self, s: f64, side: Side) -> Quaternion {
        let after = match side {
            Side::After => self.spans.partition_point(|span| span.begin <= s),
            Side::Before => self.spans.partition_point(|span| span.begin < s),
        };
        self.spans[after.max(1) - 1].at(s, &self.programme.elements)
    }

    /// Direction of the feed at the arc length `s` (m).
    pub fn direction(&self, s: f64) -> V3 {
        self.piece(s).direction(s, &self.programme.elements)
    }

    /// Whether a rapid motion runs at the arc length `s` (m).
    pub fn is_rapid(&self, s: f64) -> bool {
        let elements = &self.programme.elements;
        match self.piece(s).part {
            Part::Element(k, _) => elements[k].rapid,
            Part::Blend(k, _) => elements[k].rapid && elements[k + 1].rapid,
        }
    }

    /// The line of the file that asks for the place at the arc length `s` (m).
    pub fn line(&self, s: f64) -> usize {
        let (Part::Element(k, _) | Part::Blend(k, _)) = self.piece(s).part;
        self.programme.elements[k].line
    }

    /// Blends in the path.
    pub fn blends(&self) -> usize {
        let rounded = |c: &&Corner| c.passage == Passage::Blend;
        self.corners.iter().filter(rounded).count()
    }

    /// Straight elements.
    pub fn lines(&self) -> usize {
        let elements = self.programme.elements.iter();
        elements.filter(|element| element.curve.is_line()).count()
    }

    /// Largest distance from a corner to the path, m.
    pub fn max_deviation(&self) -> f64 {
        let deviations = self.corners.iter().map(|corner| corner.deviation);
        deviations.fold(0.0, f64::max)
    }
}

fn corners(programme: &Programme, asked: Option<f64>) -> Vec<Corner> {
    let elements = &programme.elements;
    let halted = |k: usize| {
        let turns = &programme.turns;
        turns.binary_search_by_key(&k, |turn| turn.before).is_ok()
    };
    let pairs = elements.windows(2).enumerate();
    pairs
        .map(|(k, pair)| Corner::between(&pair[0], &pair[1], asked, halted(k + 1)))
        .collect()
}
