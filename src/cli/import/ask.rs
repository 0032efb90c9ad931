//! The mapping of a raw file asked for, one question after the other, where somebody sits at a terminal.

use super::needs::{Column, columns, missing};
use super::{known_kind, value_of};
use crate::findings::kinds::KINDS;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::split_name;
use crate::measurement::foreign::sidecar::{Sidecar, Source};
use crate::measurement::foreign::translated;
use crate::measurement::hammer_uff::is_universal;
use crate::measurement::table::Table;
use std::io::{BufRead, Write};
use std::path::Path;

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

    fn say(&mut self, text: &str) -> Outcome<()> {
        let written = self.questions.write_all(text.as_bytes());
        written
            .and_then(|()| self.questions.flush())
            .map_err(|e| cut(&e))
    }

    /// An answer that `right` takes; `None` where the answer is empty or the input ends.
    fn ask<T>(&mut self, question: &str, right: impl Fn(&str) -> Outcome<T>) -> Outcome<Option<T>> {
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

/// Asks for what the file, its sidecar and its folder do not say. An empty answer leaves it open.
///
/// # Errors
/// The terminal ends.
pub fn completed(path: &Path, mut sidecar: Sidecar, talk: &mut Talk) -> Outcome<Sidecar> {
    let mut facts = stated(path, &sidecar);
    let mut greeted = false;
    if !facts.contains_key("kind") {
        greet(path, &mut greeted, talk)?;
        let words: Vec<&str> = KINDS.iter().map(|kind| kind.0).collect();
        let kind = |answer: &str| known_kind(answer).map(|()| answer.to_string());
        let Some(kind) = talk.ask(&format!("kind ({})", words.join(", ")), kind)? else {
            return Ok(sidecar);
        };
        sidecar
            .facts
            .insert("kind".into(), toml::Value::String(kind));
    }
    facts.extend(sidecar.facts.clone());
    let kind = facts
        .get("kind")
        .and_then(|kind| kind.as_str())
        .unwrap_or_default()
        .to_string();
    map(path, &mut sidecar, &kind, &mut greeted, talk)?;
    let names = names(path, &sidecar);
    if kind == "load-cycle" && missing(&facts, &names).is_empty() && !facts.contains_key("joint") {
        greet(path, &mut greeted, talk)?;
        let joint = talk.ask("joint, 1 to 6 (empty: a linear spring)", joint)?;
        joint
            .into_iter()
            .for_each(|joint| insert(&mut sidecar, &mut facts, "joint", joint));
    }
    for need in missing(&facts, &names) {
        greet(path, &mut greeted, talk)?;
        let question = format!("{} ({})", need.key, need.what);
        let right = |answer: &str| fact(need.key, answer);
        if let Some(value) = talk.ask(&question, right)? {
            insert(&mut sidecar, &mut facts, need.key, value);
        }
    }
    Ok(sidecar)
}

fn insert(sidecar: &mut Sidecar, facts: &mut toml::Table, key: &str, value: toml::Value) {
    sidecar.facts.insert(key.into(), value.clone());
    facts.insert(key.into(), value);
}

fn greet(path: &Path, greeted: &mut bool, talk: &mut Talk) -> Outcome<()> {
    match std::mem::replace(greeted, true) {
        true => Ok(()),
        false => talk.say(&format!(
            "{} (an empty answer leaves it open)\n",
            path.display()
        )),
    }
}

/// What is stated already: in the file, beside it and for its folder.
fn stated(path: &Path, sidecar: &Sidecar) -> toml::Table {
    let own = Table::read(path).map_or_else(|_| toml::Table::new(), |table| table.front.facts);
    [sidecar.shared.clone(), sidecar.facts.clone()]
        .into_iter()
        .fold(own, |mut all, more| {
            all.extend(more);
            all
        })
}

/// Titles of the raw file and what each became; nothing where the file says itself what it holds.
fn titles(path: &Path, sidecar: &Sidecar) -> Vec<(String, Option<String>)> {
    if is_universal(path) {
        return Vec::new();
    }
    if let Ok(Some(reading)) = translated(path, sidecar) {
        return reading.columns;
    }
    // Titles that tell nothing are seen where one column is named by its number.
    let mut probe = sidecar.clone();
    probe.columns.push(("time_s".into(), Source::Number(1)));
    let found = translated(path, &probe).ok().flatten();
    let columns = found.map_or(Vec::new(), |reading| reading.columns);
    columns
        .into_iter()
        .map(|(title, _)| (title, None))
        .collect()
}

/// Names of the columns as they will be read.
fn names(path: &Path, sidecar: &Sidecar) -> Vec<String> {
    match translated(path, sidecar) {
        Ok(Some(reading)) => reading
            .columns
            .into_iter()
            .filter_map(|column| column.1)
            .collect(),
        _ => Table::read(path).map_or(Vec::new(), |table| {
            table.columns.into_iter().map(|c| c.name).collect()
        }),
    }
}

/// Asks for the columns that the kind needs and that no title tells.
fn map(
    path: &Path,
    sidecar: &mut Sidecar,
    kind: &str,
    greeted: &mut bool,
    talk: &mut Talk,
) -> Outcome<()> {
    let titles = titles(path, sidecar);
    let known: Vec<(String, Source)> = titles
        .iter()
        .enumerate()
        .filter_map(|(i, (_, name))| Some((name.clone()?, Source::Number(i + 1))))
        .collect();
    let told = |column: &Column| {
        known
            .iter()
            .any(|(name, _)| column.stems.contains(&stem(name)))
    };
    let open: Vec<&Column> = columns(kind)
        .iter()
        .filter(|column| !told(column))
        .collect();
    if titles.is_empty() || open.is_empty() {
        return Ok(());
    }
    greet(path, greeted, talk)?;
    for (i, (title, name)) in titles.iter().enumerate() {
        let became = name
            .as_ref()
            .map_or(String::new(), |name| format!(" = {name}"));
        talk.say(&format!("  {} `{title}`{became}\n", i + 1))?;
    }
    let mut columns = known.clone();
    for column in open {
        let question = format!(
            "{}: number of its column, and its name if not {}",
            column.what, column.name
        );
        if let Some(found) = talk.ask(&question, |answer| mapped(answer, column, titles.len()))? {
            columns.push(found);
        }
    }
    if columns.len() > known.len() {
        sidecar.columns = columns;
    }
    Ok(())
}

fn stem(name: &str) -> &str {
    name.split('_').next().unwrap_or(name)
}

/// `2`, or `2 force_kN`.
fn mapped(answer: &str, column: &Column, count: usize) -> Outcome<(String, Source)> {
    let (number, name) = answer.split_once(' ').unwrap_or((answer, column.name));
    let name = name.trim();
    let split = split_name(name);
    if !split.is_some_and(|(stem, _)| column.stems.contains(&stem.as_str())) {
        let what = format!("`{name}` is no name of this column");
        return Err(Problem::new(
            what,
            format!("write one with its unit, as {}", column.name),
        ));
    }
    match number.parse() {
        Ok(n) if (1..=count).contains(&n) => Ok((name.into(), Source::Number(n))),
        _ => Err(Problem::new(
            format!("`{number}` is no column"),
            format!("give 1 to {count}"),
        )),
    }
}

fn joint(answer: &str) -> Outcome<toml::Value> {
    match answer.trim_start_matches(['A', 'a']).parse() {
        Ok(joint) if (1..=6).contains(&joint) => Ok(toml::Value::Integer(joint)),
        _ => Err(Problem::new(
            format!("`{answer}` is no joint"),
            "give 1 to 6",
        )),
    }
}

/// An answer as the value of a fact, of the form that the key asks for.
fn fact(key: &str, answer: &str) -> Outcome<toml::Value> {
    let refuse = |remedy: &str| Err(Problem::new(format!("`{answer}` does not fit"), remedy));
    let value = value_of(&answer.replace(';', ","));
    let number = |value: &toml::Value| value.as_float().or(value.as_integer().map(|n| n as f64));
    match key {
        "joint" => joint(answer),
        "axis" if !["rotation", "tilt"].contains(&answer) => refuse("write rotation or tilt"),
        "joint_angles_deg" => {
            let list = match value.is_array() {
                true => value,
                false => value_of(&format!("[{answer}]")),
            };
            let whole = list
                .as_array()
                .is_some_and(|all| !all.is_empty() && all.iter().all(|v| number(v).is_some()));
            if whole {
                Ok(list)
            } else {
                refuse("write numbers, as 0, -90, 90, 0, 0, 0")
            }
        }
        key if key.ends_with("_m") || key.ends_with("_mm") => match number(&value) {
            Some(length) if length > 0.0 => Ok(value),
            _ => refuse("write a number above zero, with a decimal point"),
        },
        _ => Ok(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn talked(text: &str, answers: &str) -> (Sidecar, String) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("raw.csv");
        std::fs::write(&path, text).unwrap();
        let mut questions = Vec::new();
        let mut answers = answers.as_bytes();
        let mut talk = Talk::new(&mut answers, &mut questions);
        let found = completed(&path, Sidecar::default(), &mut talk).unwrap();
        (found, String::from_utf8(questions).unwrap())
    }

    fn raw(titles: &str) -> String {
        let row = |i: i32| format!("{};{};{}\n", i, 3 * i, 7 * i);
        format!("{titles}\n{}", (0..20).map(row).collect::<String>())
    }

    #[test]
    fn a_file_that_tells_nothing_is_asked_for_everything() {
        let answers =
            "load cycle\nload-cycle\n1\n2 force_kN\n9\n3\n2\nsideways\nrotation\n-1\n0.5\n0.4\n";
        let (found, said) = talked(&raw("a;b;c"), answers);
        let column = |name: &str, n| (name.to_string(), Source::Number(n));
        assert_eq!(
            found.columns,
            [
                column("time_s", 1),
                column("force_kN", 2),
                column("displacement_mm", 3)
            ]
        );
        assert_eq!(found.facts["kind"].as_str(), Some("load-cycle"));
        assert_eq!(found.facts["joint"].as_integer(), Some(2));
        assert_eq!(found.facts["load_lever_m"].as_float(), Some(0.5));
        assert_eq!(found.facts["sensor_lever_m"].as_float(), Some(0.4));
        for line in [
            "no kind",
            "give 1 to 3",
            "rotation or tilt",
            "above zero",
            "2 `b`",
        ] {
            assert!(said.contains(line), "{line}: {said}");
        }
    }

    #[test]
    fn what_is_told_is_not_asked() {
        let (found, said) = talked(
            &raw("Zeit [s];Kraft [N];c"),
            "load-cycle\n3 displacement_um\n\n",
        );
        assert_eq!(found.columns.len(), 3);
        assert!(
            !said.contains("time: number") && said.contains("deflection: number"),
            "{said}"
        );
        let (found, said) = talked(&raw("Zeit [s];Kraft [N];Weg [mm]"), "load-cycle\n\n");
        assert!(
            found.columns.is_empty() && found.facts.len() == 1,
            "{found:?}"
        );
        assert!(!said.contains("number of its column"), "{said}");
    }

    #[test]
    fn an_end_of_answers_leaves_the_rest_open() {
        let (found, _) = talked(&raw("a;b;c"), "");
        assert_eq!(found, Sidecar::default());
        let (found, _) = talked(&raw("a;b;c"), "hammer\n1\n");
        assert_eq!((found.facts.len(), found.columns.len()), (1, 1));
    }
}
