//! A key that nobody knows: an error that names the nearest known one.

use super::test::Kind;
use super::{cubes, force_sensor, frf_uff, front, hammer, joint_motion, load_cycle, milled_part};
use super::{milling_force, screw, toolpath, workspace_test};
use crate::ground::nearest::nearest;
use crate::ground::problem::Problem;

/// The facts of every kind of table, a line each.
const KINDS: &[&[&str]] = &[
    front::COMMON,
    cubes::Facts::KEYS,
    force_sensor::Facts::KEYS,
    frf_uff::FACTS,
    hammer::FACTS,
    joint_motion::FACTS,
    load_cycle::FACTS,
    milled_part::Facts::KEYS,
    milling_force::KEYS,
    screw::Facts::KEYS,
    toolpath::FACTS,
    workspace_test::FACTS,
];

/// A problem with a key that no kind knows; `more`: keys that belong to the place where it stands.
pub fn known_to_no_kind(key: &str, more: &[&str]) -> Option<Problem> {
    let all = [&KINDS.concat(), more].concat();
    (!all.contains(&key)).then(|| unknown_key(key, &all))
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
