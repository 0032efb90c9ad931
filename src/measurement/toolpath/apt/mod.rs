//! APT and CL source (Siemens NX `.cls`, CATIA `.aptsource`, Creo `.ncl`; ISO 3592, ISO 4343).

mod circle;
mod feed;
mod statement;
mod words;

use super::draft::Draft;
use super::points::axis;
use super::shape::Arc;
use super::source::{Source, any_line_starts};
use super::{Move, Orientation, Shape};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::{V3, add, scale};
use circle::{Circle, tangent_circle};
use statement::{Statement, statements};
use std::f64::consts::TAU;
use words::{Kind, kind_of};

pub(super) fn recognises(head: &str) -> bool {
    any_line_starts(
        head,
        &["GOTO/", "GOTO /", "FEDRAT", "PARTNO", "TOOL PATH", "$$"],
    )
}

pub(super) fn read(source: &Source) -> Outcome<Draft> {
    let text = source.text()?;
    let mut state = State::default();
    for statement in statements(&text) {
        let statement = statement?;
        let line = statement.line;
        state
            .take(&statement)
            .map_err(|problem| problem.at_line(line))?;
        if state.finished {
            break;
        }
    }
    Ok(state.draft)
}

/// What holds until it is changed.
struct State {
    draft: Draft,
    /// m per unit of the file.
    unit: f64,
    axis: V3,
    feed: Option<f64>,
    /// Feed per revolution, m: it becomes a feed once the spindle turns.
    per_turn: Option<f64>,
    spindle: Option<f64>,
    rapid: bool,
    circle: Option<Circle>,
    /// Direction of INDIRV, for the next circle of TLON.
    direction: Option<V3>,
    /// Numbers of MSYS: the frame of the part, which must stay one.
    frame: Option<Vec<f64>>,
    finished: bool,
}

impl Default for State {
    fn default() -> Self {
        Self {
            draft: Draft::default(),
            unit: 1e-3,
            axis: [0.0, 0.0, 1.0],
            feed: None,
            per_turn: None,
            spindle: None,
            rapid: false,
            circle: None,
            direction: None,
            frame: None,
            finished: false,
        }
    }
}

impl State {
    fn take(&mut self, statement: &Statement) -> Outcome<()> {
        match kind_of(statement) {
            Kind::PassedOver => self.draft.pass_over(&statement.word, statement.line),
            Kind::Refused => return Err(statement.refused()),
            Kind::Goto => {
                let numbers = statement.numbers()?;
                let to = self.point(&numbers)?;
                self.turn(&numbers)?;
                self.go(to, statement.line)?;
            }
            Kind::From => self.from(statement)?,
            Kind::Home if statement.arguments.is_empty() => {
                self.draft.pass_over(&statement.word, statement.line)
            }
            Kind::Home => {
                let to = self.point(&statement.numbers()?)?;
                self.rapid = true;
                self.go(to, statement.line)?;
            }
            Kind::Delta => self.delta(statement)?,
            Kind::Rapid => self.rapid = true,
            Kind::Feed => self.feed_rate(statement)?,
            Kind::Spindle => self.spindle(statement)?,
            Kind::Circle => self.circle = Some(Circle::of(&statement.numbers()?, self.unit)?),
            Kind::Direction => self.direction = Some(vector(&statement.numbers()?)?),
            Kind::Tangent => self.tangent(statement)?,
            Kind::Units => self.units(statement)?,
            Kind::Axis => self.axis = axis(vector(&statement.numbers()?)?)?,
            Kind::Frame => self.one_frame(statement)?,
            Kind::End => {
                self.draft.pass_over(&statement.word, statement.line);
                self.finished = true;
            }
        }
        Ok(())
    }

    fn point(&self, numbers: &[f64]) -> Outcome<V3> {
        match numbers {
            [x, y, z] | [x, y, z, _, _, _] => Ok([x, y, z].map(|x| x * self.unit)),
            _ => Err(Problem::new(
                format!("has {} numbers", numbers.len()),
                "write a point as x,y,z or x,y,z,i,j,k",
            )),
        }
    }

    fn turn(&mut self, numbers: &[f64]) -> Outcome<()> {
        if let [_, _, _, i, j, k] = numbers {
            self.axis = axis([*i, *j, *k])?;
        }
        Ok(())
    }

    fn from(&mut self, statement: &Statement) -> Outcome<()> {
        let numbers = statement.numbers()?;
        let to = self.point(&numbers)?;
        self.turn(&numbers)?;
        match self.draft.here() {
            None => self.go(to, statement.line),
            Some(here) if here == to => {
                self.draft.pass_over(&statement.word, statement.line);
                Ok(())
            }
            Some(_) => Err(Problem::new(
                "FROM stands elsewhere than where the path has come to",
                "write RAPID and GOTO for the way there, or split the file",
            )),
        }
    }

    fn delta(&mut self, statement: &Statement) -> Outcome<()> {
        let here = self.draft.here().ok_or_else(|| {
            Problem::new(
                "GODLTA stands before the first point",
                "begin with FROM or GOTO",
            )
        })?;
        let step = match statement.numbers()?.as_slice() {
            [along] => scale(along * self.unit, self.axis),
            [x, y, z] => [x, y, z].map(|x| x * self.unit),
            other => {
                let what = format!("has {} numbers", other.len());
                return Err(Problem::new(
                    what,
                    "write dx,dy,dz or the way along the tool axis",
                ));
            }
        };
        self.go(add(here, step), statement.line)
    }

    /// A motion, along the circle in force if the point lies on it.
    fn go(&mut self, to: V3, line: usize) -> Outcome<()> {
        let shape = self.shape(to)?;
        let first = self.draft.moves.is_empty();
        let rapid = std::mem::take(&mut self.rapid);
        self.draft.push(Move {
            shape,
            rapid: rapid && !first,
            feed: self.feed().filter(|_| !rapid && !first),
            spindle: self.spindle,
            ..Move::line(to, Orientation::Axis(self.axis), line)
        })
    }

    fn shape(&mut self, to: V3) -> Outcome<Shape> {
        let Some(mut circle) = self.circle.take() else {
            return Ok(Shape::Line);
        };
        let from = self.draft.here().ok_or_else(|| {
            Problem::new(
                "CIRCLE stands before the first point",
                "begin with FROM or GOTO",
            )
        })?;
        let arc = match self.rapid {
            true => None,
            false => circle.arc(from, to)?,
        };
        let Some(arc) = arc else {
            return Ok(Shape::Line);
        };
        self.circle = circle.after(&arc);
        Ok(Shape::Arc(arc))
    }

    fn spindle(&mut self, statement: &Statement) -> Outcome<()> {
        if statement.says("OFF") {
            self.spindle = Some(0.0);
        } else if statement.has_number() && !statement.says("SFM") && !statement.says("SMM") {
            let speed = statement.one_number()? / 60.0 * TAU;
            let reversed = statement.says("CCLW") || statement.says("CCW");
            self.spindle = Some(if reversed { -speed } else { speed });
        } else {
            self.draft.pass_over(&statement.word, statement.line);
        }
        Ok(())
    }

    fn tangent(&mut self, statement: &Statement) -> Outcome<()> {
        let direction = self.direction.take().ok_or_else(|| {
            Problem::new(
                "TLON without a direction",
                "write INDIRV/ before each TLON circle",
            )
        })?;
        let from = self.draft.here().ok_or_else(|| {
            Problem::new(
                "TLON stands before the first point",
                "begin with FROM or GOTO",
            )
        })?;
        let (to, arc): (V3, Arc) =
            tangent_circle(statement, from, direction, self.axis, self.unit)?;
        self.circle = None;
        let rapid = std::mem::take(&mut self.rapid);
        self.draft.push(Move {
            shape: Shape::Arc(arc),
            rapid,
            feed: self.feed().filter(|_| !rapid),
            spindle: self.spindle,
            ..Move::line(to, Orientation::Axis(self.axis), statement.line)
        })
    }

    fn units(&mut self, statement: &Statement) -> Outcome<()> {
        let word = statement.words().first().copied().unwrap_or_default();
        let unit = LENGTHS.iter().find(|(known, _)| *known == word);
        let unit = unit.ok_or_else(|| {
            Problem::new(
                format!("`{word}` is no unit that is known"),
                "write UNITS/MM or UNITS/INCHES",
            )
        })?;
        if unit.1 != self.unit && !self.draft.moves.is_empty() {
            let remedy = "state UNITS once, before the first point";
            return Err(Problem::new("the unit changes within the path", remedy));
        }
        self.unit = unit.1;
        Ok(())
    }

    /// A frame of the part: one is what the job places; a second one would move the path.
    fn one_frame(&mut self, statement: &Statement) -> Outcome<()> {
        let numbers = statement.numbers().unwrap_or_default();
        match &self.frame {
            Some(frame) if *frame != numbers && !self.draft.moves.is_empty() => Err(Problem::new(
                "a second coordinate system begins within the path",
                "post each coordinate system into a file and a job of its own",
            )),
            _ => {
                self.draft.pass_over(&statement.word, statement.line);
                self.frame = Some(numbers);
                Ok(())
            }
        }
    }
}

/// Units of length, in m.
const LENGTHS: &[(&str, f64)] = &[
    ("MM", 1e-3),
    ("CM", 1e-2),
    ("M", 1.0),
    ("METERS", 1.0),
    ("IN", 0.0254),
    ("INCH", 0.0254),
    ("INCHES", 0.0254),
];

fn vector(numbers: &[f64]) -> Outcome<V3> {
    let vector = V3::try_from(numbers).ok();
    vector.ok_or_else(|| Problem::new("has not three numbers", "write i,j,k"))
}
