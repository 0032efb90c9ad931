//! The planned path as a program for a controller: its corners, arcs, feeds and blend distances.

use super::cell::Cell;
use super::plan::Plan;
use crate::ground::spatial::{
    Pose, V3, add, cross, dot, norm, product, rotate, rotate_back, scale, sub, transpose, unit,
};
use crate::measurement::toolpath::{Arc, Shape};
use crate::path::Curve;
use crate::path::build::Side;
use crate::path::corner::{Corner, Passage};
use crate::path::element::Element;
use crate::path::programs::{Program, ProgramMove};
use crate::path::timeline::Feeds;

/// A spline is told as chords that leave it by at most this, m.
const CHORD: f64 = 1e-6;
/// Chords of one element at most.
const MOST: f64 = 1e5;
/// An element along which the tool turns about the spindle is cut where it has turned by this, rad ...
const TURN: f64 = 2e-4;
/// ... into pieces of at least this many blend distances, so that no blend is shortened.
const BLENDS: f64 = 2.002;

/// The program of a plan. `spindle`: its speed, rad/s, positive for M3; `turns`: the language states
/// orientations, so that elements along which the tool turns about the spindle are told in pieces.
pub fn program(
    plan: &Plan,
    name: &str,
    comments: Vec<String>,
    spindle: Option<f64>,
    turns: bool,
) -> Program {
    let mut writer = Writer {
        plan,
        spindle,
        turns,
        turn: plan.spin.turn(0.0),
        moves: Vec::new(),
    };
    writer.all();
    Program {
        name: name.to_string(),
        comments,
        base: plan.cell.workpiece,
        tool: tool(&plan.cell),
        start_joints: plan.rows.first().map(|row| row.q.to_vec()),
        moves: writer.moves,
    }
}

/// The tool frame in the flange frame: z along A6 out of the flange, y across the base's x.
fn tool(cell: &Cell) -> Pose {
    let tool = &cell.robot.tool;
    let out = outward(cell);
    let side = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let across = |helper: &V3| unit(sub(*helper, scale(dot(*helper, out), out)));
    let level = side.iter().find(|helper| dot(**helper, out).abs() < 0.9);
    let y = level.and_then(across).unwrap_or([0.0, 1.0, 0.0]);
    let columns = [cross(y, out), y, out];
    let flange = transpose(&columns);
    Pose {
        rotation: product(&transpose(&flange), &tool.rotation),
        point: rotate_back(&flange, sub(tool.tcp, tool.flange)),
    }
}

/// Direction of A6 out of the flange, every joint at zero.
fn outward(cell: &Cell) -> V3 {
    let joints = &cell.robot.joints;
    let (axis, point) = (joints[5].axis, joints[4].point);
    match dot(axis, sub(cell.robot.tool.flange, point)) < 0.0 {
        true => scale(-1.0, axis),
        false => axis,
    }
}

struct Writer<'a> {
    plan: &'a Plan,
    spindle: Option<f64>,
    turns: bool,
    /// Turn about the spindle at the last move, rad.
    turn: f64,
    moves: Vec<ProgramMove>,
}

impl Writer<'_> {
    fn all(&mut self) {
        let path = &self.plan.path;
        let elements = &path.programme.elements;
        let mut turns = path.programme.turns.iter().peekable();
        let first = path.programme.turns.first().filter(|turn| turn.before == 0);
        // a line that holds the orientation of its end begins with that
        let start = || path.orientation(0.0, Side::After);
        let start = first.map_or_else(start, |turn| turn.ends[0]);
        let begin = elements[0].curve.point(0.0);
        self.push(begin, start, 0.0, Shape::Line, &elements[0], 0.0);
        for (k, element) in elements.iter().enumerate() {
            while let Some(turn) = turns.next_if(|turn| turn.before == k) {
                let (s, at) = (self.begins(k), element.curve.point(0.0));
                self.push(at, turn.ends[1], s, Shape::Line, element, 0.0);
            }
            self.element(k, element);
        }
        for turn in turns {
            if let Some(last) = elements.last() {
                let at = last.curve.point(last.curve.length());
                self.push(at, turn.ends[1], path.length, Shape::Line, last, 0.0);
            }
        }
    }

    /// Arc length of the path at the corner before element `k`, m.
    fn begins(&self, k: usize) -> f64 {
        let corner = k.checked_sub(1).map(|k| &self.plan.path.corners[k]);
        corner.map_or(0.0, |corner| 0.5 * (corner.begin + corner.end))
    }

    fn element(&mut self, k: usize, element: &Element) {
        let path = &self.plan.path;
        let corner = path.corners.get(k);
        let blend = corner.map_or(0.0, blend);
        let s = corner.map_or(path.length, |corner| self.turns_from(corner));
        let length = element.curve.length();
        let (to, turned) = (element.curve.point(length), element.ends[1]);
        let shape = self.pieces(k, element);
        match &element.curve {
            Curve::Nurbs(nurbs) => {
                let count = chords(&element.curve);
                let step = length / count as f64;
                let from = self.begins(k);
                for i in 1..count {
                    let along = i as f64 * step;
                    let u = nurbs.table.parameter(&nurbs.curve, along);
                    let turned = nurbs.curve.orientation(u);
                    let at = element.curve.point(along);
                    let along = (from + along).min(s);
                    self.push(at, turned, along, Shape::Line, element, 0.5 * step);
                }
                self.push(to, turned, s, Shape::Line, element, blend);
            }
            _ => self.push(to, turned, s, shape, element, blend),
        }
    }

    /// Arc length of the path where the tool begins to turn from the orientation of one element to that of the next, m: what turns from there on is told
    /// of the next.
    fn turns_from(&self, corner: &Corner) -> f64 {
        let at = 0.5 * (corner.begin + corner.end);
        // they lie one behind the other
        let spans = &self.plan.path.spans;
        let near = &spans[spans.partition_point(|span| span.end < at)..];
        let mut near = near.iter().take_while(|span| span.begin <= at);
        let span = near.find(|span| span.next.is_some());
        span.map_or(corner.begin, |span| span.begin.min(corner.begin))
    }

    /// Tells an element along which the tool turns about the spindle in pieces, all but the last; the
    /// shape of that.
    fn pieces(&mut self, k: usize, element: &Element) -> Shape {
        let path = &self.plan.path;
        let (count, joint) = self.cut(k, element);
        let piece = element.curve.length() / count as f64;
        for i in 1..count {
            let along = i as f64 * piece;
            let s = path.zero(k) + along;
            let turned = path.orientation(s, Side::Before);
            let shape = shape(&element.curve, along - piece, piece);
            self.push(element.curve.point(along), turned, s, shape, element, joint);
        }
        shape(&element.curve, (count - 1) as f64 * piece, piece)
    }

    /// Into how many pieces an element is cut, and the blend distance where they meet, m.
    fn cut(&self, k: usize, element: &Element) -> (usize, f64) {
        let joint = self.joint(element);
        if !self.turns || joint <= 0.0 || matches!(element.curve, Curve::Nurbs(_)) {
            return (1, 0.0);
        }
        let length = element.curve.length();
        let most = (length / (BLENDS * joint)).clamp(1.0, MOST).floor() as usize;
        let zero = self.plan.path.zero(k);
        let turn = |i: usize| self.plan.spin.turn(zero + length * i as f64 / most as f64);
        let turned: f64 = (0..most).map(|i| (turn(i + 1) - turn(i)).abs()).sum();
        (most.min((turned / TURN).ceil() as usize).max(1), joint)
    }

    /// The blend distance asked for, m.
    fn joint(&self, element: &Element) -> f64 {
        element.asked_blend(self.plan.path.blend_radius)
    }

    /// The turn about the spindle to state at the arc length `s` (m), rad. After a stop it is that of the
    /// stop: what begins there would else have to turn on the spot first.
    fn turn_at(&self, s: f64, element: &Element) -> f64 {
        let stopped = self.moves.last().is_some_and(|last| last.blend == 0.0);
        match self.turns && stopped && self.joint(element) > 0.0 {
            true => self.turn,
            false => self.plan.spin.turn(s),
        }
    }

    fn push(
        &mut self,
        to: V3,
        turned: crate::path::Quaternion,
        s: f64,
        shape: Shape,
        element: &Element,
        blend: f64,
    ) {
        self.turn = self.turn_at(s, element);
        let axis = self.plan.cell.spindle;
        let rotation = turned.turned(scale(self.turn, axis)).matrix();
        let feeds: &Feeds = &self.plan.feeds;
        self.moves.push(ProgramMove {
            to,
            rotation,
            spindle_axis: rotate(&rotation, self.plan.cell.spindle),
            shape,
            feed: feeds.of_element(element),
            rapid: element.rapid,
            blend,
            spindle: self.spindle,
        });
    }
}

/// A line, or the arc from the length `from` (m) of the curve on.
fn shape(curve: &Curve, from: f64, length: f64) -> Shape {
    let Curve::Circle(circle) = curve else {
        return Shape::Line;
    };
    let whole = circle.arc();
    let rise = sub(curve.point(from), curve.point(0.0));
    Shape::Arc(Arc {
        centre: add(whole.centre, scale(dot(rise, whole.axis), whole.axis)),
        angle: whole.angle * length / curve.length(),
        ..whole
    })
}

/// The blend asked for at a corner that is not a stop, m.
fn blend(corner: &Corner) -> f64 {
    match corner.passage {
        Passage::Stop => 0.0,
        Passage::Blend | Passage::Through => corner.asked,
    }
}

/// Chords of a curve: the sagitta κ h²/8 stays below [`CHORD`].
fn chords(curve: &Curve) -> usize {
    let length = curve.length();
    let bend = |i: u32| norm(curve.end(length * f64::from(i) / 256.0).curvature);
    let sharpest = (0..=256).map(bend).fold(0.0, f64::max);
    let count = length * (sharpest / (8.0 * CHORD)).sqrt();
    count.clamp(8.0, MOST).ceil() as usize
}
