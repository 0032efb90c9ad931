//! Keys that a kind knows; any other is an error that names the nearest.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::nearest::nearest;
use crate::measurement::front::Front;

/// Facts that every kind knows.
const ALWAYS: &[&str] = &["kind", "source", "synthetic", "notes"];

/// Refuses a fact that neither `keys` nor every kind knows.
///
/// # Errors
/// The first unknown key, its line, and the nearest known one.
pub fn refuse_unknown(front: &Front, keys: &[&str]) -> Outcome<()> {
    let known = |key: &str| ALWAYS.contains(&key) || keys.contains(&key);
    match front.facts.keys().find(|key| !known(key)) {
        None => Ok(()),
        Some(key) => {
            let unknown = unknown_key(key, &[ALWAYS, keys].concat());
            Err(match front.line_of(key) {
                Some(line) => unknown.at_line(line),
                None => unknown,
            })
        }
    }
}

/// A problem with a key that is not among `known`.
pub fn unknown_key(key: &str, known: &[&str]) -> Problem {
    let free = "what is free goes into `notes = { ... }`";
    let remedy = match nearest(key, known) {
        Some(near) => format!("write `{near}` if that is meant; {free}"),
        None => format!("take it out; {free}; known: {}", known.join(", ")),
    };
    Problem::new("is not a fact of this kind", remedy).in_column(key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_known_key_is_named() {
        let front = Front::parse("kind = \"x\"\nhelix_dg = 30\n".into()).unwrap();
        let problem = refuse_unknown(&front, &["diameter_mm", "helix_deg"]).unwrap_err();
        assert_eq!(problem.line, Some(2));
        assert!(problem.remedy.contains("`helix_deg`"), "{problem}");
    }
}
