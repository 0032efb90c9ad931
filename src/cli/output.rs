//! Standard output: one human account or one JSON document. A closed pipe is not an error.

use crate::ground::problem::{Outcome, Problem};
use serde_json::{Value, json};
use std::io::{ErrorKind, Write};

/// Writes `text` to standard output.
///
/// # Errors
/// Standard output cannot be written, other than by a reader that has gone.
pub fn print(text: &str) -> Outcome<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Problem::new(
            format!("standard output cannot be written ({error})"),
            "check that the disk has room",
        )),
        _ => Ok(()),
    }
}

/// Writes one JSON document and nothing else.
///
/// # Errors
/// As [`print`].
pub fn print_json(document: &Value) -> Outcome<()> {
    print(&format!("{document:#}\n"))
}

/// The head common to all results: schema, verb, inputs with their hashes, then `body`'s keys.
pub fn result(verb: &str, inputs: &[(String, String)], body: Value) -> Value {
    let inputs: Vec<Value> = inputs
        .iter()
        .map(|(path, sha256)| json!({"path": path, "sha256": sha256}))
        .collect();
    let mut document = json!({"schema": "ident/1", "verb": verb, "inputs": inputs});
    if let (Some(head), Value::Object(body)) = (document.as_object_mut(), body) {
        head.extend(body);
    }
    document
}
