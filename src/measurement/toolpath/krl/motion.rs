//! Motions: lines, circles, and those of the axes, which are passed over.

mod tail;

use super::super::shape::Arc;
use super::super::{Move, Orientation, Shape};
use super::scan::operand;
use super::value::Value;
use super::{State, shown};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, roll_pitch_yaw, rotate};
use crate::ground::units::DEGREE;
use tail::Tail;

/// What a motion is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verb {
    Line,
    Circle,
    /// Of the axes: its way is the controller's.
    Point,
}

/// Motions, whether they are relative.
const VERBS: &[(&str, Verb)] = &[
    ("LIN", Verb::Line),
    ("SLIN", Verb::Line),
    ("LIN_REL", Verb::Line),
    ("SLIN_REL", Verb::Line),
    ("CIRC", Verb::Circle),
    ("SCIRC", Verb::Circle),
    ("CIRC_REL", Verb::Circle),
    ("SCIRC_REL", Verb::Circle),
    ("PTP", Verb::Point),
    ("SPTP", Verb::Point),
    ("PTP_REL", Verb::Point),
    ("SPTP_REL", Verb::Point),
];

impl Verb {
    pub(super) fn of(word: &str) -> Option<Self> {
        VERBS.iter().find(|verb| verb.0 == word).map(|verb| verb.1)
    }
}

/// A point of the path.
#[derive(Debug, Clone, Copy)]
struct Target {
    to: V3,
    /// A, B, C, rad.
    angles: V3,
}

impl State {
    pub(super) fn motion(
        &mut self,
        verb: Verb,
        word: &str,
        rest: &str,
        line: usize,
    ) -> Outcome<()> {
        let (motion, with) = match rest.split_once(" WITH ") {
            Some((motion, with)) => (motion, split_flags(with)),
            None => (rest, ("", "")),
        };
        let before = (self.feed, self.blend, self.held);
        self.with_for_one(with.0, line)?;
        let relative = word.ends_with("_REL");
        let done = match verb {
            Verb::Point => self.axes(word, motion, line),
            Verb::Line => self.straight(motion, with.1, relative, line),
            Verb::Circle => self.circle(motion, with.1, relative, line),
        };
        if !with.0.is_empty() {
            (self.feed, self.blend, self.held) = before;
        }
        done
    }

    fn with_for_one(&mut self, text: &str, line: usize) -> Outcome<()> {
        match text.trim().is_empty() {
            true => Ok(()),
            false => self.with(text, line),
        }
    }

    /// PTP to joint angles is passed over; to a frame it is no path that can be known.
    fn axes(&mut self, word: &str, rest: &str, line: usize) -> Outcome<()> {
        let (target, _) = operand(rest);
        let value = Value::of(target, &self.variables);
        let home = ["HOME", "XHOME", "$AXIS_ACT", "$H_POS", "$AXIS_ACT_MEAS"];
        let axes = value
            .as_ref()
            .map_or_else(|| is_home(target, &home), Value::is_axes);
        if !axes {
            let what = format!(
                "{word} to `{}` is no path: the axes go there as the controller likes",
                shown(target)
            );
            let remedy =
                "write LIN for a motion of the tool, or PTP with joint angles {A1 ..} to approach";
            return Err(Problem::new(what, remedy));
        }
        self.draft.pass_over(word, line);
        self.lost = true;
        Ok(())
    }

    fn straight(&mut self, rest: &str, flags: &str, relative: bool, line: usize) -> Outcome<()> {
        let (point, rest) = operand(rest);
        let tail = Tail::of(rest)?.and(Tail::of(flags)?);
        let target = self.target(point, relative, tail.in_tool)?;
        self.push(target, Shape::Line, &tail, line)
    }

    fn circle(&mut self, rest: &str, flags: &str, relative: bool, line: usize) -> Outcome<()> {
        let (middle, rest) = operand(rest);
        let rest = rest.trim_start().strip_prefix(',').ok_or_else(|| {
            let remedy = "write CIRC with an auxiliary point and the end point";
            Problem::new("a circle without its end point", remedy)
        })?;
        let (end, rest) = operand(rest);
        let tail = Tail::of(rest)?.and(Tail::of(flags)?);
        let from = self.draft.here().filter(|_| !self.lost).ok_or_else(|| {
            Problem::new(
                "a circle from a point that is not known",
                "go to its start with LIN",
            )
        })?;
        let through = self.target(middle, relative, tail.in_tool)?;
        let mut target = self.target(end, relative, tail.in_tool)?;
        let mut arc = Arc::through(from, through.to, target.to)?;
        if let Some(angle) = tail.circular_angle {
            arc = Arc {
                axis: arc.axis.map(|x| x * angle.signum()),
                angle: angle.abs(),
                ..arc
            };
            target.to = arc.at(from, arc.angle);
        }
        self.push(target, Shape::Arc(arc), &tail, line)
    }

    /// The point that an operand names.
    fn target(&self, text: &str, relative: bool, in_tool: bool) -> Outcome<Target> {
        let value = Value::of(text, &self.variables).ok_or_else(|| undefined(text))?;
        if value.is_axes() || !value.is_position() {
            let remedy = "write a frame {X .., Y .., Z .., A .., B .., C ..}";
            return Err(Problem::new(
                format!("`{}` is no point", shown(text)),
                remedy,
            ));
        }
        external_axes(&value)?;
        match relative {
            true => self.relative(&value, in_tool),
            false => self.absolute(&value),
        }
    }

    fn absolute(&self, value: &Value) -> Outcome<Target> {
        let known = self.draft.here().filter(|_| !self.lost);
        let place = [("X", 0), ("Y", 1), ("Z", 2)];
        let turn = [("A", 0), ("B", 1), ("C", 2)];
        let missing = |name: &str| {
            let remedy = "give the point all of X, Y, Z, A, B and C";
            Problem::new(
                format!("{name} is not stated, and where the tool is is not known"),
                remedy,
            )
        };
        let mut target = Target {
            to: [0.0; 3],
            angles: self.angles,
        };
        for (name, i) in place {
            let stated = value.number(name).map(|mm| mm * 1e-3);
            let held = known.map(|here| here[i]);
            target.to[i] = stated.or(held).ok_or_else(|| missing(name))?;
        }
        for (name, i) in turn {
            let stated = value.number(name).map(|degrees| degrees * DEGREE);
            let held = known.map(|_| self.angles[i]);
            target.angles[i] = stated.or(held).ok_or_else(|| missing(name))?;
        }
        Ok(target)
    }

    fn relative(&self, value: &Value, in_tool: bool) -> Outcome<Target> {
        let here = self.draft.here().filter(|_| !self.lost).ok_or_else(|| {
            let remedy = "go to a point with LIN first";
            Problem::new("a relative motion from a point that is not known", remedy)
        })?;
        let number = |name: &str| value.number(name).unwrap_or(0.0);
        let turned = ["A", "B", "C"].map(number);
        if turned[1] != 0.0 || turned[2] != 0.0 || (in_tool && turned[0] != 0.0) {
            let remedy = "state the orientation absolutely, with LIN";
            return Err(Problem::new(
                "a relative turn about B or C is not understood",
                remedy,
            ));
        }
        let step = ["X", "Y", "Z"].map(|name| number(name) * 1e-3);
        let [a, b, c] = self.angles;
        let step = match in_tool {
            true => rotate(&roll_pitch_yaw(c, b, a), step),
            false => step,
        };
        Ok(Target {
            to: add(here, step),
            angles: [a + turned[0] * DEGREE, b, c],
        })
    }

    fn push(&mut self, target: Target, shape: Shape, tail: &Tail, line: usize) -> Outcome<()> {
        let first = self.draft.moves.is_empty();
        if first || !self.held {
            self.angles = target.angles;
        }
        let [a, b, c] = self.angles;
        let orientation = match self.draft.moves.last() {
            Some(last) if self.held => last.orientation,
            _ => Orientation::Full(roll_pitch_yaw(c, b, a)),
        };
        let blend = match tail.blends {
            true => self.blend,
            false => Some(0.0),
        };
        self.lost = false;
        self.draft.push(Move {
            shape,
            feed: self.feed.filter(|_| !first),
            rapid: self.rapid && !first,
            blend,
            ..Move::line(target.to, orientation, line)
        })
    }
}

/// Assignments of WITH, and flags behind the last one.
fn split_flags(with: &str) -> (&str, &str) {
    let at = [" C_DIS", " C_SPL"]
        .iter()
        .filter_map(|flag| with.find(flag))
        .min();
    with.split_at(at.unwrap_or(with.len()))
}

fn is_home(target: &str, home: &[&str]) -> bool {
    home.contains(&target) || target.starts_with("XHOME")
}

fn undefined(text: &str) -> Problem {
    let remedy = "define it in the program or in the .dat file beside it, or write {X .., Y .., Z .., A .., B .., C ..}";
    Problem::new(
        format!("the point `{}` is not defined", shown(text)),
        remedy,
    )
}

/// A track or a table moves the tool against the workpiece.
fn external_axes(value: &Value) -> Outcome<()> {
    let names = ["E1", "E2", "E3", "E4", "E5", "E6"];
    match names
        .iter()
        .find(|name| value.number(name).is_some_and(|e| e != 0.0))
    {
        None => Ok(()),
        Some(name) => Err(Problem::new(
            format!("{name} moves an external axis"),
            "only the six axes of the robot are known: leave E1 to E6 at zero",
        )),
    }
}
