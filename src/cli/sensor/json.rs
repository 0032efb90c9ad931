//! The JSON of `ident sensor`.

use super::Identified;
use super::apply::Applied;
use crate::fit::force_sensor::remainder::{CONVENTION, Remainder, TERMS};
use crate::ground::files::{read_bytes, sha256};
use crate::ground::problem::Outcome;
use crate::measurement::force_sensor::CHANNELS;
use crate::report::json::{self, number};
use serde_json::{Map, Value, json};
use std::path::Path;

/// The document.
pub fn document(found: &Identified, dry: bool) -> String {
    let records = found.applied.iter().map(|applied| &applied.record);
    let tests = found.tests.iter().chain(records);
    let inputs: Vec<(&Path, &str)> = tests
        .map(|t| (t.path.as_path(), t.sha256.as_str()))
        .collect();
    let account = &found.account;
    let mut map = json::head("sensor", &inputs);
    map.insert("synthetic".into(), json!(found.synthetic()));
    map.insert("parameters".into(), json!(account.parameters));
    let [force, moment] = account.fitted.noise;
    map.insert("noise".into(), json!({
        "force_N": number(force), "moment_Nm": number(moment), "estimated": account.fitted.estimated,
    }));
    map.insert("rest".into(), rest(&account.remainder));
    map.insert("polynomial_order".into(), json!(account.remainder.order));
    map.insert("polynomial".into(), polynomial(&account.remainder));
    map.insert("polynomial_convention".into(), json!(CONVENTION));
    let next = account.next.iter().map(|p| json!({"abc_deg": p.abc_deg, "quaternion": p.quaternion, "information_bits": number(p.bits)}));
    map.insert("next".into(), next.collect());
    map.insert("orientations".into(), json!(account.poses.len()));
    map.insert("remarks".into(), json!(found.remarks()));
    map.insert("doubts".into(), json!(found.doubts));
    if let Some(record) = &found.applied {
        map.insert("applied".into(), applied(record, dry));
    }
    let model = (!dry).then(|| found.model_path().display().to_string());
    map.insert("model".into(), json!(model));
    json::print(map)
}

fn rest(rest: &Remainder) -> Value {
    json!({
        "before_N": number(rest.before[0]), "after_N": number(rest.after[0]),
        "held_out_N": number(rest.held_out[0]), "held_out_before_N": number(rest.held_out_before[0]),
        "before_Nm": number(rest.before[1]), "after_Nm": number(rest.after[1]),
        "held_out_Nm": number(rest.held_out[1]), "held_out_before_Nm": number(rest.held_out_before[1]),
    })
}

fn polynomial(rest: &Remainder) -> Value {
    const NAMES: [&str; 4] = ["qw", "qx", "qy", "qz"];
    let term = |(row, (i, j)): (&[f64; 6], &(usize, usize))| {
        let mut map = Map::new();
        map.insert("term".into(), json!(format!("{}*{}", NAMES[*i], NAMES[*j])));
        for (c, (name, unit)) in CHANNELS.iter().enumerate() {
            map.insert(format!("{name}_{unit}"), number(row[c]));
        }
        Value::Object(map)
    };
    rest.coefficients.iter().zip(&TERMS).map(term).collect()
}

fn applied(applied: &Applied, dry: bool) -> Value {
    let [read, left] = applied.sizes();
    let file = (!dry).then(|| applied.path().display().to_string());
    json!({
        "record": applied.record.path.display().to_string(), "readings": applied.loads.len(),
        "before_N": number(read[0]), "after_N": number(left[0]),
        "before_Nm": number(read[1]), "after_Nm": number(left[1]), "file": file,
    })
}

/// The document of a record that was corrected with a model on disk.
///
/// # Errors
/// The model cannot be read.
pub fn of_record(model: &Path, record: &Applied, dry: bool) -> Outcome<String> {
    let hash = sha256(&read_bytes(model)?);
    let inputs = [
        (model, hash.as_str()),
        (record.record.path.as_path(), record.record.sha256.as_str()),
    ];
    let mut map = json::head("sensor", &inputs);
    map.insert("applied".into(), applied(record, dry));
    map.insert("model".into(), json!(model.display().to_string()));
    Ok(json::print(map))
}
