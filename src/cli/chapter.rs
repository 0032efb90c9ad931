//! What one verb did for a campaign, as a chapter of the campaign's report.

use super::Ending;
use crate::fit::suitability::Doubt;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::job::Job;
use crate::measurement::test::{Kind, Test};
use crate::measurement::toolpath::Toolpath;
use crate::measurement::workspace::Place;
use crate::process::Planned;
use crate::robot::load::load;
use crate::sheet::page::{Block, Page, Tone};
use std::path::PathBuf;

/// Rows from which a table is folded away.
const LONG: usize = 20;

/// A chapter.
pub struct Chapter {
    /// Its title.
    pub title: String,
    /// How the verb ended.
    pub ending: Ending,
    /// The files it rests on, with their hashes.
    pub inputs: Vec<(PathBuf, String)>,
    /// Its page.
    pub page: Page,
}

impl Chapter {
    /// A file that cannot carry a number: its name, with its hash, and why.
    pub fn withheld(title: String, input: (PathBuf, String), why: &Problem) -> Self {
        let said = format!("{title}: {}; {}.", why.what, why.remedy);
        let page = Page::new(title.as_str(), "withheld");
        Self {
            title,
            ending: Ending::Attention,
            inputs: vec![input],
            page: page.with(Block::verdict(Tone::Attention, said)),
        }
    }

    /// The files of a kind in a campaign, each by itself, withheld where it does not pass; none of none.
    ///
    /// # Errors
    /// A file that cannot be read, and what `one` refuses.
    pub fn of_each<F: Kind>(
        place: &Place,
        title: &str,
        passed: impl Fn(&Test<F>) -> Outcome<Vec<Doubt>>,
        one: impl Fn(PathBuf) -> Outcome<Self>,
    ) -> Outcome<Option<Self>> {
        let part = |file: PathBuf| {
            let test = Test::<F>::read(&file)?;
            match passed(&test) {
                Ok(_) => one(file),
                Err(why) => Ok(Self::withheld(test.stem(), test.input(), &why)),
            }
        };
        let parts = place.files_of(F::NAME)?.into_iter().map(part);
        Ok(Self::together(title, parts.collect::<Outcome<Vec<_>>>()?))
    }

    /// The chapters of several files as one; none of none.
    pub fn together(title: &str, parts: Vec<Self>) -> Option<Self> {
        let several = parts.len() > 1;
        let mut parts = parts.into_iter();
        let mut whole = parts.next()?;
        if several {
            let head = Block::heading(&whole.title);
            whole.page.blocks.insert(0, head);
        }
        whole.title = title.into();
        for part in parts {
            if part.ending == Ending::Attention {
                whole.ending = Ending::Attention;
            }
            whole.inputs.extend(part.inputs);
            whole.page.synthetic |= part.page.synthetic;
            whole.page.blocks.push(Block::heading(&part.title));
            whole.page.blocks.extend(part.page.blocks);
        }
        Some(whole)
    }

    /// Verdicts, the first figure and the first table in the open, the rest folded away.
    pub fn blocks(self) -> Vec<Block> {
        let (mut figure, mut table) = (true, true);
        let in_the_open = |block: &Block| match block {
            Block::Verdict { .. } => true,
            Block::Chart(_) => std::mem::take(&mut figure),
            // A long one beside the figure that shows it belongs to the rest.
            Block::Table(rows) => rows.rows.len() <= LONG && std::mem::take(&mut table),
            _ => false,
        };
        let (mut open, rest): (Vec<Block>, Vec<Block>) =
            self.page.blocks.into_iter().partition(in_the_open);
        open.insert(0, Block::heading(&self.title));
        let more = format!("{}: more tables and figures", self.title);
        open.push(Block::details(more, without_empty_sections(rest)));
        open
    }
}

/// The job of a campaign's part, `measurements/<campaign>/part/job.toml`, if there is one.
fn part(place: &Place) -> Option<PathBuf> {
    let job = place.measurements().join("part").join("job.toml");
    job.is_file().then_some(job)
}

/// The part of a campaign, planned with the robot that the campaign identified, where its job names the one that
/// this started from.
///
/// # Errors
/// Whatever cannot be read; a place that the robot does not reach.
pub fn planned_part(place: &Place) -> Outcome<Option<Planned>> {
    let Some(path) = part(place) else {
        return Ok(None);
    };
    let mut job = Job::read(&path)?;
    let toolpath = Toolpath::read(&job.toolpath)?;
    let identified = place.fits().join("robot.toml");
    if identified.is_file() {
        let own = identified.display().to_string();
        let named = load(&job.robot, Some(&job.path))?.robot.name;
        if load(&own, None)?.robot.name == named {
            job.robot = own;
        }
    }
    let planned = Planned::of(job, toolpath)?;
    planned.map(Some).map_err(|unplanned| unplanned.problem)
}

/// Leaves out headings that nothing stands under any more.
pub fn without_empty_sections(blocks: Vec<Block>) -> Vec<Block> {
    let is_heading = |block: &Block| matches!(block, Block::Heading(_));
    let next = blocks.iter().skip(1).map(is_heading).chain([true]);
    let empty: Vec<bool> = blocks
        .iter()
        .zip(next)
        .map(|(b, next)| is_heading(b) && next)
        .collect();
    let kept = blocks.into_iter().zip(empty).filter(|(_, empty)| !empty);
    kept.map(|(block, _)| block).collect()
}
