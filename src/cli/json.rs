//! The common head of every JSON result, and numbers that may be missing.

use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use serde_json::{Map, Value, json};
use std::path::Path;

/// `{"schema", "verb", "inputs": [{"path", "sha256"}]}`.
pub fn head(verb: &str, inputs: &[&Path]) -> Outcome<Map<String, Value>> {
    let input = |path: &&Path| -> Outcome<Value> {
        let sha256 = files::sha256(&files::read_bytes(path)?);
        Ok(json!({"path": path.display().to_string(), "sha256": sha256}))
    };
    let inputs = inputs.iter().map(input).collect::<Outcome<Vec<_>>>()?;
    let mut head = Map::new();
    head.insert("schema".into(), json!("ident/1"));
    head.insert("verb".into(), json!(verb));
    head.insert("inputs".into(), json!(inputs));
    Ok(head)
}

/// A number, or null where it is not one.
pub fn number(value: f64) -> Value {
    serde_json::Number::from_f64(value).map_or(Value::Null, Value::Number)
}

/// A list of numbers, null where they are not.
pub fn numbers(values: &[f64]) -> Value {
    values.iter().map(|v| number(*v)).collect()
}

/// Prints one document to standard output.
pub fn print(document: &Value) -> Outcome<()> {
    let text = serde_json::to_string(document);
    let failed = |e: serde_json::Error| {
        Problem::new(
            format!("result is not JSON ({e})"),
            "report this as a fault of ident",
        )
    };
    super::print(&(text.map_err(failed)? + "\n"))
}
