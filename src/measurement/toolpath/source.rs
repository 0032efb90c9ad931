//! The text of a path file: decoded, line by line.

use crate::ground::files::{read_bytes, sha256};
use crate::ground::problem::{Outcome, Problem, line_of};
use std::path::{Path, PathBuf};

/// A path file as text.
#[derive(Debug, Clone)]
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) sha256: String,
    pub(super) bytes: Vec<u8>,
}

/// Largest file, bytes.
const LARGEST: u64 = 1 << 30;

impl Source {
    pub(super) fn read(path: &Path) -> Outcome<Self> {
        let size = std::fs::metadata(path).map_or(0, |data| data.len());
        if size > LARGEST {
            let what = format!("has {} MB", size >> 20);
            let problem = Problem::new(what, "split it: a path file may have 1024 MB");
            return Err(problem.in_file(path));
        }
        Ok(Self::of_bytes(path, read_bytes(path)?))
    }

    pub(super) fn of_bytes(path: &Path, bytes: Vec<u8>) -> Self {
        Self {
            path: path.to_path_buf(),
            sha256: sha256(&bytes),
            bytes,
        }
    }

    /// The text. Bytes that are not UTF-8 (comments in an older code page) become replacement
    /// characters.
    ///
    /// # Errors
    /// A binary file.
    pub(super) fn text(&self) -> Outcome<String> {
        let bytes = self
            .bytes
            .strip_prefix(b"\xEF\xBB\xBF")
            .unwrap_or(&self.bytes);
        match bytes.iter().position(|byte| *byte == 0) {
            None => Ok(String::from_utf8_lossy(bytes).into_owned()),
            Some(at) => {
                let line = line_of(bytes, at);
                let remedy = "give the path as text: CSV, CLS/APT, G-code or KRL, in UTF-8";
                Err(Problem::new("is a binary file", remedy).at_line(line))
            }
        }
    }
}

/// Whether any line starts with one of these words, in letters of either size.
pub(super) fn any_line_starts(text: &str, words: &[&str]) -> bool {
    let mut lines = text.lines().map(|line| line.trim_start().to_uppercase());
    lines.any(|line| words.iter().any(|word| line.starts_with(word)))
}

/// The lines of a text with their 1-based numbers; line ends of all three kinds.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let ends = match text.contains('\n') {
        true => '\n',
        false => '\r',
    };
    let lines = text.split(ends).map(|line| line.trim_end_matches('\r'));
    lines.enumerate().map(|(i, line)| (i + 1, line))
}

/// A finite number as programs write it: `-.5`, `5.`, `+1e-3`; nothing else.
pub(super) fn number(word: &str) -> Option<f64> {
    let plain = |b: u8| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E');
    if word.is_empty() || !word.bytes().all(plain) {
        return None;
    }
    word.parse::<f64>().ok().filter(|x| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_every_end_are_numbered() {
        for text in ["a\nb\nc", "a\r\nb\r\nc", "a\rb\rc"] {
            let all: Vec<_> = lines(text).collect();
            assert_eq!(all, [(1, "a"), (2, "b"), (3, "c")]);
        }
    }

    #[test]
    fn numbers_are_only_numbers() {
        assert_eq!(
            (number("-.5"), number("5."), number("+1E2")),
            (Some(-0.5), Some(5.0), Some(100.0))
        );
        for word in ["", "nan", "inf", "1e999", "1,5", "0x1", "1_0", ".", "-"] {
            assert_eq!(number(word), None, "{word}");
        }
    }
}
