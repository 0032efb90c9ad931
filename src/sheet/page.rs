//! A page: the story in the order a reader needs it.

use super::chart::Chart;
use super::scene::Scene;
use super::table::Table;
use std::collections::BTreeSet;

/// How a verdict is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Tone {
    /// Nothing to do.
    Good,
    /// For information.
    #[default]
    Neutral,
    /// Needs attention.
    Attention,
    /// Something is wrong.
    Bad,
}

impl Tone {
    /// The word that stands before a verdict, so that it is not told by colour alone.
    pub fn word(self) -> &'static str {
        match self {
            Tone::Good => "Good",
            Tone::Neutral => "Note",
            Tone::Attention => "Attention",
            Tone::Bad => "Wrong",
        }
    }
}

/// Heading of the section that begins on a sheet of its own where a page is printed.
pub const APPENDIX: &str = "Appendix";

/// One piece of a page.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// Starts a section.
    Heading(String),
    /// A sentence that an engineer can act on.
    Verdict {
        /// How it is meant.
        tone: Tone,
        /// The whole sentence.
        sentence: String,
    },
    /// A paragraph.
    Text(String),
    /// A table.
    Table(Table),
    /// A figure.
    Chart(Chart),
    /// A view in space, beside a figure that shows the same on paper.
    Scene(Scene),
    /// Folded away until asked for.
    Details {
        /// What is inside.
        summary: String,
        /// The inside.
        blocks: Vec<Block>,
    },
}

impl Block {
    /// A heading.
    pub fn heading(text: impl Into<String>) -> Self {
        Block::Heading(text.into())
    }

    /// A verdict.
    pub fn verdict(tone: Tone, sentence: impl Into<String>) -> Self {
        let sentence = sentence.into();
        Block::Verdict { tone, sentence }
    }

    /// A paragraph.
    pub fn text(text: impl Into<String>) -> Self {
        Block::Text(text.into())
    }

    /// Blocks folded away.
    pub fn details(summary: impl Into<String>, blocks: Vec<Block>) -> Self {
        let summary = summary.into();
        Block::Details { summary, blocks }
    }
}

/// A whole report.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Page {
    /// Its title.
    pub title: String,
    /// One line below the title: what it was made from.
    pub subtitle: String,
    /// Rests on data that nobody measured: labelled so at the top.
    pub synthetic: bool,
    /// The story.
    pub blocks: Vec<Block>,
}

impl Page {
    /// A page without blocks.
    pub fn new(title: impl Into<String>, subtitle: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            subtitle: subtitle.into(),
            ..Self::default()
        }
    }

    /// The same page with one more block.
    #[must_use]
    pub fn with(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// All charts in reading order, each with a file stem that no other has.
    pub fn figures(&self) -> Vec<(String, &Chart)> {
        let mut charts = Vec::new();
        collect(&self.blocks, &mut charts);
        let mut taken = BTreeSet::new();
        let named = charts.into_iter();
        named
            .map(|c| (free(&stem(&c.name), &mut taken), c))
            .collect()
    }
}

fn collect<'a>(blocks: &'a [Block], charts: &mut Vec<&'a Chart>) {
    for block in blocks {
        match block {
            Block::Chart(chart) => charts.push(chart),
            Block::Details { blocks, .. } => collect(blocks, charts),
            _ => {}
        }
    }
}

/// A name as part of a file name or an identifier: ASCII letters, digits, `-` and `_`.
pub fn stem(name: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let text: String = name
        .chars()
        .map(|c| if plain(c) { c } else { '-' })
        .collect();
    let text = text.trim_matches('-');
    if text.is_empty() { "figure" } else { text }.to_string()
}

/// File name of a figure that [`Page::figures`] gave this stem: the chart's own name where that can be
/// one, so that `Prüfung 6°` stays readable.
pub fn file(named: &str, chart: &Chart) -> String {
    let whole = named == stem(&chart.name) && !chart.name.is_empty();
    match whole && !chart.name.contains(['/', '\\']) {
        true => format!("{}.svg", chart.name),
        false => format!("{named}.svg"),
    }
}

fn free(stem: &str, taken: &mut BTreeSet<String>) -> String {
    let numbered = (2..).map(|n| format!("{stem}-{n}"));
    let mut candidates = std::iter::once(stem.to_string()).chain(numbered);
    // File systems that ignore case must not lose a figure.
    let found = candidates.find(|name| taken.insert(name.to_lowercase()));
    found.expect("the numbers do not end")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_distinct_plain_names() {
        let chart = |name: &str| Block::Chart(Chart::new(name, "", ""));
        let page = Page::new("t", "s").with(chart("a b/ö")).with(chart("loop"));
        let page = page.with(Block::details("more", vec![chart("Loop"), chart("")]));
        let names: Vec<_> = page.figures().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["a-b", "loop", "Loop-2", "figure"]);
        let files: Vec<_> = page
            .figures()
            .into_iter()
            .map(|(s, c)| file(&s, c))
            .collect();
        assert_eq!(files, ["a-b.svg", "loop.svg", "Loop-2.svg", "figure.svg"]);
        assert_eq!(file("a-b", &Chart::new("a b", "", "")), "a b.svg");
    }
}
