//! What one verb did for a campaign, as a chapter of the campaign's report.

use super::Ending;
use crate::sheet::page::{Block, Page};
use std::path::PathBuf;

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
    /// Verdicts, the first figure and the first table in the open, the rest folded away.
    pub fn blocks(self) -> Vec<Block> {
        let (mut figure, mut table) = (true, true);
        let in_the_open = |block: &Block| match block {
            Block::Verdict { .. } => true,
            Block::Chart(_) => std::mem::take(&mut figure),
            Block::Table(_) => std::mem::take(&mut table),
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

/// Leaves out headings that nothing stands under any more.
fn without_empty_sections(blocks: Vec<Block>) -> Vec<Block> {
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
