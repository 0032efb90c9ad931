//! The JSON of `ident force`.

use super::Found;
use crate::cutting::LINEAR_EDGE;
use crate::report::json;
use serde_json::{Value, json};
use std::path::Path;

/// The document.
pub fn json(found: &Found, dry_run: bool) -> String {
    let inputs: Vec<(&Path, &str)> = found
        .files
        .iter()
        .map(|f| (f.path.as_path(), f.sha256.as_str()))
        .collect();
    let account = &found.account;
    let mut map = json::head("force", &inputs);
    map.insert("synthetic".into(), json!(found.synthetic()));
    map.insert("law".into(), json!(LINEAR_EDGE.card().name));
    map.insert("parameters".into(), json!(account.parameters));
    map.insert("nuisance".into(), json!(account.nuisance));
    map.insert("fit".into(), fit(found));
    map.insert("averaged".into(), averaged(found));
    let path = found.material_path().filter(|_| !dry_run);
    let path = path.map_or(Value::Null, |p| json!(p.display().to_string()));
    map.insert("material".into(), path);
    map.insert("remarks".into(), json!(found.remarks()));
    map.insert("doubts".into(), json!(found.doubts));
    json::print(map)
}

fn fit(found: &Found) -> Value {
    let account = &found.account;
    let squares: f64 = account.rms.iter().map(|v| v * v / 3.0).sum();
    json!({
        "rms": json::number(squares.sqrt()),
        "rms_xyz": json::numbers(&account.rms),
        "noise_rms": account.stated_noise,
        "unit": "N",
        "rows": account.rows,
        "cuts": account.cuts.len(),
        "rel_std": account.rel_std,
        "repeating_share": json::number(account.repeating),
    })
}

fn averaged(found: &Found) -> Value {
    let averaged = &found.account.averaged;
    let coefficients = LINEAR_EDGE.card().coefficients.iter();
    let parameters: Vec<Value> = coefficients
        .zip(averaged.coefficients)
        .map(|(c, value)| json!({"name": c.name, "value": value, "unit": c.unit}))
        .collect();
    let means: Vec<Value> = averaged.means.iter().map(|m| json::numbers(m)).collect();
    json!({"parameters": parameters, "mean_force_N": means})
}
