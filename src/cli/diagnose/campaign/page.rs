//! The story of a campaign as a page: what is wrong, why, how sure, what naming it gained, what remains,
//! what to measure next; then every experiment by itself.

use super::{errors, tables};
use crate::cli::diagnose::{next as proposed, page};
use crate::findings::Verdict;
use crate::findings::campaign::Campaign;
use crate::findings::campaign::DiagnosedFile;
use crate::findings::sentence::candidates;
use crate::sheet::page::{Block, Page};

/// The story of the campaign, then each file's.
pub fn story(campaign: &Campaign) -> Page {
    let subtitle = format!("{} files", campaign.files.len());
    let title = format!("Diagnosis of {}", campaign.place.campaign);
    let mut page = Page::new(title, subtitle);
    page.synthetic = campaign.synthetic();
    let tone = page::tone(campaign.verdict);
    page.blocks.push(Block::verdict(tone, campaign.sentence()));
    let chapters = [
        ("What is wrong", wrong(campaign)),
        ("Why, how sure, and what naming it gained", why(campaign)),
        ("What remains", remains(campaign)),
        ("What to measure next", next(campaign)),
        ("Experiment by experiment", single(campaign)),
    ];
    for (heading, blocks) in chapters {
        if !blocks.is_empty() {
            page.blocks.push(Block::heading(heading));
            page.blocks.extend(blocks);
        }
    }
    page
}

fn wrong(campaign: &Campaign) -> Vec<Block> {
    let figure = errors::figure(&campaign.files, campaign.synthetic());
    let figure = figure.into_iter().map(Block::Chart);
    figure
        .chain([Block::Table(tables::overview(campaign))])
        .collect()
}

fn why(campaign: &Campaign) -> Vec<Block> {
    let together = campaign.joined().map(tables::together);
    let tables = [tables::causes(campaign)].into_iter().chain(together);
    let tables = tables.chain([tables::checked(campaign)]);
    let told = tables.filter(|table| !table.rows.is_empty());
    let settled = campaign.settled().into_iter().map(Block::text);
    told.map(Block::Table).chain(settled).collect()
}

fn remains(campaign: &Campaign) -> Vec<Block> {
    let open = |one: &&DiagnosedFile| {
        let verdict = one.found.answer().verdict;
        verdict == Verdict::PartlyExplained || verdict == Verdict::UnknownCause
    };
    let files = campaign.files.iter();
    let mut said: Vec<String> = files
        .clone()
        .filter(open)
        .map(|one| {
            let seen = &one.found.answer().unexplained.description;
            format!("{}, without an explanation: {seen}", one.stem())
        })
        .collect();
    if said.is_empty() {
        said.push(
            "No experiment shows more than its noise once the causes are in the model.".into(),
        );
    }
    said.extend(files.filter_map(|one| Some(format!("{}: {}", one.stem(), one.found.unseen()?))));
    said.extend(campaign.remarks.clone());
    said.into_iter().map(Block::text).collect()
}

fn next(campaign: &Campaign) -> Vec<Block> {
    let mut blocks: Vec<Block> = open_questions(campaign).map(Block::text).collect();
    if let Some(proposal) = &campaign.next {
        blocks.push(Block::text(proposed::sentence(proposal)));
        blocks.extend(proposed::setups(proposal));
        let summary = "How well each place is known, before and after these set-ups";
        blocks.push(Block::details(summary, vec![proposed::spreads(proposal)]));
    }
    blocks
}

fn open_questions(campaign: &Campaign) -> impl Iterator<Item = String> {
    campaign.files.iter().flat_map(|one| {
        let groups = one.found.answer().groups.iter();
        let open = groups.filter(|group| campaign.told(group).is_none());
        open.map(|group| {
            let which = candidates(group);
            format!(
                "{}: to tell apart {which}: {}.",
                one.stem(),
                group.would_tell
            )
        })
    })
}

fn single(campaign: &Campaign) -> Vec<Block> {
    let folded = campaign.files.iter().map(|one| {
        let inside = page::page(one.found.as_ref(), &one.stem()).blocks;
        let verdict = page::spoken(one.found.answer().verdict);
        Block::details(format!("{}: {verdict}", one.stem()), inside)
    });
    folded.collect()
}
