//! The robots that come with `ident`. A further one is a file in `src/robot/builtin/` and a line here.

use super::file;
use super::model::Robot;
use crate::ground::problem::Outcome;

/// Name and TOML text of every built-in robot.
pub const BUILTINS: &[(&str, &str)] = &[
    ("kr210", include_str!("builtin/kr210.toml")),
    ("kr300", include_str!("builtin/kr300.toml")),
];

/// TOML text of the built-in robot `name`.
pub fn text(name: &str) -> Option<&'static str> {
    BUILTINS
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, text)| *text)
}

/// The built-in robot `name`, if there is one.
pub fn named(name: &str) -> Option<Outcome<Robot>> {
    text(name).map(file::read)
}

/// All names, for messages.
pub fn names() -> String {
    BUILTINS
        .iter()
        .map(|(name, _)| *name)
        .collect::<Vec<_>>()
        .join(", ")
}
