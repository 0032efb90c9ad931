//! `ident diagnose --next N`: which set-ups on the whole robot would tell most.

mod figure;
mod json;
mod page;
mod tables;

pub use page::{sentence, setups, spreads};

use super::Arguments;
use crate::cli::Ending;
use crate::cli::output::{located, print, print_result, warn};
use crate::cli::run::place;
use crate::findings::campaign::{Proposal, Start};
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::workspace::Place;
use crate::report::{folder, text};
use std::path::{Path, PathBuf};

/// Runs the verb with `--next`.
pub fn run(arguments: &Arguments, count: usize) -> Outcome<Ending> {
    let start = typed(&arguments.files)?;
    warn(&start.warnings);
    let proposal = Proposal::after_diagnosis(start, count)?;
    let mut report = None;
    if !arguments.dry_run {
        let reports = proposal.start.place.reports();
        let written = folder::write_as(&reports, "next.html", &page::page(&proposal))?;
        report = written.last().cloned();
    }
    let report = report.as_deref();
    match arguments.json {
        true => {
            let body = json::body(&proposal.plan, report);
            print_result("diagnose", &proposal.start.inputs(), body)?;
        }
        false => print(&account(&proposal, report))?,
    }
    Ok(Ending::Done)
}

/// What a plan starts from, by what is typed after `--next N`.
fn typed(files: &[PathBuf]) -> Outcome<Start> {
    match files {
        [] => required(place(None)?),
        [folder] if folder.is_dir() => required(place(Some(folder))?),
        [file] => {
            let path = located(file)?;
            Start::points(Place::of(&path), &path)
        }
        several => Err(Problem::new(
            format!(
                "--next plans for one robot, and {} files are given",
                several.len()
            ),
            "give one file of kind workspace, or the folder of the campaign",
        )),
    }
}

fn required(place: Place) -> Outcome<Start> {
    let folder = place.measurements();
    Start::campaign(place)?.ok_or_else(|| {
        let remedy = "add `# robot = \"kr210\"` to the front matter of one of them";
        Problem::new("holds no measurement that names its robot", remedy).in_file(&folder)
    })
}

fn account(proposal: &Proposal, report: Option<&Path>) -> String {
    let mut said = text::indented(&sentence(proposal), 0);
    said.push_str(&format!(
        "\n{}",
        text::table(&tables::setups(&proposal.plan))
    ));
    if let Some(path) = report {
        said.push_str(&format!("\nreport {}\n", path.display()));
    }
    said
}
