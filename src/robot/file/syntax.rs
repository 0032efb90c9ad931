//! Where in a robot file something stands, and what its syntax breaks.

use crate::ground::problem::{Problem, line_of};

/// What the TOML reader refuses, with line and key.
pub(super) fn syntax(text: &str, error: &toml::de::Error) -> Problem {
    let what = error.message().lines().collect::<Vec<_>>().join("; ");
    let problem = Problem::new(
        what,
        "compare with `ident robot convert kr210`, a complete robot file; every key carries its unit",
    );
    let Some(span) = error.span() else {
        return problem;
    };
    let problem = problem.at_line(line_of(text.as_bytes(), span.start));
    match key_before(text, span.start) {
        Some(key) => problem.in_column(key),
        None => problem,
    }
}

/// The key whose value stands at a byte offset: the word before the last `=` on that line.
fn key_before(text: &str, offset: usize) -> Option<&str> {
    let line = text.get(..offset)?.rsplit('\n').next()?;
    let key = line.rsplit_once('=')?.0.trim_end();
    let word = key
        .rsplit(|c: char| !(c.is_alphanumeric() || c == '_' || c == '-'))
        .next()?;
    (!word.is_empty()).then_some(word)
}
