//! A proposal as it is shown.

use super::{figure, tables};
use crate::findings::campaign::Proposal;
use crate::sheet::page::{Block, Page, Tone};

/// What the plan is worth, in words.
pub fn sentence(proposal: &Proposal) -> String {
    tables::sentence(&proposal.plan, proposal.open)
}

/// The set-ups as a table and as a picture.
pub fn setups(proposal: &Proposal) -> [Block; 2] {
    let robot = &proposal.start.base.robot;
    [
        Block::Table(tables::setups(&proposal.plan)),
        Block::Chart(figure::poses(
            robot,
            &proposal.plan,
            proposal.start.synthetic,
        )),
    ]
}

/// What they leave open.
pub fn spreads(proposal: &Proposal) -> Block {
    Block::Table(tables::spreads(&proposal.plan))
}

/// The whole page.
pub fn page(proposal: &Proposal) -> Page {
    let start = &proposal.start;
    let title = match start.place.campaign.as_str() {
        "" => format!("What to measure next on {}", start.base.robot.name),
        name => format!("What to measure next: {name}"),
    };
    let points = start.points.as_ref();
    let subtitle = format!(
        "{} with {} axis tests and {} points; {} set-ups compared",
        start.base.path,
        start.tests.len(),
        points.map_or(0, |t| t.facts.joint_angles.len()),
        proposal.plan.compared
    );
    let mut page = Page::new(title, subtitle);
    page.synthetic = start.synthetic;
    page.blocks
        .push(Block::verdict(Tone::Neutral, sentence(proposal)));
    page.blocks.push(Block::heading("The set-ups"));
    page.blocks.extend(setups(proposal));
    page.blocks.push(Block::heading("What they leave open"));
    page.blocks.push(spreads(proposal));
    page
}
