//! G-code for three axes: the spindle stands along +z of the workpiece all the way.

use super::chords::{chords, is_straight};
use super::text::{comment, decimals, identifier, mm};
use super::{Program, ProgramFile, ProgramMove};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::measurement::toolpath::{Arc, Shape};
use std::f64::consts::TAU;

/// How far from +z the spindle may lean, as a sine.
const UPRIGHT: f64 = 1e-6;

/// G code, axis of the plane, and the letters of a centre in it.
const PLANES: [(&str, usize); 3] = [("G17", 2), ("G18", 1), ("G19", 0)];

pub(super) fn write(program: &Program) -> Outcome<Vec<ProgramFile>> {
    if let Some(i) = program.moves.iter().position(|m| !upright(m.spindle_axis)) {
        let what = format!(
            "move {} leans the tool; G-code of three axes cannot say it",
            i + 1
        );
        let remedy = "write the program with --program krl or rapid";
        return Err(Problem::new(what, remedy));
    }
    let mut text = String::from("%\n");
    for line in &program.comments {
        text += &format!("({})\n", comment(line));
    }
    text += "G21 G90 G17 G40 G49 G80 G94\n";
    let mut writer = Writer::default();
    let mut before = program.moves[0];
    writer.spindle(&mut text, &before);
    text += &format!("G0{}\n", place(before.to));
    for next in &program.moves[1..] {
        for piece in spelled(&before, next) {
            writer.spindle(&mut text, &piece);
            writer.motion(&mut text, before.to, &piece);
            before = piece;
        }
    }
    text += "M5\nM30\n%\n";
    Ok(vec![ProgramFile {
        name: format!("{}.nc", identifier(&program.name, 40)),
        text,
    }])
}

fn upright([x, y, z]: V3) -> bool {
    z > 0.0 && x.hypot(y) <= UPRIGHT
}

/// An arc that lies in none of the three planes becomes chords.
fn spelled(before: &ProgramMove, next: &ProgramMove) -> Vec<ProgramMove> {
    match next.shape {
        Shape::Arc(arc) if plane(&arc).is_none() => chords(before, next, &arc),
        _ => vec![*next],
    }
}

/// The plane of an arc, and its sense about the positive axis.
fn plane(arc: &Arc) -> Option<(&'static str, usize, bool)> {
    let found = PLANES
        .iter()
        .find(|(_, axis)| arc.axis[*axis].abs() > 1.0 - 1e-14);
    found.map(|(code, axis)| (*code, *axis, arc.axis[*axis] > 0.0))
}

fn place(point: V3) -> String {
    let [x, y, z] = point.map(mm);
    format!(" X{x} Y{y} Z{z}")
}

/// What the controller has been told.
#[derive(Default)]
struct Writer {
    feed: String,
    spindle: String,
    plane: &'static str,
    exact: Option<bool>,
}

impl Writer {
    fn spindle(&mut self, text: &mut String, next: &ProgramMove) {
        let Some(speed) = next.spindle else {
            return;
        };
        let rpm = decimals(speed.abs() / TAU * 60.0, 6);
        let words = match (rpm.as_str(), speed > 0.0) {
            ("0", _) => "M5".to_string(),
            (rpm, true) => format!("S{rpm} M3"),
            (rpm, false) => format!("S{rpm} M4"),
        };
        if words != self.spindle {
            *text += &format!("{words}\n");
            self.spindle = words;
        }
    }

    fn motion(&mut self, text: &mut String, from: V3, next: &ProgramMove) {
        let exact = mm(next.blend) == "0";
        if self.exact != Some(exact) {
            *text += if exact { "G61\n" } else { "G64\n" };
            self.exact = Some(exact);
        }
        let feed = match next.rapid {
            true => String::new(),
            false => self.feed(next.feed),
        };
        *text += &match next.shape {
            Shape::Arc(arc) if !is_straight(from, &arc) => self.arc(from, next, &arc),
            _ if next.rapid => format!("G0{}", place(next.to)),
            _ => format!("G1{}", place(next.to)),
        };
        *text += &format!("{feed}\n");
    }

    fn feed(&mut self, feed: f64) -> String {
        let word = format!(" F{}", decimals(feed * 6e4, 6));
        match word == self.feed {
            true => String::new(),
            false => {
                self.feed.clone_from(&word);
                word
            }
        }
    }

    fn arc(&mut self, from: V3, next: &ProgramMove, arc: &Arc) -> String {
        let (code, normal, counter) = plane(arc).unwrap_or(("G17", 2, true));
        let mut text = String::new();
        if code != self.plane {
            text += &format!("{code} ");
            self.plane = code;
        }
        text += if counter { "G3" } else { "G2" };
        text += &place(next.to);
        for (axis, letter) in ["I", "J", "K"].into_iter().enumerate() {
            if axis != normal {
                text += &format!(" {letter}{}", mm(arc.centre[axis] - from[axis]));
            }
        }
        let turns = ((arc.angle - 1e-9) / TAU).floor();
        if turns >= 1.0 {
            text += &format!(" P{}", turns + 1.0);
        }
        text
    }
}
