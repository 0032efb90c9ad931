//! Tool paths: what a CAM system, a controller's program or a table of points says the tool tip
//! should do. One file per reader, one line in [`READERS`].
//!
//! Everything is SI and in the **workpiece frame**. A reader refuses, with its line, what would
//! change the path and is not understood; what has no effect on it is passed over and counted.

mod apt;
mod draft;
mod gcode;
mod krl;
mod points;
mod shape;
mod source;

pub use krl::{END_FOLD, RAPID_FOLD};
pub(super) use points::FACTS;
pub use shape::{Arc, Shape};

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, Pose, V3};
use draft::Draft;
use source::Source;
use std::path::{Path, PathBuf};

/// A path as a file states it: no robot, no blends drawn, no time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Toolpath {
    /// The file.
    pub path: PathBuf,
    /// SHA-256 of the file, 64 hex digits.
    pub sha256: String,
    /// Name of the reader: `points`, `apt`, `gcode` or `krl`.
    pub format: &'static str,
    /// The moves in order. `moves[0].to` is where the path begins: its shape is [`Shape::Line`],
    /// and its feed and `rapid` say nothing. Empty if the file is one curve.
    pub moves: Vec<Move>,
    /// The curve, for a file of control points (source 003), instead of moves.
    pub curve: Option<Nurbs>,
    /// `$BASE` of a robot program: the workpiece in the base frame, as that program placed it.
    pub base: Option<Pose>,
    /// `$TOOL` of a robot program: the tool frame in the flange frame of that controller.
    pub tool: Option<Pose>,
    /// Further files that were read (`.dat`, called programs), with their SHA-256.
    pub inputs: Vec<(PathBuf, String)>,
    /// What was passed over, in the order of its first occurrence.
    pub passed_over: Vec<PassedOver>,
    /// True when the file says of itself that nobody measured or made it.
    pub synthetic: bool,
    /// It was corrected (`ident compensate`): its commands are not the part that was drawn.
    pub corrected: bool,
}

/// One move of the tool tip, from the end of the move before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// End point, m.
    pub to: V3,
    /// Orientation at the end point. Never "as before": readers carry it on.
    pub orientation: Orientation,
    /// Feed along the path, m/s; `None`: the file states none (nor a rapid motion's speed).
    pub feed: Option<f64>,
    /// A rapid motion: no cut, its speed is the job's.
    pub rapid: bool,
    /// Line or arc.
    pub shape: Shape,
    /// Distance from the end point at which a blend to the next move begins, m; 0: exact stop;
    /// `None`: the file does not say, the job does.
    pub blend: Option<f64>,
    /// The same for this point alone, m: it goes before what the job says. `None`: nothing special about it.
    pub own_blend: Option<f64>,
    /// Speed of the spindle, rad/s, positive clockwise seen from the spindle (M3), 0 when stopped;
    /// `None`: not stated so far.
    pub spindle: Option<f64>,
    /// Arc length of the programmed path at the end point, m (`s_mm` of a compensated path).
    pub station: Option<f64>,
    /// 1-based line of the file.
    pub line: usize,
}

/// Orientation of the tool in the workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Orientation {
    /// Unit vector from the tip into the spindle; the turn about it is free.
    Axis(V3),
    /// Rotation from the tool frame to the workpiece frame: columns are the tool's axes,
    /// `Rz(a) Ry(b) Rx(c)` of the file's angles.
    Full(M3),
}

/// A non-uniform rational B-spline (source 003; Piegl & Tiller 1997, eq. 4.1). There are
/// `points.len() + degree + 1` knots, not decreasing, none more than `degree + 1` times.
#[derive(Debug, Clone, PartialEq)]
pub struct Nurbs {
    /// Degree, at least 1.
    pub degree: usize,
    /// Knots; the curve runs from `knots[degree]` to `knots[points.len()]`.
    pub knots: Vec<f64>,
    /// Control points, m.
    pub points: Vec<V3>,
    /// Weights, one per control point, above zero.
    pub weights: Vec<f64>,
    /// Orientations, one per control point.
    pub orientations: Vec<Orientation>,
    /// Feed along the curve, m/s.
    pub feed: Option<f64>,
    /// 1-based line of each control point.
    pub lines: Vec<usize>,
}

/// Something that has no effect on the path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PassedOver {
    /// The word, as the file writes it: `COOLNT`, `G43`, `PTP`.
    pub what: String,
    /// How often.
    pub count: usize,
    /// 1-based line of the first one.
    pub line: usize,
}

/// A file format of paths.
pub struct Reader {
    /// Its name, as [`Toolpath::format`] gives it.
    pub name: &'static str,
    /// Endings of its files, lower case, without the dot.
    pub endings: &'static [&'static str],
    /// Whether the first lines look like it, for files with another ending.
    recognises: fn(&str) -> bool,
    read: fn(&Source) -> Outcome<Draft>,
}

/// Every format. A new one is one file and one line here.
pub const READERS: &[Reader] = &[
    Reader {
        name: "points",
        endings: &["csv"],
        recognises: points::recognises,
        read: points::read,
    },
    Reader {
        name: "apt",
        endings: &["cls", "apt", "aptsource", "ncl", "cl"],
        recognises: apt::recognises,
        read: apt::read,
    },
    Reader {
        name: "gcode",
        endings: &["nc", "ngc", "gcode", "tap", "cnc"],
        recognises: gcode::recognises,
        read: gcode::read,
    },
    Reader {
        name: "krl",
        endings: &["src"],
        recognises: krl::recognises,
        read: krl::read,
    },
];

/// Bytes that are looked at to recognise a format.
const HEAD: usize = 4096;

impl Reader {
    /// The reader of a file: by its ending, else by its first lines.
    ///
    /// # Errors
    /// A file that none of the readers knows.
    fn of(source: &Source) -> Outcome<&'static Self> {
        let ending = source
            .path
            .extension()
            .map(|e| e.to_string_lossy().to_lowercase());
        let ending = ending.unwrap_or_default();
        let named = READERS
            .iter()
            .find(|r| r.endings.contains(&ending.as_str()));
        let head = &source.bytes[..source.bytes.len().min(HEAD)];
        let head = String::from_utf8_lossy(head);
        let found = named.or_else(|| READERS.iter().find(|reader| (reader.recognises)(&head)));
        found.ok_or_else(|| {
            let endings = READERS
                .iter()
                .flat_map(|r| r.endings)
                .map(|e| format!(".{e}"));
            let known: Vec<String> = endings.collect();
            let remedy = format!("give the file one of the endings {}", known.join(", "));
            Problem::new("is no path that is known", remedy)
        })
    }
}

impl Toolpath {
    /// Reads a path file.
    ///
    /// # Errors
    /// What cannot be read, and what would change the path and is not understood: file, line, remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::of_source(&Source::read(path)?)
    }

    /// Interprets the bytes of a path file that stands at `path`.
    ///
    /// # Errors
    /// As [`Toolpath::read`].
    pub fn of_bytes(path: &Path, bytes: &[u8]) -> Outcome<Self> {
        Self::of_source(&Source::of_bytes(path, bytes.to_vec()))
    }

    fn of_source(source: &Source) -> Outcome<Self> {
        let read = || {
            let reader = Reader::of(source)?;
            Self::of_draft(source, reader.name, (reader.read)(source)?)
        };
        read().map_err(|problem: Problem| problem.at_line(1).in_file(&source.path))
    }

    fn of_draft(source: &Source, format: &'static str, draft: Draft) -> Outcome<Self> {
        if draft.curve.is_none() && draft.moves.len() < 2 {
            let what = format!(
                "holds {} of the two points that a path needs",
                draft.moves.len()
            );
            let remedy = "give a start point and at least one move from it";
            return Err(Problem::new(what, remedy).at_line(1));
        }
        Ok(Self {
            path: source.path.clone(),
            sha256: source.sha256.clone(),
            format,
            moves: draft.moves,
            curve: draft.curve,
            base: draft.base,
            tool: draft.tool,
            inputs: draft.inputs,
            passed_over: draft.passed_over,
            synthetic: draft.synthetic,
            corrected: draft.corrected,
        })
    }
}
