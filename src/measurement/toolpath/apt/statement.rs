//! Statements of APT: a word, a slash, arguments; `$` goes on in the next line, `$$` is a comment.

use super::super::source::{lines, number};
use crate::ground::problem::{Outcome, Problem};

/// One statement, in upper case.
#[derive(Debug)]
pub(super) struct Statement {
    /// 1-based line on which it begins.
    pub(super) line: usize,
    /// What stands before the slash: `GOTO`, `TOOL PATH`, `TLON,GOFWD`.
    pub(super) word: String,
    /// What stands behind it.
    pub(super) arguments: String,
}

/// Longest statement, bytes.
const LONGEST: usize = 1 << 16;

/// Words whose rest of the line is text.
const TEXTS: &[&str] = &[
    "PARTNO", "PPRINT", "REMARK", "INSERT", "TPRINT", "TITLES", "DISPLY", "LETTER", "PROGRAM",
];

/// The statements of a text.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Outcome<Statement>> + '_ {
    let mut lines = lines(text);
    std::iter::from_fn(move || {
        loop {
            let (line, first) = lines.next()?;
            let (mut joined, mut more) = part(first);
            while more && joined.len() <= LONGEST {
                let Some((_, next)) = lines.next() else {
                    break;
                };
                let (rest, again) = part(next);
                joined.push_str(&rest);
                more = again;
            }
            if joined.len() > LONGEST {
                let what = "is a statement without end";
                let problem =
                    Problem::new(what, "is it APT? `$` at the end of a line continues it");
                return Some(Err(problem.at_line(line)));
            }
            if !joined.trim().is_empty() {
                return Some(Ok(Statement::of(&joined, line)));
            }
        }
    })
}

/// The part of a line that counts, in upper case, and whether the statement goes on.
fn part(line: &str) -> (String, bool) {
    let short: String = line.chars().take(LONGEST + 1).collect();
    let upper = short.to_uppercase();
    let start = upper.trim_start();
    if TEXTS.iter().any(|word| start.starts_with(word)) {
        return (upper, false);
    }
    match upper.split_once('$') {
        None => (upper, false),
        Some((before, after)) => (before.to_string(), !after.starts_with('$')),
    }
}

impl Statement {
    fn of(text: &str, line: usize) -> Self {
        let text = text.trim();
        let word_of = |w: &str| w.split_whitespace().collect::<Vec<_>>().join(" ");
        let is_text = TEXTS.iter().find(|word| text.starts_with(*word));
        let (word, arguments) = match (is_text, text.split_once('/')) {
            (Some(word), _) => (word.to_string(), ""),
            (None, Some((word, arguments))) => (word_of(word), arguments),
            (None, None) => (word_of(text), ""),
        };
        Self {
            line,
            word,
            arguments: arguments.trim().to_string(),
        }
    }

    /// All arguments, which must be numbers.
    pub(super) fn numbers(&self) -> Outcome<Vec<f64>> {
        numbers(&self.arguments)
    }

    fn fields(&self) -> impl Iterator<Item = &str> {
        self.arguments
            .split(',')
            .map(str::trim)
            .filter(|field| !field.is_empty())
    }

    /// The arguments that are no numbers.
    pub(super) fn words(&self) -> Vec<&str> {
        self.fields()
            .filter(|field| number(field).is_none())
            .collect()
    }

    pub(super) fn says(&self, word: &str) -> bool {
        self.fields().any(|field| field == word)
    }

    pub(super) fn has_number(&self) -> bool {
        self.fields().any(|field| number(field).is_some())
    }

    /// How many arguments are numbers.
    pub(super) fn count_numbers(&self) -> usize {
        self.fields()
            .filter(|field| number(field).is_some())
            .count()
    }

    /// The first number.
    pub(super) fn one_number(&self) -> Outcome<f64> {
        let found = self.fields().find_map(number);
        found.ok_or_else(|| Problem::new("has no number", "write the value behind the slash"))
    }

    /// What to say of a statement that would change the path.
    pub(super) fn refused(&self) -> Problem {
        let shown: String = self.word.chars().take(32).collect();
        Problem::new(
            format!("`{shown}` would change the path and is not understood"),
            "post the path as GOTO and CIRCLE, without cycles, loops, offsets and transformations",
        )
    }
}

/// Numbers between commas, all of them.
pub(super) fn numbers(text: &str) -> Outcome<Vec<f64>> {
    let fields = text.split(',').map(str::trim);
    let parsed = fields.map(|field| number(field).ok_or(field));
    parsed.collect::<Result<Vec<f64>, &str>>().map_err(|field| {
        let shown: String = field.chars().filter(|c| !c.is_control()).take(24).collect();
        let remedy = "write points as numbers; points by name are not looked up";
        Problem::new(format!("`{shown}` is not a number"), remedy)
    })
}
