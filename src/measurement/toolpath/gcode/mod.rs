//! G-code (ISO 6983, as LinuxCNC and Fanuc write it): lines and arcs of a three-axis machine whose
//! spindle stands along +z of the workpiece.

mod arc;
mod block;
mod codes;
mod refusal;

use super::draft::{Draft, within};
use super::source::{Source, lines};
use super::{Move, Orientation, Shape};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::V3;
use arc::Plane;
use block::Block;
use codes::{Act, G_CODES, M_CODES};
use refusal::{refused, shown, stray_centre};
use std::f64::consts::TAU;

pub(super) fn recognises(head: &str) -> bool {
    let is_code = |line: &str| {
        let line = line.trim().to_uppercase();
        let rest = line.strip_prefix(['G', 'N', 'M']);
        line == "%" || rest.is_some_and(|r| r.starts_with(|c: char| c.is_ascii_digit()))
    };
    head.lines()
        .filter(|line| !line.trim().is_empty())
        .take(5)
        .any(is_code)
}

pub(super) fn read(source: &Source) -> Outcome<Draft> {
    let text = source.text()?;
    let mut state = State::default();
    for (number, line) in lines(&text) {
        let block = Block::of(line).map_err(|problem| problem.at_line(number))?;
        state
            .take(&block, number)
            .map_err(|problem| problem.at_line(number))?;
        if state.finished {
            break;
        }
    }
    Ok(state.draft)
}

/// What the last G0 to G3 said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Motion {
    Rapid,
    Line,
    Clockwise,
    Counter,
}

/// The modal state of the controller.
struct State {
    draft: Draft,
    /// m per unit of the program.
    unit: f64,
    motion: Option<Motion>,
    plane: Plane,
    relative: bool,
    /// I, J, K are absolute.
    absolute_centres: bool,
    per_turn: bool,
    /// F as written times the unit: m/min, or m per revolution.
    feed: Option<f64>,
    speed: Option<f64>,
    /// +1 for M3, −1 for M4, 0 for M5.
    sense: Option<f64>,
    /// Work offset in force, 54 if never said.
    offset: i32,
    place: [Option<f64>; 3],
    finished: bool,
}

impl Default for State {
    fn default() -> Self {
        Self {
            draft: Draft::default(),
            unit: 1e-3,
            motion: None,
            plane: Plane::XY,
            relative: false,
            absolute_centres: false,
            per_turn: false,
            feed: None,
            speed: None,
            sense: None,
            offset: 54,
            place: [None; 3],
            finished: false,
        }
    }
}

impl State {
    fn take(&mut self, block: &Block, line: usize) -> Outcome<()> {
        let mut away = false;
        for code in block.codes('G') {
            away |= self.g_code(code, line)?;
        }
        self.words(block, line)?;
        for code in block.codes('M') {
            self.m_code(code, line)?;
        }
        match (away, block.moves()) {
            (true, _) | (false, false) => Ok(()),
            (false, true) => self.go(block, line),
        }
    }

    /// Takes a G code; true if the block's axis words are no point of the path.
    fn g_code(&mut self, tenths: i32, line: usize) -> Outcome<bool> {
        let found = G_CODES.iter().find(|(known, _)| *known == tenths);
        let act = found.map_or(Act::Refused, |(_, act)| *act);
        match act {
            Act::Motion(motion) => self.motion = Some(motion),
            Act::Plane(plane) => self.plane = plane,
            Act::Unit(unit) => self.unit = unit,
            Act::Relative(relative) => self.relative = relative,
            Act::AbsoluteCentres(absolute) => self.absolute_centres = absolute,
            Act::PerTurn(per_turn) => self.per_turn = per_turn,
            Act::Offset(offset) => self.one_offset(offset, line)?,
            Act::Away => self.pass_over('G', tenths, line),
            Act::PassedOver | Act::End => self.pass_over('G', tenths, line),
            Act::Sense(_) | Act::Refused => return Err(refused('G', tenths)),
        }
        Ok(act == Act::Away)
    }

    fn m_code(&mut self, tenths: i32, line: usize) -> Outcome<()> {
        let found = M_CODES.iter().find(|(known, _)| *known == tenths);
        match found.map_or(Act::PassedOver, |(_, act)| *act) {
            Act::Sense(sense) => self.sense = Some(sense),
            Act::End => {
                self.pass_over('M', tenths, line);
                self.finished = true;
            }
            Act::Refused => return Err(refused('M', tenths)),
            _ => self.pass_over('M', tenths, line),
        }
        Ok(())
    }

    fn pass_over(&mut self, letter: char, tenths: i32, line: usize) {
        self.draft.pass_over(&shown(letter, tenths), line);
    }

    /// One work offset is what the job places; a second one would move the path.
    fn one_offset(&mut self, offset: i32, line: usize) -> Outcome<()> {
        if offset != self.offset && !self.draft.moves.is_empty() {
            let remedy = "post each work offset into a file and a job of its own";
            let what = format!("G{offset} begins another coordinate system within the path");
            return Err(Problem::new(what, remedy));
        }
        self.offset = offset;
        self.pass_over('G', offset * 10, line);
        Ok(())
    }

    /// F, S, and words without effect.
    fn words(&mut self, block: &Block, line: usize) -> Outcome<()> {
        if let Some(feed) = block.value('F') {
            if feed <= 0.0 {
                return Err(Problem::new(
                    "the feed is not above zero",
                    "write F with a value above zero",
                ));
            }
            self.feed = Some(feed * self.unit);
        }
        if let Some(speed) = block.value('S') {
            self.speed = Some(speed / 60.0 * TAU);
        }
        for letter in block.idle_letters() {
            self.draft.pass_over(&letter.to_string(), line);
        }
        Ok(())
    }

    fn go(&mut self, block: &Block, line: usize) -> Outcome<()> {
        let motion = self.motion.ok_or_else(|| {
            Problem::new(
                "a point without G0, G1, G2 or G3",
                "say first how the tool moves",
            )
        })?;
        let from = self.known();
        let place = self.target(block)?;
        let known: Option<Vec<f64>> = place.iter().copied().collect();
        let to = known.and_then(|place| V3::try_from(place).ok());
        if let Some(to) = to {
            within(to)?;
        }
        let shape = match (motion, from, to) {
            (Motion::Rapid | Motion::Line, ..) if !block.has_centre() => Shape::Line,
            (Motion::Rapid | Motion::Line, ..) => return Err(stray_centre()),
            (_, Some(from), Some(to)) => self.arc(block, motion, from, to)?,
            _ => {
                let remedy = "go to X, Y and Z with G0 or G1 first";
                return Err(Problem::new(
                    "an arc from a point that is not known",
                    remedy,
                ));
            }
        };
        self.place = place;
        match to {
            Some(to) => self.push(to, shape, motion, from.is_none(), line),
            None => {
                self.draft.pass_over("way to the first point", line);
                Ok(())
            }
        }
    }

    fn known(&self) -> Option<V3> {
        let [Some(x), Some(y), Some(z)] = self.place else {
            return None;
        };
        Some([x, y, z])
    }

    fn target(&self, block: &Block) -> Outcome<[Option<f64>; 3]> {
        let mut place = self.place;
        for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            let Some(value) = block.value(letter).map(|value| value * self.unit) else {
                continue;
            };
            place[axis] = match (self.relative, place[axis]) {
                (false, _) => Some(value),
                (true, Some(before)) => Some(before + value),
                (true, None) => {
                    let what = format!("{letter} is relative to a place that is not known");
                    return Err(Problem::new(
                        what,
                        "go to X, Y and Z absolutely (G90) first",
                    ));
                }
            };
        }
        Ok(place)
    }

    fn arc(&self, block: &Block, motion: Motion, from: V3, to: V3) -> Outcome<Shape> {
        let clockwise = motion == Motion::Clockwise;
        let words = arc::Words::of(block, self.unit, self.absolute_centres)?;
        words.arc(self.plane, clockwise, from, to).map(Shape::Arc)
    }

    fn push(
        &mut self,
        to: V3,
        shape: Shape,
        motion: Motion,
        first: bool,
        line: usize,
    ) -> Outcome<()> {
        let rapid = motion == Motion::Rapid && !first;
        let feed = self.feed_now().filter(|_| !rapid && !first);
        let missing = feed.is_none() && self.per_turn && !rapid && !first;
        if missing {
            let remedy = "state F, S and M3 before, or a feed per minute (G94)";
            return Err(Problem::new(
                "a feed per revolution that is not known",
                remedy,
            ));
        }
        self.draft.push(Move {
            shape: if first { Shape::Line } else { shape },
            rapid,
            feed,
            spindle: self.spindle(),
            ..Move::line(to, Orientation::Axis([0.0, 0.0, 1.0]), line)
        })
    }

    fn spindle(&self) -> Option<f64> {
        match (self.sense, self.speed) {
            (Some(sense), Some(speed)) => Some(sense * speed),
            (Some(0.0), None) => Some(0.0),
            _ => None,
        }
    }

    fn feed_now(&self) -> Option<f64> {
        match self.per_turn {
            false => self.feed.map(|feed| feed / 60.0),
            true => {
                let speed = self.spindle().filter(|w| *w != 0.0)?;
                self.feed.map(|feed| feed * speed.abs() / TAU)
            }
        }
    }
}
