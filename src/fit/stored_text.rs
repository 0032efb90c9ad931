//! The text of every fit on disk: what it is, then its tables.

use crate::ground::problem::{Outcome, Problem};
use serde::Serialize;

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
