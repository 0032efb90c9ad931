//! Standard output that does not mind a closed pipe.

use crate::ground::problem::{Outcome, Problem};
use crate::measurement::workspace::resolve;
use crate::report::json;
use serde_json::Value;
use std::borrow::Cow;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Prints a text; a reader that went away is no error.
pub fn print(text: &str) -> Outcome<()> {
    let mut out = std::io::stdout().lock();
    match out
        .write_all(harmless(text).as_bytes())
        .and_then(|()| out.flush())
    {
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
    let _ = writeln!(std::io::stderr().lock(), "{}", harmless(text));
}

/// The measurement that is meant by a name; what was taken for it is told.
///
/// # Errors
/// There is none, or there are several.
pub fn located(name: &Path) -> Outcome<PathBuf> {
    let (path, said) = resolve(name)?;
    said.iter().for_each(|s| tell(s));
    Ok(path)
}

/// Warnings, one line each, on standard error.
pub fn warn(remarks: &[String]) {
    remarks
        .iter()
        .for_each(|remark| tell(&format!("warning: {remark}")));
}

/// A text without what would steer a terminal: files name kinds, units, joints and hits as they like.
/// Control characters but line ends and tabs, and marks that turn the direction of writing, become U+FFFD.
pub fn harmless(text: &str) -> Cow<'_, str> {
    let steers = |c: char| {
        let plain = matches!(c, '\n' | '\t');
        let turns = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        c.is_control() && !plain || turns
    };
    match text.contains(steers) {
        true => Cow::Owned(text.replace(steers, "\u{fffd}")),
        false => Cow::Borrowed(text),
    }
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
