//! `ident diagnose --next N`: which set-ups on the whole robot would tell most.

mod figure;
mod json;
mod proposal;
mod start;
mod tables;

pub use json::setups;
pub use proposal::Proposal;

use super::{Arguments, campaign};
use crate::cli::Ending;
use crate::cli::output::{print, print_result};
use crate::ground::problem::Outcome;
use crate::report::{folder, text};
use start::Start;
use std::path::Path;

/// Runs the verb with `--next`.
pub fn run(arguments: &Arguments, count: usize) -> Outcome<Ending> {
    let proposal = proposal(Start::typed(&arguments.files)?, count)?;
    let mut report = None;
    if !arguments.dry_run {
        let reports = proposal.start.place.reports();
        let written = folder::write_as(&reports, "next.html", &proposal.page())?;
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

/// Diagnoses the points first: what that leaves open counts more.
fn proposal(start: Start, count: usize) -> Outcome<Proposal> {
    let test = start.points.as_ref();
    let one = test.map(|test| campaign::one(&test.path, &start.place, &start.tests));
    let one = one.transpose()?;
    let answer = one.as_ref().map(|one| one.found.answer());
    Ok(Proposal::new(start, answer, count))
}

fn account(proposal: &Proposal, report: Option<&Path>) -> String {
    let mut said = text::indented(&proposal.sentence(), 0);
    said.push_str(&format!(
        "\n{}",
        text::table(&tables::setups(&proposal.plan))
    ));
    if let Some(path) = report {
        said.push_str(&format!("\nreport {}\n", path.display()));
    }
    said
}
