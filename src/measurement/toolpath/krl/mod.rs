//! KRL (`.src`, with its `.dat` beside it): the robot programs of KUKA, as far as they are paths.
//!
//! Lines, circles, velocities, approximation distances and frames are run; motions of the axes are
//! passed over; what depends on the state of a controller (conditions, loops) is refused.

mod assign;
mod motion;
mod program;
mod scan;
mod value;

use super::draft::Draft;
use super::source::{Source, any_line_starts};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::V3;
use motion::Verb;
use program::{Library, Statement};
use scan::{head_of, inner};
use std::collections::BTreeMap;
use value::Value;

/// Opens the fold in which rapid motions stand: KRL has no word for them.
pub const RAPID_FOLD: &str = ";FOLD RAPID";
/// Closes a fold.
pub const END_FOLD: &str = ";ENDFOLD";

pub(super) fn recognises(head: &str) -> bool {
    any_line_starts(
        head,
        &["DEF ", "&ACCESS", "LIN {", "PTP ", "$BASE", "GLOBAL DEF "],
    )
}

pub(super) fn read(source: &Source) -> Outcome<Draft> {
    let mut state = State::default();
    let mut library = Library::of(source, &mut state.draft.inputs)?;
    for statement in library.data() {
        state.declare(&statement)?;
    }
    state.run(&mut library, program::MAIN, 0)?;
    Ok(state.draft)
}

/// What holds until it is changed.
#[derive(Default)]
struct State {
    draft: Draft,
    variables: BTreeMap<String, Value>,
    /// `$VEL.CP`, m/s.
    feed: Option<f64>,
    /// `$APO.CDIS`, m.
    blend: Option<f64>,
    /// `$BASE` and `$TOOL` as they were set: what they are called, to see a change.
    base: Option<String>,
    tool: Option<String>,
    /// A, B, C of the last point, rad.
    angles: V3,
    /// Where the tip is cannot be told: the axes were moved.
    lost: bool,
    /// `$ORI_TYPE = #CONSTANT`.
    held: bool,
    /// Within the fold of rapid motions.
    rapid: bool,
    executed: usize,
}

/// How deep programs may call each other.
const DEEPEST: usize = 16;
/// Most statements that are run.
const LONGEST: usize = 30_000_000;

/// Statements that depend on a state nobody knows here.
const CONTROL: &[&str] = &[
    "IF",
    "ELSE",
    "ENDIF",
    "FOR",
    "ENDFOR",
    "WHILE",
    "ENDWHILE",
    "REPEAT",
    "UNTIL",
    "LOOP",
    "ENDLOOP",
    "SWITCH",
    "CASE",
    "DEFAULT",
    "ENDSWITCH",
    "GOTO",
    "EXIT",
    "SPLINE",
    "ENDSPLINE",
    "SPL",
    "BRAKE",
    "RESUME",
    "PTP_SPLINE",
];

/// Statements without effect on the path.
const IDLE: &[&str] = &[
    "WAIT",
    "HALT",
    "PULSE",
    "TRIGGER",
    "INTERRUPT",
    "GLOBAL",
    "CONTINUE",
    "SIGNAL",
    "EXT",
    "EXTFCT",
    "EXTFCTP",
    "ENUM",
    "STRUC",
    "IMPORT",
    "ANIN",
    "ANOUT",
    "CWRITE",
    "CREAD",
    "CIOCTL",
    "DECL",
    "ON_ERROR_PROCEED",
];

impl State {
    /// Runs a routine.
    fn run(&mut self, library: &mut Library, name: &str, depth: usize) -> Outcome<()> {
        let routine = library.routine(name, &mut self.draft.inputs)?;
        for statement in routine.statements() {
            self.executed += 1;
            let place = |problem: Problem| problem.at_line(statement.line).in_file(&routine.file);
            if depth > DEEPEST || self.executed > LONGEST {
                let remedy = "call programs without recursion, or split the path";
                return Err(place(Problem::new(
                    "programs call each other without end",
                    remedy,
                )));
            }
            if statement.upper == "RETURN" {
                break;
            }
            match self.take(&statement).map_err(place)? {
                None => {}
                Some(call) if library.knows(&call) => self.run(library, &call, depth + 1)?,
                Some(call) => {
                    let remedy = format!(
                        "put {call}.src beside the program, or take the call out if it does not move the robot"
                    );
                    return Err(place(Problem::new(
                        format!("what `{call}` does is not known"),
                        remedy,
                    )));
                }
            }
        }
        Ok(())
    }

    /// Takes one statement; the name of the program if it is a call.
    fn take(&mut self, statement: &Statement) -> Outcome<Option<String>> {
        let text = statement.upper.as_str();
        let (word, rest) = head_of(text);
        if text.starts_with(';') {
            self.rapid = text == RAPID_FOLD;
        } else if let Some(verb) = Verb::of(word) {
            self.motion(verb, word, rest, statement.line)?;
        } else if CONTROL.contains(&word) || text.ends_with(':') {
            return Err(control(word));
        } else if self.declaration(text)? {
        } else if IDLE.contains(&word) {
            self.draft.pass_over(word, statement.line);
        } else if rest.trim_start().starts_with(['=', '.', '[']) {
            self.assignment(text, statement.line)?;
        } else if word == "BAS" {
            self.bas(&inner(rest), statement.line)?;
        } else if rest.trim_start().starts_with('(') {
            return Ok(Some(head_of(&statement.raw).0.to_string()));
        } else {
            let remedy = "a path is written with LIN, CIRC, SLIN, frames, $VEL.CP and $APO.CDIS";
            return Err(Problem::new(
                format!("`{}` is not understood", shown(word)),
                remedy,
            ));
        }
        Ok(None)
    }
}

fn shown(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(32).collect()
}

fn control(word: &str) -> Problem {
    Problem::new(
        format!(
            "`{}` makes a path that depends on the controller",
            shown(word)
        ),
        "write the motions one after the other, without conditions, loops, jumps and splines",
    )
}
