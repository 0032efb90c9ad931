//! The report page of `ident mill`.

use super::{Result, account, figures};
use crate::ground::files;
use crate::process::setup::Support;
use crate::sheet::page::{Block, Page, Tone};

/// The page.
pub fn page(result: &Result) -> Page {
    let path = &result.planned.toolpath.path;
    let name = files::name(path);
    let subtitle = format!(
        "{} by the robot {}",
        result.planned.job.path.display(),
        result.setup.robot.name
    );
    let mut page = Page::new(format!("Milled: {name}"), subtitle);
    page.synthetic = result.planned.toolpath.synthetic || result.planned.job.synthetic;
    let tone = if result.needs_attention() {
        Tone::Attention
    } else {
        Tone::Good
    };
    let mut sentences = account::sentences(result).into_iter();
    let first = sentences.next().unwrap_or_default();
    page = page.with(Block::verdict(tone, first));
    page = sentences.fold(page, |page, s| page.with(Block::text(s)));
    page = page
        .with(Block::heading("Over the path"))
        .with(Block::Chart(figures::course(result)));
    if result.support != Support::Rigid {
        page = page
            .with(Block::heading("On the part"))
            .with(Block::Chart(figures::map(result)));
    }
    page = page
        .with(Block::heading("What is left of the stock"))
        .with(Block::Chart(figures::left(result)));
    let remarks = account::remarks(result);
    if remarks.is_empty() {
        return page;
    }
    page.with(Block::details(
        "Remarks",
        remarks.into_iter().map(Block::text).collect(),
    ))
}
