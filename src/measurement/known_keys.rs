//! A key that nobody knows: an error that names the nearest known one.

use crate::ground::nearest::nearest;
use crate::ground::problem::Problem;

/// A problem with a key that is not among `known`.
pub fn unknown_key(key: &str, known: &[&str]) -> Problem {
    let free = "what is free goes into `notes = { ... }`";
    let remedy = match nearest(key, known) {
        Some(near) => format!("write `{near}` if that is meant; {free}"),
        None => format!("take it out; {free}; known: {}", known.join(", ")),
    };
    Problem::new("is not a fact of this kind", remedy).in_column(key)
}
