//! A plan of set-ups with what it starts from, as it is shown.

use super::start::Start;
use super::{figure, tables};
use crate::cli::diagnose::One;
use crate::findings::Answer;
use crate::findings::next_setups::{Desk, Plan};
use crate::ground::problem::Outcome;
use crate::measurement::workspace::Place;
use crate::sheet::page::{Block, Page, Tone};

/// Set-ups that a campaign's own report proposes.
const COUNT: usize = 5;

/// A plan.
pub struct Proposal {
    /// What it starts from.
    pub start: Start,
    /// The set-ups.
    pub plan: Plan,
    /// Number of pairs of places that the diagnosis left open.
    pub open: usize,
}

impl Proposal {
    /// The `count` set-ups that tell most; `answer`: of the diagnosis of the points.
    pub fn new(start: Start, answer: Option<&Answer>, count: usize) -> Self {
        let open = answer.map_or_else(Vec::new, open);
        let desk = Desk::new(&start.base.robot, &start.tests, start.points.as_ref());
        Self {
            plan: desk.plan(count, &open),
            open: open.len(),
            start,
        }
    }

    /// For a campaign whose files are diagnosed already; `None` if none of them names a robot.
    ///
    /// # Errors
    /// Several workspace tests to choose from, or a robot that cannot be simulated.
    pub fn of_campaign(place: &Place, files: &[One]) -> Outcome<Option<Self>> {
        let start = Start::campaign(place.clone())?;
        Ok(start.map(|start| {
            let points = start.points.as_ref().map(|test| &test.path);
            let own = files
                .iter()
                .find(|one| Some(one.path()) == points.map(|p| p.as_path()));
            Self::new(start, own.map(|one| one.found.answer()), COUNT)
        }))
    }

    /// What the plan is worth, in words.
    pub fn sentence(&self) -> String {
        tables::sentence(&self.plan, self.open)
    }

    /// The set-ups as a table and as a picture.
    pub fn setups(&self) -> [Block; 2] {
        let robot = &self.start.base.robot;
        [
            Block::Table(tables::setups(&self.plan)),
            Block::Chart(figure::poses(robot, &self.plan, self.start.synthetic)),
        ]
    }

    /// What they leave open.
    pub fn spreads(&self) -> Block {
        Block::Table(tables::spreads(&self.plan))
    }

    /// The whole page.
    pub fn page(&self) -> Page {
        let start = &self.start;
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
            self.plan.compared
        );
        let mut page = Page::new(title, subtitle);
        page.synthetic = start.synthetic;
        page.blocks
            .push(Block::verdict(Tone::Neutral, self.sentence()));
        page.blocks.push(Block::heading("The set-ups"));
        page.blocks.extend(self.setups());
        page.blocks.push(Block::heading("What they leave open"));
        page.blocks.push(self.spreads());
        page
    }
}

/// Pairs of places that a diagnosis cannot tell apart.
fn open(answer: &Answer) -> Vec<(String, String)> {
    let mut pairs = Vec::new();
    for group in &answer.groups {
        for (i, a) in group.sites.iter().enumerate() {
            let others = group.sites[..i].iter().filter(|b| *b != a);
            pairs.extend(others.map(|b| (b.clone(), a.clone())));
        }
    }
    pairs.sort();
    pairs.dedup();
    pairs
}
