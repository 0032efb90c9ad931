//! A problem the user can act on: what is wrong, where, and the remedy.

use std::fmt;
use std::path::{Path, PathBuf};

/// Something `ident` refuses, with place and remedy. Every error of the program is one of these:
/// a message without a remedy is not finished.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// What is wrong, one clause, lower case.
    pub what: String,
    /// The file it was found in.
    pub file: Option<PathBuf>,
    /// 1-based line in that file.
    pub line: Option<usize>,
    /// Name of the column or key.
    pub column: Option<String>,
    /// What to do about it, imperative.
    pub remedy: String,
}

/// Result of anything that can be refused.
pub type Outcome<T> = Result<T, Problem>;

impl Problem {
    /// A problem with its remedy, so far without a place.
    pub fn new(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            file: None,
            line: None,
            column: None,
            remedy: remedy.into(),
        }
    }

    /// The same problem, found in `file` (an inner place already set is kept).
    #[must_use]
    pub fn in_file(mut self, file: &Path) -> Self {
        self.file.get_or_insert_with(|| file.to_path_buf());
        self
    }

    /// The same problem, found in the text of `file`: in its first line where no closer place is known.
    #[must_use]
    pub fn in_text(self, file: &Path) -> Self {
        match self.file.is_some() {
            true => self,
            false => self.at_line(1).in_file(file),
        }
    }

    /// The same problem, found where `file` sets `key`: in its first line where it does not.
    #[must_use]
    pub fn at_key(self, file: &Path, key: &str) -> Self {
        match self.file.is_some() {
            true => self,
            false => {
                let line = super::files::line_setting(file, key);
                self.in_column(key).at_line(line).in_file(file)
            }
        }
    }

    /// The same problem, found in 1-based `line`.
    #[must_use]
    pub fn at_line(mut self, line: usize) -> Self {
        self.line.get_or_insert(line);
        self
    }

    /// The same problem, found in the column or key `name`.
    #[must_use]
    pub fn in_column(mut self, name: impl Into<String>) -> Self {
        self.column.get_or_insert_with(|| name.into());
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}:", file.display())?;
            if let Some(line) = self.line {
                write!(f, "{line}:")?;
            }
            write!(f, " ")?;
        } else if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        if let Some(column) = &self.column {
            write!(f, "`{column}`: ")?;
        }
        write!(f, "{}\n  help: {}", self.what, self.remedy)
    }
}

impl std::error::Error for Problem {}

/// 1-based line of a byte offset.
pub fn line_of(text: &[u8], offset: usize) -> usize {
    let before = text.iter().take(offset);
    1 + before.filter(|byte| **byte == b'\n').count()
}

/// 1-based line at which a text is no TOML: the first where none is known.
pub fn line_of_toml(text: &str, error: &toml::de::Error) -> usize {
    error
        .span()
        .map_or(1, |span| line_of(text.as_bytes(), span.start))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_file_line_column_and_remedy() {
        let problem = Problem::new("not a number", "write 1.5")
            .at_line(7)
            .in_column("force_N")
            .in_file(Path::new("a.csv"));
        let text = problem.to_string();
        assert_eq!(text, "a.csv:7: `force_N`: not a number\n  help: write 1.5");
    }
}
