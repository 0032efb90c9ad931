//! KRL for KUKA controllers: `.src` and `.dat`. A long path goes into modules of its own, which the
//! main program calls, since a controller loads files of a limited size.

use super::chords::{is_straight, spelled};
use super::text::{comment, decimals, degrees, identifier, mm};
use super::{Program, ProgramFile, ProgramMove};
use crate::ground::problem::Outcome;
use crate::ground::spatial::{M3, Pose, V3};
use crate::measurement::toolpath::{Arc, END_FOLD, RAPID_FOLD, Shape};
use crate::path::quaternion::angles;
use std::f64::consts::PI;

/// Most motions of a module: about half a megabyte.
const MODULE: usize = 5000;
/// Longest name, so that the numbers of modules fit into the 24 letters of KRL.
const NAME: usize = 19;

pub(super) fn write(program: &Program) -> Outcome<Vec<ProgramFile>> {
    let name = identifier(&program.name, NAME);
    let (start, moves) = (program.moves[0], spelled(&program.moves, |_, _, _| None));
    let mut files = Vec::new();
    let mut main = head(&name);
    preamble(&mut main, program, &name);
    if moves.len() <= MODULE {
        let mut writer = Writer::new(start.to);
        writer.start(&mut main, &start);
        moves.iter().for_each(|next| writer.motion(&mut main, next));
        writer.fold(&mut main, false);
    } else {
        let mut writer = Writer::new(start.to);
        writer.start(&mut main, &start);
        for (i, part) in moves.chunks(MODULE).enumerate() {
            let module = format!("{name}_{:03}", i + 1);
            main += &format!("{module}( )\n");
            let mut text = head(&module);
            writer.forget();
            part.iter().for_each(|next| writer.motion(&mut text, next));
            writer.fold(&mut text, false);
            files.push(file(&module, "src", text + "END\n"));
        }
    }
    files.insert(0, file(&name, "src", main + "END\n"));
    files.insert(1, file(&name, "dat", data(program, &name)));
    Ok(files)
}

fn file(name: &str, ending: &str, text: String) -> ProgramFile {
    ProgramFile {
        name: format!("{name}.{ending}"),
        text,
    }
}

fn head(name: &str) -> String {
    format!("&ACCESS RVP\n&REL 1\nDEF {name}( )\n")
}

fn preamble(text: &mut String, program: &Program, name: &str) {
    *text += ";FOLD JOB\n";
    for line in &program.comments {
        *text += &format!("; {}\n", comment(line));
    }
    *text += ";ENDFOLD\n;FOLD INI\nBAS(#INITMOV,0)\n;ENDFOLD\n;FOLD FRAMES\n";
    *text += &format!(
        "$BASE={}\n$TOOL={}\n;ENDFOLD\n",
        frame(&program.base),
        frame(&program.tool)
    );
    if program.start_joints.is_some() {
        *text += &format!("PTP {}\n", start_name(name));
    }
}

fn start_name(name: &str) -> String {
    format!("X{name}")
}

fn data(program: &Program, name: &str) -> String {
    let mut text = format!("&ACCESS RVP\n&REL 1\nDEFDAT {name}\n");
    if let Some(joints) = &program.start_joints {
        let named = joints.iter().enumerate();
        let named: Vec<String> = named
            .map(|(i, q)| format!("A{} {}", i + 1, degrees(*q)))
            .collect();
        text += &format!("DECL E6AXIS {}={{{}}}\n", start_name(name), named.join(","));
    }
    text + "ENDDAT\n"
}

fn frame(pose: &Pose) -> String {
    position(pose.point, &pose.rotation)
}

fn position(point: V3, rotation: &M3) -> String {
    let [x, y, z] = point.map(mm);
    let [a, b, c] = angles(rotation).map(degrees);
    format!("{{X {x},Y {y},Z {z},A {a},B {b},C {c}}}")
}

/// What the controller has been told.
struct Writer {
    here: V3,
    feed: String,
    blend: String,
    rapid: bool,
}

impl Writer {
    fn new(here: V3) -> Self {
        Self {
            here,
            feed: String::new(),
            blend: String::new(),
            rapid: false,
        }
    }

    /// A module states its feed and approximation again.
    fn forget(&mut self) {
        self.feed.clear();
        self.blend.clear();
    }

    /// Rapid motions stand in a fold of that name: KRL has no word for them, and the reader knows it.
    fn fold(&mut self, text: &mut String, rapid: bool) {
        if rapid != self.rapid {
            *text += if rapid { RAPID_FOLD } else { END_FOLD };
            *text += "\n";
            self.rapid = rapid;
        }
    }

    fn start(&mut self, text: &mut String, start: &ProgramMove) {
        self.speed(text, start);
        *text += &format!("LIN {}\n", position(start.to, &start.rotation));
    }

    fn speed(&mut self, text: &mut String, next: &ProgramMove) {
        let feed = decimals(next.feed, 9);
        if feed != self.feed {
            *text += &format!("$VEL.CP={feed}\n");
            self.feed = feed;
        }
    }

    fn motion(&mut self, text: &mut String, next: &ProgramMove) {
        self.fold(text, next.rapid);
        self.speed(text, next);
        let blend = mm(next.blend);
        let blends = blend != "0";
        if blends && blend != self.blend {
            *text += &format!("$APO.CDIS={blend}\n");
            self.blend = blend;
        }
        let end = position(next.to, &next.rotation);
        let flag = if blends { " C_DIS" } else { "" };
        *text += &match next.shape {
            Shape::Arc(arc) if !is_straight(self.here, &arc) => {
                self.circle(&arc, &end, next) + flag + "\n"
            }
            _ => format!("LIN {end}{flag}\n"),
        };
        self.here = next.to;
    }

    /// CIRC through the middle; more than three quarters are told by a third of the circle and CA.
    fn circle(&self, arc: &Arc, end: &str, next: &ProgramMove) -> String {
        let at = |angle: f64| position(arc.at(self.here, angle), &next.rotation);
        match arc.angle <= 1.5 * PI {
            true => format!("CIRC {},{end}", at(0.5 * arc.angle)),
            false => {
                let (middle, last) = (at(2.0 * PI / 3.0), at(4.0 * PI / 3.0));
                format!("CIRC {middle},{last},CA {}", degrees(arc.angle))
            }
        }
    }
}
