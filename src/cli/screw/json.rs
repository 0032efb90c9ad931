//! The JSON of `ident screw`.

use super::Judged;
use super::tables::{FIGURES, improvement};
use crate::fit::screw::Account;
use crate::fit::screw::groups::Group;
use crate::report::json::{self, number};
use serde_json::{Map, Value, json};
use std::path::Path;

/// The document.
pub fn document(judged: &Judged, dry: bool) -> String {
    let tests = judged
        .tests
        .iter()
        .chain(judged.before.iter().map(|before| &before.0));
    let inputs: Vec<(&Path, &str)> = tests
        .map(|t| (t.path.as_path(), t.sha256.as_str()))
        .collect();
    let mut map = json::head("screw", &inputs);
    map.insert("synthetic".into(), json!(judged.table.synthetic));
    map.extend(body(&judged.account));
    map.insert("residual_limit_um".into(), number(judged.limit_um));
    map.insert(
        "readings_left_out_of_means".into(),
        json!(judged.account.dropped),
    );
    map.insert("rows_left_out".into(), json!(judged.left_out()));
    if let Some((_, before)) = &judged.before {
        map.insert("before".into(), Value::Object(body(before)));
        map.insert(
            "A_change_percent".into(),
            improvement(judged).map_or(Value::Null, number),
        );
    }
    map.insert("motion".into(), super::motion::json(judged));
    map.insert("remarks".into(), json!(judged.remarks()));
    map.insert("doubts".into(), json!(judged.doubts));
    map.insert("table_format".into(), json!(judged.exporter.name));
    let table = (!dry).then(|| judged.table_path().display().to_string());
    map.insert("table".into(), json!(table));
    json::print(map)
}

/// Everything that one state of the axis shows.
fn body(account: &Account) -> Map<String, Value> {
    let um = |value: Option<f64>| value.map_or(Value::Null, |v| number(v * 1e6));
    let figures = FIGURES
        .iter()
        .map(|(key, _, value)| (key.to_string(), um(value(&account.figures))));
    let mut iso: Map<String, Value> = figures.collect();
    iso.insert("coverage".into(), json!(account.figures.coverage as i64));
    let least = account
        .least
        .as_ref()
        .map(|least| least.iter().map(group).collect::<Vec<_>>());
    let mut map = Map::new();
    map.insert("iso230_2".into(), Value::Object(iso));
    map.insert("backlash_um".into(), um(account.backlash));
    map.insert("groups".into(), account.groups.iter().map(group).collect());
    map.insert("least_groups".into(), json!(least));
    map.insert("max_residual_um".into(), number(account.max_residual_um()));
    map
}

fn group(group: &Group) -> Value {
    json!({
        "from_mm": number(group.from_mm),
        "to_mm": number(group.to_mm),
        "p1": number(group.p[0]),
        "p2": number(group.p[1]),
        "p3": number(group.p[2]),
        "max_residual_um": number(group.max_residual_um),
        "points": group.points,
    })
}
