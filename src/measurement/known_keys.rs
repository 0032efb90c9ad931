//! Keys that a kind knows; any other is an error that names the nearest.

use crate::ground::problem::{Outcome, Problem};
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
            let unknown = unknown_key(key, ALWAYS.iter().chain(keys).copied());
            Err(match front.line_of(key) {
                Some(line) => unknown.at_line(line),
                None => unknown,
            })
        }
    }
}

/// A problem with a key that is not among `known`.
pub fn unknown_key<'a>(key: &str, known: impl Iterator<Item = &'a str>) -> Problem {
    let nearest = known.min_by_key(|k| distance(key, k)).unwrap_or("notes");
    Problem::new(
        "is not a fact of this kind",
        format!("did you mean `{nearest}`? What is free goes into `notes = {{ ... }}`"),
    )
    .in_column(key)
}

/// Letters to change, add or drop (Levenshtein 1966).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let changed = corner + usize::from(x != *y);
            corner = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(corner + 1);
        }
    }
    row[b.len()]
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
