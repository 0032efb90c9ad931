//! The story of a campaign as a page.

use super::{Campaign, errors, tables};
use crate::cli::diagnose::page;
use crate::sheet::page::{Block, Page};

/// The story of the campaign, then each file's.
pub fn story(campaign: &Campaign) -> Page {
    let subtitle = format!("{} files", campaign.files.len());
    let mut page = Page::new(
        format!("Diagnosis of {}", campaign.place.campaign),
        subtitle,
    );
    page.synthetic = campaign.synthetic();
    page = page
        .with(Block::verdict(
            page::tone(campaign.verdict),
            campaign.sentence(),
        ))
        .with(Block::heading("What is wrong, and why"));
    let figure = errors::figure(&campaign.files, campaign.synthetic());
    page = figure
        .into_iter()
        .fold(page, |page, chart| page.with(Block::Chart(chart)));
    page = page.with(Block::Table(tables::overview(campaign)));
    if let Some(joint) = campaign.joined() {
        page = page.with(Block::Table(tables::together(joint)));
        let settled = campaign.settled().into_iter();
        page = settled.fold(page, |page, said| page.with(Block::text(said)));
    }
    if !campaign.checks.is_empty() {
        page = page.with(Block::Table(tables::checked(campaign)));
    }
    let open: Vec<String> = open_questions(campaign);
    if !open.is_empty() {
        page = page.with(Block::heading("What to measure next"));
    }
    page = open
        .into_iter()
        .fold(page, |page, said| page.with(Block::text(said)));
    page = page.with(Block::heading("Experiment by experiment"));
    for one in &campaign.files {
        let inside = page::page(one.found.as_ref(), &one.stem()).blocks;
        let title = format!("{}: {}", one.stem(), one.found.answer().verdict.name());
        page = page.with(Block::details(title, inside));
    }
    page
}

fn open_questions(campaign: &Campaign) -> Vec<String> {
    let groups = campaign.files.iter().flat_map(|one| {
        let groups = one.found.answer().groups.iter();
        let open = groups.filter(|g| campaign.told(g).is_none());
        open.map(|g| {
            format!(
                "{}, to tell {}: {}.",
                one.stem(),
                g.effects.join(" from "),
                g.would_tell
            )
        })
    });
    groups.collect()
}
