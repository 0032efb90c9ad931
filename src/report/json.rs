//! The JSON of `formats.md`: one document, common head, numbers or null.

use serde::Serialize;
use serde_json::{Map, Value, json};
use std::path::Path;

/// The common head of every result.
pub fn head(verb: &str, inputs: &[(&Path, &str)]) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("schema".into(), json!("ident/1"));
    map.insert("verb".into(), json!(verb));
    let list: Vec<Value> = inputs
        .iter()
        .map(|(path, hash)| json!({"path": path.display().to_string(), "sha256": hash}))
        .collect();
    map.insert("inputs".into(), Value::Array(list));
    map
}

/// What follows the head: a result that writes itself.
pub fn body(result: &impl Serialize) -> Map<String, Value> {
    match serde_json::to_value(result) {
        Ok(Value::Object(map)) => map,
        _ => Map::new(),
    }
}

/// A document as it is printed: indented, with a newline at the end.
pub fn print(map: Map<String, Value>) -> String {
    let mut text = serde_json::to_string_pretty(&Value::Object(map)).unwrap_or_default();
    text.push('\n');
    text
}

/// A document with long arrays, on one line with a newline at the end.
pub fn line(map: Map<String, Value>) -> String {
    let mut text = Value::Object(map).to_string();
    text.push('\n');
    text
}

/// A number, or null where it is not one.
pub fn number(value: f64) -> Value {
    serde_json::Number::from_f64(value).map_or(Value::Null, Value::Number)
}

/// A list of numbers, null where they are not.
pub fn numbers(values: &[f64]) -> Value {
    values.iter().map(|v| number(*v)).collect()
}
