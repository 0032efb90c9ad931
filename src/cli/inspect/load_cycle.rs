//! The account of load cycles.

use super::{Account, title};
use crate::fit::inspection::inspect;
use crate::ground::problem::Outcome;
use crate::measurement::load_cycle::LoadCycle;
use crate::report::json;
use serde_json::json;
use std::path::Path;

/// Reads and tells.
pub fn account(path: &Path) -> Outcome<Account> {
    let file = LoadCycle::read(path)?;
    let found = inspect(&file);
    let what = format!("load-cycle of {}", file.site());
    let mut lines = title(&file.path, &what, file.facts.synthetic);
    lines.push(format!(
        "{} rows, {} left out for an empty cell; {}",
        file.rows, file.left_out, file.dialect
    ));
    lines.extend(file.conversions.iter().cloned());
    let named = found.lines.iter();
    lines.extend(named.map(|(name, value)| format!("{name}: {value}")));
    let mut map = json::head("inspect", &[(&file.path, &file.sha256)]);
    map.insert("kind".into(), json!("load-cycle"));
    map.insert("site".into(), json!(file.site()));
    map.insert("synthetic".into(), json!(file.facts.synthetic));
    map.insert("rows".into(), json!(file.rows));
    map.insert("rows_left_out".into(), json!(file.left_out));
    map.insert("dialect".into(), json!(file.dialect));
    map.insert("channels".into(), json!(file.conversions));
    map.insert("sampling_s".into(), json!(found.step));
    map.insert("cycles".into(), json!(found.cycles));
    map.insert("turning_points".into(), json!(found.turning));
    map.insert("unloaded_start_s".into(), json!(found.rest));
    map.insert("noise".into(), json!(found.noise));
    Ok(Account {
        lines,
        json: map,
        odd: found.odd,
    })
}
