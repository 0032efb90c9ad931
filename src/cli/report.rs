//! `ident report`: where the report of a campaign is, opened in the browser if there is one.

use super::output::{print, tell};
use super::run::place;
use super::{Ending, Verb, arguments, parsed};
use crate::ground::problem::{Outcome, Problem};
use clap::{ArgMatches, Args};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The verb.
pub const VERB: Verb = Verb {
    name: "report",
    about: "Open the report of a campaign",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Folder of the campaign, as measurements/kr210; without it the only one under measurements/
    folder: Option<PathBuf>,
    /// Print where it is, open nothing
    #[arg(long)]
    path: bool,
}

/// Programs that open a page where a desktop has them.
const OPENERS: &[&str] = &["xdg-open", "open"];

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let place = place(arguments.folder.as_deref())?;
    let index = place.reports().join("index.html");
    if !index.is_file() {
        let remedy = format!("run `ident run {}` first", place.measurements().display());
        return Err(Problem::new("there is no report yet", remedy).in_file(&index));
    }
    print(&format!("{}\n", index.display()))?;
    if !arguments.path && std::io::stdout().is_terminal() && !opened(&index) {
        tell("no program here opens pages: open that file in a browser");
    }
    Ok(Ending::Done)
}

fn opened(index: &Path) -> bool {
    OPENERS.iter().any(|program| {
        let mut command = Command::new(program);
        command
            .arg(index)
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        command.spawn().is_ok()
    })
}
