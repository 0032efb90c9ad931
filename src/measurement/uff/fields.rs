//! Fixed-width fields of a record.

use crate::ground::problem::{Outcome, Problem};

/// One record: a line without its end, and its 1-based number in the file.
#[derive(Debug, Clone, Copy)]
pub struct Record<'a> {
    /// The bytes of the line.
    pub bytes: &'a [u8],
    /// Its number.
    pub line: usize,
}

impl Record<'_> {
    /// The line as text: UTF-8 if it is, else Latin-1.
    pub fn text(&self) -> String {
        let latin = || self.bytes.iter().map(|b| char::from(*b)).collect();
        std::str::from_utf8(self.bytes).map_or_else(|_| latin(), String::from)
    }

    /// Columns `from..to` (characters, from 0), without the blanks around.
    pub fn field(&self, from: usize, to: usize) -> String {
        let part: String = self.text().chars().skip(from).take(to - from).collect();
        part.trim().to_string()
    }

    /// A whole number in columns `from..to`; blank is 0.
    pub fn integer(&self, from: usize, to: usize) -> Outcome<i64> {
        let field = self.field(from, to);
        if field.is_empty() {
            return Ok(0);
        }
        field
            .parse()
            .map_err(|_| self.refuse(&field, "a whole number"))
    }

    /// A number in columns `from..to`; blank is 0.
    pub fn number(&self, from: usize, to: usize) -> Outcome<f64> {
        let field = self.field(from, to);
        if field.is_empty() {
            return Ok(0.0);
        }
        number(field.as_bytes()).ok_or_else(|| self.refuse(&field, "a number"))
    }

    fn refuse(&self, field: &str, wanted: &str) -> Problem {
        Problem::new(
            format!("`{field}` is not {wanted}"),
            "export again: the columns of this record are not those of a universal file",
        )
        .at_line(self.line)
    }
}

/// A FORTRAN number: exponent letter E or D, or none before a signed exponent.
pub fn number(field: &[u8]) -> Option<f64> {
    let field = field.trim_ascii();
    let field = field.strip_prefix(b"+").unwrap_or(field);
    if let Ok(value) = fast_float2::parse(field) {
        return Some(value);
    }
    let mut text: Vec<u8> = field.to_vec();
    if let Some(letter) = text.iter_mut().find(|b| matches!(b, b'D' | b'd')) {
        *letter = b'E';
    } else {
        let sign = (1..text.len()).rfind(|i| matches!(text[*i], b'+' | b'-'))?;
        text.insert(sign, b'E');
    }
    fast_float2::parse(text).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fortran_numbers() {
        let cases = [
            ("1.5D+01", 15.0),
            (" -2.5E-001 ", -0.25),
            ("1.0-100", 1e-100),
            ("+3", 3.0),
        ];
        for (text, value) in cases {
            assert_eq!(number(text.as_bytes()), Some(value));
        }
        for text in ["", "x", "-", "1.2.3", "1E", "--1"] {
            assert_eq!(number(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn counts_characters_not_bytes() {
        let record = Record {
            bytes: "a²cd".as_bytes(),
            line: 1,
        };
        assert_eq!(record.field(2, 3), "c");
        let latin = Record {
            bytes: b"a\xb2cd",
            line: 1,
        };
        assert_eq!(latin.field(1, 3), "²c");
    }
}
