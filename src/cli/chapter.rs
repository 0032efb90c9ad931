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
    /// Verdicts first and in the open, the rest folded away.
    pub fn blocks(self) -> Vec<Block> {
        let is_verdict = |block: &Block| matches!(block, Block::Verdict { .. });
        let (mut open, rest): (Vec<Block>, Vec<Block>) =
            self.page.blocks.into_iter().partition(is_verdict);
        open.insert(0, Block::heading(&self.title));
        open.push(Block::details(
            format!("{}: tables and figures", self.title),
            rest,
        ));
        open
    }
}
