//! Standard output that does not mind a closed pipe.

use crate::ground::problem::{Outcome, Problem};
use crate::report::json;
use serde_json::Value;
use std::io::Write;
use std::path::Path;

/// Prints a text; a reader that went away is no error.
pub fn print(text: &str) -> Outcome<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Problem::new(
            format!("standard output cannot be written ({error})"),
            "check where the output goes and whether there is room",
        )),
        Ok(()) => Ok(()),
    }
}

/// Tells something on standard error; nothing can be done if that fails.
pub fn tell(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Prints a result as JSON: the common head, then the keys of `body`, and nothing else.
pub fn print_result(verb: &str, inputs: &[(String, String)], body: Value) -> Outcome<()> {
    let inputs: Vec<(&Path, &str)> = inputs
        .iter()
        .map(|(path, hash)| (Path::new(path), hash.as_str()))
        .collect();
    let mut document = json::head(verb, &inputs);
    if let Value::Object(body) = body {
        document.extend(body);
    }
    print(&json::print(document))
}
