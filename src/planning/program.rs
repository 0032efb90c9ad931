//! The planned path as a program for a controller: its corners, arcs, feeds and blend distances.

use super::cell::Cell;
use super::plan::Plan;
use crate::ground::spatial::{
    Pose, V3, cross, dot, norm, product, rotate, rotate_back, scale, sub, transpose, unit,
};
use crate::measurement::toolpath::Shape;
use crate::path::Curve;
use crate::path::corner::{Corner, Passage};
use crate::path::element::Element;
use crate::path::programs::{Program, ProgramMove};
use crate::path::timeline::Feeds;

/// A spline is told as chords that leave it by at most this, m.
const CHORD: f64 = 1e-6;
/// Chords of one element at most.
const MOST: f64 = 1e5;

/// The program of a plan. `spindle`: its speed, rad/s, positive for M3.
pub fn program(plan: &Plan, name: &str, comments: Vec<String>, spindle: Option<f64>) -> Program {
    let mut writer = Writer {
        plan,
        spindle,
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
    moves: Vec<ProgramMove>,
}

impl Writer<'_> {
    fn all(&mut self) {
        let path = &self.plan.path;
        let elements = &path.programme.elements;
        let mut turns = path.programme.turns.iter().peekable();
        let first = path.programme.turns.first().filter(|turn| turn.before == 0);
        let start = first.map_or(elements[0].ends[0], |turn| turn.ends[0]);
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
        let s = corner.map_or(path.length, |c| 0.5 * (c.begin + c.end));
        let length = element.curve.length();
        let (to, turned) = (element.curve.point(length), element.ends[1]);
        match &element.curve {
            Curve::Circle(circle) => {
                let shape = Shape::Arc(circle.arc());
                self.push(to, turned, s, shape, element, blend);
            }
            Curve::Nurbs(nurbs) => {
                let count = chords(&element.curve);
                let step = length / count as f64;
                let from = self.begins(k);
                for i in 1..count {
                    let along = i as f64 * step;
                    let u = nurbs.table.parameter(&nurbs.curve, along);
                    let turned = nurbs.curve.orientation(u);
                    let at = element.curve.point(along);
                    self.push(at, turned, from + along, Shape::Line, element, 0.5 * step);
                }
                self.push(to, turned, s, Shape::Line, element, blend);
            }
            _ => self.push(to, turned, s, Shape::Line, element, blend),
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
        let rotation = self.plan.spin.apply(s, turned).matrix();
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
