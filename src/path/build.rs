//! One path from a programme: corners blended, orientations laid along it.

use super::corner::{Corner, Passage};
use super::curve::Curve;
use super::element::{Element, Programme, SpotTurn};
use super::orientation::{Law, Span, Turning, turns_at};
use super::quaternion::Quaternion;
use crate::ground::vector::V3;
use rayon::prelude::*;

/// How a path is drawn through its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawing {
    /// Distance from the corner at which a blend begins, m; 0: stops. `None`: the file's own, else 0.
    pub blend_radius: Option<f64>,
    /// Where the tool turns.
    pub turning: Turning,
}

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

/// Laying orientations along the path.
impl Path {
    fn lay_turning(&mut self, turning: Turning) {
        let elements = &self.programme.elements;
        let laws = elements.iter().enumerate();
        let laws: Vec<Law> = laws.map(|(k, e)| Law::of(k, e, turning)).collect();
        let zeros = self.zeros();
        let zones: Vec<[f64; 2]> = (0..self.corners.len())
            .map(|k| self.zone(k, turning))
            .collect();
        let (mut spans, mut at) = (Vec::with_capacity(2 * laws.len()), 0.0);
        for (k, law) in laws.iter().enumerate() {
            let end = zones.get(k).map_or(self.length, |zone| zone[0]);
            if end > at {
                spans.push(Span {
                    begin: at,
                    end,
                    law: (law.clone(), zeros[k]),
                    next: None,
                });
            }
            at = at.max(end);
            let Some([begin, end]) = zones.get(k).copied() else {
                break;
            };
            if end > begin {
                spans.push(Span {
                    begin,
                    end,
                    law: (law.clone(), zeros[k]),
                    next: Some((laws[k + 1].clone(), zeros[k + 1])),
                });
                at = end;
            }
        }
        self.spans = spans;
        self.lay_halts(&laws, &zones);
    }

    /// For every element the arc length of the path at which its own would be zero, m.
    fn zeros(&self) -> Vec<f64> {
        (0..=self.corners.len()).map(|k| self.zero(k)).collect()
    }

    /// The arc length of the path at which that of element `k` would be zero, m.
    pub fn zero(&self, k: usize) -> f64 {
        let corner = k.checked_sub(1).and_then(|k| self.corners.get(k));
        corner.map_or(0.0, |corner| match corner.passage {
            Passage::Blend => corner.end - corner.radius,
            _ => corner.end,
        })
    }

    /// Where the tool turns about the corner after element `k`: arc lengths, m.
    fn zone(&self, k: usize, turning: Turning) -> [f64; 2] {
        let corner = &self.corners[k];
        let Turning::Radius(radius) = turning else {
            return match corner.passage {
                Passage::Stop => [corner.begin; 2],
                Passage::Blend => [corner.begin, corner.end],
                Passage::Through => [corner.begin - corner.radius, corner.end + corner.radius],
            };
        };
        let elements = &self.programme.elements;
        let room = 0.5
            * elements[k]
                .curve
                .length()
                .min(elements[k + 1].curve.length());
        let radius = match self.turns_on_the_spot(k + 1) {
            true => 0.0,
            false => radius.min(room),
        };
        let rounded = match corner.passage {
            Passage::Blend => corner.radius,
            _ => 0.0,
        };
        if radius >= rounded {
            let more = radius - rounded;
            return [corner.begin - more, corner.end + more];
        }
        let (middle, half) = (
            0.5 * (corner.begin + corner.end),
            0.5 * (corner.end - corner.begin),
        );
        let share = radius / rounded * half;
        [middle - share, middle + share]
    }

    fn turns_on_the_spot(&self, index: usize) -> bool {
        let turns = &self.programme.turns;
        turns
            .binary_search_by_key(&index, |turn| turn.before)
            .is_ok()
    }

    fn lay_halts(&mut self, laws: &[Law], zones: &[[f64; 2]]) {
        let elements = &self.programme.elements;
        let last = elements.len();
        let start = |k: usize| laws[k].at(0.0, elements);
        let end = |k: usize| laws[k].at(elements[k].curve.length(), elements);
        let mut halts = vec![Halt {
            at: 0.0,
            turns: turns_at(&self.programme, 0, None, Some(start(0))),
        }];
        for (k, corner) in self.corners.iter().enumerate() {
            let open = zones[k][1] > zones[k][0];
            let (before, after) = (end(k), start(k + 1));
            let turns = match open {
                true => Vec::new(),
                false => turns_at(&self.programme, k + 1, Some(before), Some(after)),
            };
            if corner.passage == Passage::Stop || !turns.is_empty() {
                let at = corner.begin;
                halts.push(Halt { at, turns });
            }
        }
        halts.push(Halt {
            at: self.length,
            turns: turns_at(&self.programme, last, Some(end(last - 1)), None),
        });
        self.halts = halts;
    }
}
