//! Questions out at one end, answers in at the other.

use crate::ground::problem::{Outcome, Problem};
use std::io::{BufRead, Write};

/// How often an answer that cannot be is asked for again.
const TRIES: usize = 3;

/// Who answers: questions go out at one end, answers come in at the other.
pub struct Talk<'a> {
    answers: &'a mut dyn BufRead,
    questions: &'a mut dyn Write,
}

impl<'a> Talk<'a> {
    /// With these two ends.
    pub fn new(answers: &'a mut dyn BufRead, questions: &'a mut dyn Write) -> Self {
        Self { answers, questions }
    }

    /// Says something.
    pub(super) fn say(&mut self, text: &str) -> Outcome<()> {
        let written = self.questions.write_all(text.as_bytes());
        written
            .and_then(|()| self.questions.flush())
            .map_err(|e| cut(&e))
    }

    /// An answer that `right` takes; `None` where the answer is empty or the input ends.
    pub(super) fn ask<T>(
        &mut self,
        question: &str,
        right: impl Fn(&str) -> Outcome<T>,
    ) -> Outcome<Option<T>> {
        for _ in 0..TRIES {
            self.say(&format!("{question}: "))?;
            let mut line = String::new();
            self.answers.read_line(&mut line).map_err(|e| cut(&e))?;
            let answer = line.trim();
            if answer.is_empty() {
                return Ok(None);
            }
            match right(answer) {
                Ok(taken) => return Ok(Some(taken)),
                Err(problem) => self.say(&format!("  {}: {}\n", problem.what, problem.remedy))?,
            }
        }
        Ok(None)
    }
}

fn cut(error: &std::io::Error) -> Problem {
    let remedy = "give the facts with --kind, --column and --fact";
    Problem::new(format!("the terminal does not answer ({error})"), remedy)
}
