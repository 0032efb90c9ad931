//! Parse, dispatch, exit status: nothing else.

use ident::cli::{self, Ending};
use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::dispatch(&cli::command().get_matches()) {
        Ok(Ending::Done) => ExitCode::SUCCESS,
        Ok(Ending::Attention) => ExitCode::from(1),
        Err(problem) => {
            cli::tell(&format!("error: {problem}"));
            ExitCode::from(2)
        }
    }
}
