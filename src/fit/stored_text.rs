//! The text of every fit on disk: what it is, then its tables.

use crate::ground::problem::{Outcome, Problem, line_of_toml};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::Path;

/// A fit as TOML, labelled where the measurement was simulated.
///
/// # Errors
/// It cannot be written as TOML.
pub fn stored_text(fit: &impl Serialize, synthetic: bool) -> Outcome<String> {
    let body = toml::to_string(fit).map_err(|e| {
        Problem::new(
            format!("fit cannot be written as TOML ({e})"),
            "report this as a defect",
        )
    })?;
    let label = match synthetic {
        true => "# synthetic: fitted to simulated measurements\n",
        false => "",
    };
    Ok(format!(
        "{label}# SI units; value and interval are left out where the data do not fix them\n{body}"
    ))
}

/// What a fit on disk holds; `is` says what it should be, as `a fit`.
///
/// # Errors
/// It is no such fit, with the line of what is wrong.
pub fn stored<T: DeserializeOwned>(
    path: &Path,
    bytes: Vec<u8>,
    (is, remedy): (&str, &str),
) -> Outcome<T> {
    let refuse = |what: String, line: usize| Problem::new(what, remedy).at_line(line).in_file(path);
    let text = String::from_utf8(bytes).map_err(|_| refuse("is not UTF-8 text".into(), 1))?;
    toml::from_str(&text).map_err(|e| {
        let what = format!("is not {is}: {}", e.message().trim());
        refuse(what, line_of_toml(&text, &e))
    })
}
