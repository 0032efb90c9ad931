//! A TOML file read key by key: everything knows its line, and an unknown key is refused with the
//! nearest known one.

mod lists;
#[cfg(test)]
mod tests;

use crate::ground::nearest::nearest;
use crate::ground::problem::{Outcome, Problem, line_of, line_of_toml};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Magnitudes beyond which a number is a slip: products of such numbers stay numbers.
const SMALLEST: f64 = 1e-30;
const LARGEST: f64 = 1e30;

/// A TOML document: its text, and its tables with their places.
#[derive(Debug)]
pub struct Document<'a> {
    text: &'a str,
    root: Spanned<DeTable<'a>>,
}

impl<'a> Document<'a> {
    /// Parses a text.
    ///
    /// # Errors
    /// What is no TOML, with its line.
    pub fn parse(text: &'a str) -> Outcome<Self> {
        let root = DeTable::parse(text).map_err(|error| {
            let what = format!("is not TOML: {}", first_line(error.message()));
            let remedy =
                "write `key = value` lines under `[table]` headings, texts in double quotes";
            Problem::new(what, remedy).at_line(line_of_toml(text, &error))
        })?;
        Ok(Self { text, root })
    }

    /// The keys outside of all tables, which must be among `known`.
    ///
    /// # Errors
    /// An unknown key, with its line.
    pub fn keys<'b>(&'b self, known: &[&str]) -> Outcome<Keys<'b>> {
        Keys::of(self.text, self.root.get_ref(), String::new(), 1, known)
    }
}

fn first_line(message: &str) -> &str {
    message.lines().next().unwrap_or_default().trim()
}

/// The keys of one table.
#[derive(Debug, Clone)]
pub struct Keys<'a> {
    text: &'a str,
    table: &'a DeTable<'a>,
    /// `tool.` for a table, empty for the root: what messages put before a key.
    prefix: String,
    line: usize,
}

impl<'a> Keys<'a> {
    fn of(
        text: &'a str,
        table: &'a DeTable<'a>,
        prefix: String,
        line: usize,
        known: &[&str],
    ) -> Outcome<Self> {
        for key in table.keys() {
            let word = key.get_ref().as_ref();
            if !known.contains(&word) {
                let problem = unknown(word, known).in_column(format!("{prefix}{word}"));
                return Err(problem.at_line(line_of(text.as_bytes(), key.span().start)));
            }
        }
        Ok(Self {
            text,
            table,
            prefix,
            line,
        })
    }

    fn get(&self, key: &str) -> Option<&'a DeValue<'a>> {
        let found = self.table.get(key);
        found.map(Spanned::get_ref)
    }

    /// 1-based line of a key, or of the table if the key is not there.
    pub fn line_of(&self, key: &str) -> usize {
        let found = self.table.get_key_value(key);
        found.map_or(self.line, |(key, _)| {
            line_of(self.text.as_bytes(), key.span().start)
        })
    }

    /// Whether the key is there.
    pub fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// A problem with a key, placed on its line.
    pub fn problem(
        &self,
        key: &str,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Problem {
        Problem::new(what, remedy)
            .in_column(format!("{}{key}", self.prefix))
            .at_line(self.line_of(key))
    }

    /// A missing key: `example` shows how to write it.
    pub fn missing(&self, key: &str, example: &str) -> Problem {
        self.problem(key, "is missing", format!("add `{example}`"))
    }

    fn wrong_type(&self, key: &str, value: &DeValue<'_>, wanted: &str, example: &str) -> Problem {
        let what = format!("is {} instead of {wanted}", value.type_str());
        self.problem(key, what, format!("write `{key} = {example}`"))
    }

    /// A finite number, if given.
    ///
    /// # Errors
    /// Another type, a number that is not finite or absurdly large.
    pub fn number(&self, key: &str) -> Outcome<Option<f64>> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        let number =
            number_of(value).ok_or_else(|| self.wrong_type(key, value, "a number", "1.5"))?;
        self.finite(key, number).map(Some)
    }

    fn finite(&self, key: &str, number: f64) -> Outcome<f64> {
        if number == 0.0 || (SMALLEST..=LARGEST).contains(&number.abs()) {
            return Ok(number);
        }
        let what = match number.is_finite() {
            true => format!("is {number:e}, which nobody means"),
            false => "is not finite".into(),
        };
        Err(self.problem(key, what, "give a finite number, or leave the key out"))
    }

    /// A number above zero, if given.
    ///
    /// # Errors
    /// As [`Keys::number`], and zero or less.
    pub fn positive(&self, key: &str) -> Outcome<Option<f64>> {
        let remedy = "give a value above zero, or leave the key out";
        self.judged(key, |x| x > 0.0, "not above zero", remedy)
    }

    /// A number at or above zero, if given.
    ///
    /// # Errors
    /// As [`Keys::number`], and less than zero.
    pub fn not_negative(&self, key: &str) -> Outcome<Option<f64>> {
        self.judged(key, |x| x >= 0.0, "below zero", "give zero or more")
    }

    /// A number that is `right`, if given.
    ///
    /// # Errors
    /// As [`Keys::number`], and a number that is not right: it `is`, and `remedy` mends it.
    pub fn judged(
        &self,
        key: &str,
        right: impl Fn(f64) -> bool,
        is: &str,
        remedy: &str,
    ) -> Outcome<Option<f64>> {
        match self.number(key)? {
            Some(x) if !right(x) => Err(self.problem(key, format!("is {x}, {is}"), remedy)),
            other => Ok(other),
        }
    }

    /// A whole number from `least`, if given.
    ///
    /// # Errors
    /// As [`Keys::number`], fractions, and less than `least` or more than a million.
    pub fn count(&self, key: &str, least: usize) -> Outcome<Option<usize>> {
        let right = |x: f64| x.fract() == 0.0 && x >= least as f64 && x <= 1e6;
        let is = format!("no whole number from {least}");
        let remedy = format!("write a whole number, {least} or more");
        let number = self.judged(key, right, &is, &remedy)?;
        Ok(number.map(|x| x as usize))
    }

    /// A text, if given.
    ///
    /// # Errors
    /// Another type.
    pub fn text(&self, key: &str) -> Outcome<Option<&'a str>> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        let text = value.as_str();
        let text = text.ok_or_else(|| self.wrong_type(key, value, "a text", "\"...\""));
        text.map(Some)
    }

    /// A text that is not empty and may be a file name, if given.
    ///
    /// # Errors
    /// Another type, an empty text, a control character.
    pub fn name(&self, key: &str) -> Outcome<Option<&'a str>> {
        match self.text(key)? {
            Some(name) if name.trim().is_empty() || name.contains(char::is_control) => {
                Err(self.problem(key, "names nothing", "write the name in double quotes"))
            }
            other => Ok(other),
        }
    }

    /// One of a few words, if given: its meaning.
    ///
    /// # Errors
    /// Another type or word.
    pub fn choice<T: Copy>(&self, key: &str, words: &[(&str, T)]) -> Outcome<Option<T>> {
        let Some(word) = self.text(key)? else {
            return Ok(None);
        };
        let found = words.iter().find(|(known, _)| *known == word);
        found.map(|(_, meaning)| Some(*meaning)).ok_or_else(|| {
            let known: Vec<String> = words.iter().map(|(w, _)| format!("\"{w}\"")).collect();
            let what = format!("is \"{word}\", which means nothing here");
            self.problem(key, what, format!("write one of {}", known.join(", ")))
        })
    }

    /// True or false; false if left out.
    ///
    /// # Errors
    /// Another type.
    pub fn flag(&self, key: &str) -> Outcome<bool> {
        match self.get(key) {
            None => Ok(false),
            Some(DeValue::Boolean(flag)) => Ok(*flag),
            Some(other) => Err(self.wrong_type(key, other, "true or false", "true")),
        }
    }

    /// The table under a key, if given; its keys must be among `known`.
    ///
    /// # Errors
    /// Another type, or an unknown key.
    pub fn table(&self, key: &str, known: &[&str]) -> Outcome<Option<Keys<'a>>> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        let example = "{ ... }` or start a table with `[...]";
        let table = value.as_table();
        let table = table.ok_or_else(|| self.wrong_type(key, value, "a table", example))?;
        let prefix = format!("{}{key}.", self.prefix);
        Keys::of(self.text, table, prefix, self.line_of(key), known).map(Some)
    }
}

fn number_of(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) => {
            let number = i64::from_str_radix(integer.as_str(), integer.radix()).ok();
            number.map(|number| number as f64)
        }
        _ => None,
    }
}

/// What to say of a key that is not among `known`.
fn unknown(key: &str, known: &[&str]) -> Problem {
    let remedy = match nearest(key, known) {
        Some(near) => format!(
            "write `{near}` if that is meant; known keys: {}",
            known.join(", ")
        ),
        None => format!(
            "remove it, or put it into `notes`; known keys: {}",
            known.join(", ")
        ),
    };
    Problem::new("is an unknown key", remedy)
}
