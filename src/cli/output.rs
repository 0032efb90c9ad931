//! Standard output that does not mind a closed pipe.

use crate::ground::problem::{Outcome, Problem};
use std::io::Write;

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
