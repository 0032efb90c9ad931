//! The mapping of a raw file asked for, one question after the other, where somebody sits at a terminal.

mod answers;
mod talk;
mod titles;

pub use talk::Talk;

use super::known_kind;
use super::needs::missing;
use crate::findings::kinds::KINDS;
use crate::ground::problem::Outcome;
use crate::measurement::foreign::sidecar::Sidecar;
use crate::measurement::table::Table;
use answers::{fact, joint};
use std::path::Path;
use titles::{map, names};

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::foreign::sidecar::Source;

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
