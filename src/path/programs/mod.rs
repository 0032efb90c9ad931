//! Programs for controllers: what was planned, in the language of the machine. One exporter, one file,
//! one line in [`EXPORTERS`].
//!
//! A program states corners, arcs, feeds and approximation distances; the blends themselves are the
//! controller's. Nothing in it depends on the day or the machine that wrote it.

mod chords;
mod gcode;
mod krl;
mod rapid;
mod text;

use crate::ground::nearest::nearest;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, Pose, V3};
use crate::measurement::toolpath::Shape;

/// A path with everything a controller must know. SI, workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// Its name; letters, digits and `_` of it are kept.
    pub name: String,
    /// Lines for people: the job, the hashes of the inputs.
    pub comments: Vec<String>,
    /// The workpiece frame in the base frame of the robot.
    pub base: Pose,
    /// The tool frame in the flange frame.
    pub tool: Pose,
    /// Joint angles at the first point, rad.
    pub start_joints: Option<Vec<f64>>,
    /// The moves; the first one is the start point.
    pub moves: Vec<ProgramMove>,
}

/// One move of a [`Program`], from the end of the move before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgramMove {
    /// End point, m.
    pub to: V3,
    /// Orientation of the tool frame there; columns are its axes.
    pub rotation: M3,
    /// Unit vector from the tip into the spindle there.
    pub spindle_axis: V3,
    /// Line or arc.
    pub shape: Shape,
    /// Feed, or the speed of a rapid motion, m/s, above zero.
    pub feed: f64,
    /// A rapid motion.
    pub rapid: bool,
    /// Distance from the end point at which the blend to the next move begins, m; 0: exact stop.
    pub blend: f64,
    /// Speed of the spindle, rad/s, positive clockwise (M3); `None`: not stated.
    pub spindle: Option<f64>,
}

/// A file of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramFile {
    /// Its name, with ending, without folder.
    pub name: String,
    /// What it holds.
    pub text: String,
}

/// A language of controllers.
pub struct Exporter {
    /// Its name, as `--program` takes it.
    pub name: &'static str,
    /// One line about it.
    pub about: &'static str,
    /// Whether it states orientations.
    pub turns: bool,
    write: fn(&Program) -> Outcome<Vec<ProgramFile>>,
}

/// Every language. A new one is one file and one line here.
pub const EXPORTERS: &[Exporter] = &[
    Exporter {
        name: "krl",
        about: "KUKA: .src with its .dat, in modules that the controller loads",
        turns: true,
        write: krl::write,
    },
    Exporter {
        name: "rapid",
        about: "ABB: .mod",
        turns: true,
        write: rapid::write,
    },
    Exporter {
        name: "gcode",
        about: "G-code of a three-axis machine: .nc",
        turns: false,
        write: gcode::write,
    },
];

impl Exporter {
    /// The exporter of that name.
    ///
    /// # Errors
    /// An unknown name.
    pub fn named(name: &str) -> Outcome<&'static Self> {
        let names: Vec<&str> = EXPORTERS.iter().map(|exporter| exporter.name).collect();
        let meant = nearest(name, &names).unwrap_or(name);
        let found = EXPORTERS.iter().find(|exporter| exporter.name == name);
        found.ok_or_else(|| {
            let remedy = format!("choose one of {}", names.join(", "));
            let what = match meant == name {
                true => format!("`{name}` is no language of programs"),
                false => format!("`{name}` is no language of programs; `{meant}` is one"),
            };
            Problem::new(what, remedy)
        })
    }

    /// Writes a program: the main file first.
    ///
    /// # Errors
    /// What the language cannot say, and a move that is not finite.
    pub fn write(&self, program: &Program) -> Outcome<Vec<ProgramFile>> {
        sound(program)?;
        (self.write)(program)
    }
}

fn sound(program: &Program) -> Outcome<()> {
    if program.moves.len() < 2 {
        return Err(Problem::new(
            "a program of less than two points",
            "give it a path",
        ));
    }
    let wrong = program.moves.iter().position(|m| {
        let numbers = m.to.iter().chain(m.rotation.iter().flatten());
        let finite = numbers.chain([&m.feed, &m.blend]).all(|x| x.is_finite());
        !(finite && m.feed > 0.0 && m.blend >= 0.0)
    });
    match wrong {
        None => Ok(()),
        Some(i) => Err(Problem::new(
            format!("move {} has no feed above zero, or is not finite", i + 1),
            "state the feed with feed_mm_min in the job, or in the path",
        )),
    }
}
