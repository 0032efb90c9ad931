//! The report of an answer: what is wrong, why, how sure, what it gained, what remains, what to
//! measure next.

use super::tables::{candidates_table, causes_table};
use crate::findings::kinds::Diagnosed;
use crate::findings::sentence::{candidates, left, sentences};
use crate::findings::{Answer, Verdict};
use crate::ground::files;
use crate::sheet::page::{Block, Page, Tone};

/// The page of one measurement called `stem`.
pub fn page(result: &dyn Diagnosed, stem: &str) -> Page {
    let (answer, source) = (result.answer(), result.source());
    let name = files::name(source.path);
    let subtitle = format!("{}, from {}", result.about(), name);
    let mut page = Page::new(format!("Diagnosis of {stem}"), subtitle);
    page.synthetic = source.synthetic;
    let mut said = sentences(answer).into_iter();
    let opening = said.next().unwrap_or_default();
    page = page.with(Block::verdict(tone(answer.verdict), opening));
    let besides = result.present().into_iter().chain(result.remarks());
    for said in said.chain(besides) {
        page = page.with(Block::text(said));
    }
    page = page.with(Block::heading(
        "What the simulation shows and what was measured",
    ));
    page = charts(page, result.before_and_after());
    page = why(page, answer);
    page = page
        .with(Block::heading("What remains"))
        .with(Block::text(left(answer)));
    charts(page, result.remaining())
}

fn charts(page: Page, charts: Vec<crate::sheet::chart::Chart>) -> Page {
    charts
        .into_iter()
        .fold(page, |page, chart| page.with(Block::Chart(chart)))
}

fn why(mut page: Page, answer: &Answer) -> Page {
    if !answer.causes.is_empty() || !answer.groups.is_empty() {
        page = page
            .with(Block::heading("Why"))
            .with(Block::Table(causes_table(answer)));
    }
    if !answer.groups.is_empty() {
        page = page.with(Block::heading("What to measure next"));
    }
    for group in &answer.groups {
        let said = format!("{}: {}.", candidates(group), group.would_tell);
        page = page.with(Block::text(format!("To tell apart {said}")));
    }
    if !answer.candidates.is_empty() {
        page = page
            .with(Block::heading("What was compared"))
            .with(Block::Table(candidates_table(answer)));
    }
    page
}

/// How a verdict is meant.
pub fn tone(verdict: Verdict) -> Tone {
    match verdict {
        Verdict::Sufficient => Tone::Good,
        Verdict::Explained => Tone::Neutral,
        Verdict::PartlyExplained | Verdict::CannotTell => Tone::Attention,
        Verdict::UnknownCause => Tone::Bad,
    }
}

/// A verdict in words.
pub fn spoken(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Sufficient => "the simulation is right",
        Verdict::Explained => "explained",
        Verdict::PartlyExplained => "partly explained",
        Verdict::UnknownCause => "unknown cause",
        Verdict::CannotTell => "not told apart",
    }
}
