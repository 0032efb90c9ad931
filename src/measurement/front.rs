//! Front matter: the leading `#` lines of a measurement file, one TOML document.

use super::foreign::Sidecar;
use super::known_keys::unknown_key;
use crate::ground::problem::{Outcome, Problem, line_of_toml};
use std::collections::BTreeSet;
use toml::{Table, Value};

/// The facts a file carries about itself.
#[derive(Debug, Clone, Default)]
pub struct Front {
    /// The parsed TOML document.
    pub facts: Table,
    text: String,
    /// Keys that all files of the folder share.
    shared: BTreeSet<String>,
}

/// Magnitudes of facts: beyond them products with measured values leave the numbers.
const SMALLEST: f64 = 1e-30;
const LARGEST: f64 = 1e30;

/// Facts that every kind knows.
pub(super) const COMMON: &[&str] = &[
    "kind",
    "source",
    "synthetic",
    "notes",
    "robot",
    "role",
    "columns",
    "skip_rows",
    "encoding",
    "date",
];

impl Front {
    /// Parses the text behind the `#` signs; line n of `text` is line n of the file.
    pub fn parse(text: String) -> Outcome<Self> {
        match text.parse::<Table>() {
            Ok(facts) => Ok(Self {
                facts,
                text,
                shared: BTreeSet::new(),
            }),
            Err(error) => Err(Self::broken(&text, &error)),
        }
    }

    fn broken(text: &str, error: &toml::de::Error) -> Problem {
        Problem::new(
            format!("front matter is not TOML: {}", error.message().trim()),
            "write each fact as `# key = value`, text in double quotes",
        )
        .at_line(line_of_toml(text, error))
    }

    /// Takes over facts from beside the file, where the file does not state them itself.
    pub fn inherit(&mut self, sidecar: Sidecar) {
        for (key, value) in sidecar.facts {
            self.facts.entry(key).or_insert(value);
        }
        for (key, value) in sidecar.shared {
            if !self.facts.contains_key(&key) {
                self.shared.insert(key.clone());
                self.facts.insert(key, value);
            }
        }
    }

    /// 1-based line of the file on which `key` is set.
    pub fn line_of(&self, key: &str) -> Option<usize> {
        let starts = |line: &str| {
            let rest = line.trim_start().strip_prefix(key)?;
            rest.trim_start().starts_with('=').then_some(())
        };
        self.text
            .lines()
            .position(|l| starts(l).is_some())
            .map(|i| i + 1)
    }

    /// A problem with `key`, placed on its line.
    pub fn problem(
        &self,
        key: &str,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Problem {
        let problem = Problem::new(what, remedy).in_column(key);
        match self.line_of(key) {
            Some(line) => problem.at_line(line),
            None => problem.at_line(1),
        }
    }

    /// A finite number, if given.
    pub fn number(&self, key: &str) -> Outcome<Option<f64>> {
        let value = match self.facts.get(key) {
            None => return Ok(None),
            Some(Value::Float(x)) => *x,
            Some(Value::Integer(i)) => *i as f64,
            Some(other) => {
                let what = format!("is {} instead of a number", other.type_str());
                return Err(self.problem(key, what, format!("write `# {key} = 1.5`")));
            }
        };
        if !value.is_finite() {
            let remedy = "give a finite number or leave the fact out";
            return Err(self.problem(key, "is not finite", remedy));
        }
        self.measured(key, value)?;
        Ok(Some(value))
    }

    /// A number above zero, if given.
    pub fn positive(&self, key: &str) -> Outcome<Option<f64>> {
        match self.number(key)? {
            Some(x) if x <= 0.0 => Err(self.problem(
                key,
                format!("is {x}, which is not above zero"),
                "give the positive value, or leave the fact out if it does not apply",
            )),
            other => Ok(other),
        }
    }

    /// A number at or above zero, if given.
    pub fn not_negative(&self, key: &str) -> Outcome<Option<f64>> {
        match self.number(key)? {
            Some(x) if x < 0.0 => {
                Err(self.problem(key, format!("is {x}, below zero"), "give zero or more"))
            }
            other => Ok(other),
        }
    }

    /// A relative standard deviation, if given; 1 and more is a percentage by mistake.
    pub fn fraction(&self, key: &str) -> Outcome<Option<f64>> {
        match self.not_negative(key)? {
            Some(x) if x >= 1.0 => {
                let what = format!("is {x}, 100 % or more");
                Err(self.problem(key, what, "write it as a fraction: 0.02 for 2 %"))
            }
            other => Ok(other),
        }
    }

    /// A text, if given.
    pub fn text(&self, key: &str) -> Outcome<Option<&str>> {
        match self.facts.get(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(self.problem(
                key,
                format!("is {} instead of a text", other.type_str()),
                format!("write `# {key} = \"...\"`"),
            )),
        }
    }

    /// The day of the measurement, as `2026-11-22`, if given.
    ///
    /// # Errors
    /// It is no date.
    pub fn date(&self) -> Outcome<Option<String>> {
        let date = match self.facts.get("date") {
            None => return Ok(None),
            Some(Value::Datetime(at)) => at.date,
            Some(other) => {
                let text = other.as_str().unwrap_or_default();
                text.parse::<toml::value::Datetime>()
                    .ok()
                    .and_then(|at| at.date)
            }
        };
        let wrong = || self.problem("date", "is no date", "write `# date = 2026-11-22`");
        date.map(|date| Some(date.to_string())).ok_or_else(wrong)
    }

    /// Refuses a file of another kind than `wanted`, or of none.
    ///
    /// # Errors
    /// Names the kind found.
    pub fn expect_kind(&self, wanted: &str) -> Outcome<()> {
        match self.text("kind")? {
            Some(kind) if kind == wanted => Ok(()),
            Some(other) => Err(self.problem(
                "kind",
                format!("is `{other}`, not `{wanted}`"),
                format!(
                    "give this verb a {wanted} file; `ident inspect FILE` shows what a file is"
                ),
            )),
            None => Err(Problem::new(
                "the front matter does not say its kind",
                format!("start the file with the line `# kind = \"{wanted}\"`"),
            )
            .at_line(1)),
        }
    }

    /// Refuses facts that the kind does not know: a misspelt fact would count as left out.
    ///
    /// # Errors
    /// The first unknown fact, with the nearest known one.
    pub fn only(&self, known: &[&str]) -> Outcome<()> {
        let all = [COMMON, known].concat();
        let unknown = |key: &&String| !all.contains(&key.as_str()) && !self.shared.contains(*key);
        let Some(key) = self.facts.keys().find(unknown) else {
            return Ok(());
        };
        let unknown = unknown_key(key, &all);
        Err(match self.line_of(key) {
            Some(line) => unknown.at_line(line),
            None => unknown,
        })
    }

    /// A list of finite numbers, if given.
    pub fn numbers(&self, key: &str) -> Outcome<Option<Vec<f64>>> {
        let Some(value) = self.facts.get(key) else {
            return Ok(None);
        };
        let number = |value: &Value| match value {
            Value::Float(x) => x.is_finite().then_some(*x),
            Value::Integer(i) => Some(*i as f64),
            _ => None,
        };
        let list: Option<Vec<f64>> = value
            .as_array()
            .and_then(|list| list.iter().map(number).collect());
        let refused = || {
            self.problem(
                key,
                "is not a list of finite numbers",
                format!("write `# {key} = [0.0, 1.5]`"),
            )
        };
        let list = list.ok_or_else(refused)?;
        list.iter().try_for_each(|x| self.measured(key, *x))?;
        Ok(Some(list))
    }

    /// Refuses a number that nobody measures.
    fn measured(&self, key: &str, value: f64) -> Outcome<()> {
        match value == 0.0 || (SMALLEST..=LARGEST).contains(&value.abs()) {
            true => Ok(()),
            false => {
                let what = format!("is {value:e}, which nobody measures");
                Err(self.problem(key, what, "check the exponent and the unit of the key"))
            }
        }
    }

    /// True when the file says of itself that nobody measured it.
    pub fn synthetic(&self) -> bool {
        matches!(self.facts.get("synthetic"), Some(Value::Boolean(true)))
    }
}

/// A text as TOML quotes it.
pub fn quoted(text: &str) -> String {
    Value::String(text.to_string()).to_string()
}

/// The fact `inputs`: path and SHA-256 of every file that a result rests on.
pub fn inputs(files: &[(String, String)]) -> String {
    let input = |(path, sha256): &(String, String)| {
        let (path, sha256) = (quoted(path), quoted(sha256));
        format!("#   {{ path = {path}, sha256 = {sha256} }},\n")
    };
    format!(
        "# inputs = [\n{}# ]\n",
        files.iter().map(input).collect::<String>()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_toml_names_its_line() {
        let problem = Front::parse("kind = \"load-cycle\"\njoint = = 6\n".into()).unwrap_err();
        assert_eq!(problem.line, Some(2));
    }

    #[test]
    fn facts_know_their_line() {
        let front = Front::parse("kind = \"x\"\n\nload_lever_m = -1\n".into()).unwrap();
        assert_eq!(front.positive("load_lever_m").unwrap_err().line, Some(3));
    }

    #[test]
    fn an_unknown_fact_names_its_line_and_the_nearest_known_one() {
        let front = Front::parse("kind = \"screw\"\npich_mm = 5\n".into()).unwrap();
        let problem = front.only(&["pitch_mm", "scale_noise_um"]).unwrap_err();
        assert_eq!(problem.line, Some(2));
        assert!(problem.remedy.contains("`pitch_mm`"), "{problem}");
    }
}
