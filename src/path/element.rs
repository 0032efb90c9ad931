//! From the moves of a file to elements: what has no length is dropped, or is a turn on the spot.

use super::curve::{ByLength, Curve};
use super::nurbs::NurbsCurve;
use super::quaternion::Quaternion;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::{V3, norm, rotate, sub};
use crate::measurement::toolpath::{Nurbs, Orientation, Shape, Toolpath};
use std::sync::Arc as Shared;

/// Places nearer than this are one, m.
pub const SAME_PLACE: f64 = 1e-9;
/// Orientations nearer than this are one, rad.
pub const SAME_ORIENTATION: f64 = 1e-9;

/// One programmed element, not yet blended.
#[derive(Debug, Clone)]
pub struct Element {
    /// Its curve.
    pub curve: Curve,
    /// Orientation at its start and at its end.
    pub ends: [Quaternion; 2],
    /// Feed that its file states, m/s.
    pub feed: Option<f64>,
    /// No cut.
    pub rapid: bool,
    /// Where the blend to the next element begins, m from the corner, if the file says so.
    pub blend: Option<f64>,
    /// The same for this corner alone, m: before what the job says.
    pub own_blend: Option<f64>,
    /// Line of the file that ends there.
    pub line: usize,
}

impl Element {
    /// Where the blend to the next element is asked to begin, m from the corner: as the file says of this corner alone,
    /// else as the job says (`job`), else as the file says of all.
    pub fn asked_blend(&self, job: Option<f64>) -> f64 {
        self.own_blend.or(job).or(self.blend).unwrap_or(0.0)
    }

    /// Whether the tool turns from one end to the other, of a line or an arc.
    pub fn turns(&self) -> bool {
        let is_spline = matches!(self.curve, Curve::Nurbs(_));
        !is_spline && norm(self.ends[0].way_to(self.ends[1])) > SAME_ORIENTATION
    }
}

/// The elements of a path and the turns on the spot between them.
#[derive(Debug, Clone, Default)]
pub struct Programme {
    /// The elements in order.
    pub elements: Vec<Element>,
    /// Turns before the element of this index (that of the end: their number).
    pub turns: Vec<SpotTurn>,
    /// Points dropped because they repeat the one before.
    pub duplicates: usize,
    /// Points of the file.
    pub points: usize,
    /// Whether every orientation leaves the turn about the spindle free.
    pub free_spin: bool,
}

/// A turn without motion of the tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpotTurn {
    /// Index of the element that follows.
    pub before: usize,
    /// Orientations it leads between.
    pub ends: [Quaternion; 2],
    /// Line of the file.
    pub line: usize,
}

/// How the tool is held: what a path leaves open.
#[derive(Debug, Clone, Copy)]
pub struct Holding {
    /// Unit vector from the tip into the spindle, in the tool frame.
    pub axis: V3,
    /// The tool frame from which the first orientation is reached by the least rotation, if the path
    /// gives only directions.
    pub start: Quaternion,
}

impl Holding {
    /// The orientation asked for; the turn about the spindle comes from `before` by the least
    /// rotation (no twist about the spindle).
    pub fn orientation(&self, asked: &Orientation, before: Quaternion) -> Quaternion {
        match asked {
            Orientation::Full(matrix) => Quaternion::of(matrix),
            Orientation::Axis(goal) => {
                let now = rotate(&before.matrix(), self.axis);
                Quaternion::between(now, *goal).times(before).normalised()
            }
        }
    }
}

/// Takes a file's moves as elements.
///
/// # Errors
/// A path without two different places.
pub fn programme(toolpath: &Toolpath, holding: &Holding) -> Outcome<Programme> {
    let programme = match &toolpath.curve {
        Some(nurbs) => of_curve(nurbs, holding),
        None => of_moves(toolpath, holding),
    };
    if programme.elements.is_empty() {
        let remedy = "give at least two different points";
        return Err(Problem::new("holds no motion", remedy).in_file(&toolpath.path));
    }
    Ok(programme)
}

fn of_moves(toolpath: &Toolpath, holding: &Holding) -> Programme {
    let mut programme = Programme {
        points: toolpath.moves.len(),
        free_spin: all_free(toolpath.moves.iter().map(|step| &step.orientation)),
        ..Programme::default()
    };
    let Some(first) = toolpath.moves.first() else {
        return programme;
    };
    let mut at = (
        first.to,
        holding.orientation(&first.orientation, holding.start),
    );
    for step in &toolpath.moves[1..] {
        let turned = holding.orientation(&step.orientation, at.1);
        let curve = match &step.shape {
            Shape::Line if norm(sub(step.to, at.0)) < SAME_PLACE => None,
            Shape::Line => Curve::line(at.0, step.to),
            Shape::Arc(arc) => Curve::arc(at.0, step.to, arc),
        };
        let ends = [at.1, turned];
        match curve {
            Some(curve) => programme.elements.push(Element {
                curve,
                ends,
                feed: step.feed,
                rapid: step.rapid,
                blend: step.blend,
                own_blend: step.own_blend,
                line: step.line,
            }),
            None => programme.stay(ends, step.line),
        }
        let place = if programme.elements.is_empty() {
            at.0
        } else {
            step.to
        };
        at = (place, turned);
    }
    programme
}

impl Programme {
    fn stay(&mut self, ends: [Quaternion; 2], line: usize) {
        if norm(ends[0].way_to(ends[1])) < SAME_ORIENTATION {
            self.duplicates += 1;
        } else {
            let before = self.elements.len();
            self.turns.push(SpotTurn { before, ends, line });
        }
    }
}

fn all_free<'a>(mut orientations: impl Iterator<Item = &'a Orientation>) -> bool {
    orientations.all(|orientation| matches!(orientation, Orientation::Axis(_)))
}

/// One element per stretch without a corner.
fn of_curve(nurbs: &Nurbs, holding: &Holding) -> Programme {
    let mut turned = holding.start;
    let turns: Vec<Quaternion> = nurbs
        .orientations
        .iter()
        .map(|asked| {
            turned = holding.orientation(asked, turned);
            turned
        })
        .collect();
    let curve = Shared::new(NurbsCurve::new(
        nurbs.degree,
        &nurbs.knots,
        &nurbs.points,
        &nurbs.weights,
        &turns,
    ));
    let elements = stretches(&curve).into_iter().filter_map(|breaks| {
        let ends = [breaks[0], breaks[breaks.len() - 1]].map(|u| curve.orientation(u));
        let measured = ByLength::measured(curve.clone(), &breaks);
        (measured.table.total() > SAME_PLACE).then(|| Element {
            curve: Curve::Nurbs(Box::new(measured)),
            ends,
            feed: nurbs.feed,
            rapid: false,
            blend: None,
            own_blend: None,
            line: nurbs.lines.last().copied().unwrap_or(1),
        })
    });
    Programme {
        elements: elements.collect(),
        points: nurbs.points.len(),
        free_spin: all_free(nurbs.orientations.iter()),
        ..Programme::default()
    }
}

/// The breaks of a curve, cut where it may have corners.
fn stretches(curve: &NurbsCurve) -> Vec<Vec<f64>> {
    let breaks = curve.breaks();
    let (mut all, mut open) = (Vec::new(), vec![breaks[0]]);
    for (i, u) in breaks.iter().enumerate().skip(1) {
        open.push(*u);
        if i + 1 == breaks.len() || curve.may_bend_at(*u) {
            all.push(std::mem::replace(&mut open, vec![*u]));
        }
    }
    all
}
