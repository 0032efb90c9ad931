//! The effects of kinds of data that have a table of their own.

use crate::findings::kinds::{Known, known};
use crate::sheet::table::Table;

/// Those of one name, one for each kind of data.
pub fn all_named(name: &str) -> Vec<Known> {
    known().into_iter().filter(|k| k.name == name).collect()
}

/// All of them.
pub fn table() -> Table {
    let header = ["effect", "kind of data", "what it is"];
    let mut table = Table::new("Effects of other kinds of data", header);
    for own in known() {
        table.push([own.name, own.kind, own.summary]);
    }
    table
}

/// One of them in words.
pub fn card(own: &Known) -> String {
    format!(
        "{} in {} data ({}): {}\ntold from rivals if you {}\n",
        own.name, own.kind, own.mechanism, own.summary, own.would_tell
    )
}
