//! The report page of `ident force`.

use super::{Found, figures, tables};
use crate::sheet::page::{Block, Page, Tone};

/// Cuts whose wave forms are drawn in full; the others are folded away.
const SHOWN: usize = 4;

/// The page.
pub fn page(found: &Found) -> Page {
    let mut page = Page::new(format!("Cutting force: {}", found.name), subtitle(found));
    page.synthetic = found.synthetic();
    for (tone, sentence) in tables::sentences(found) {
        page = page.with(Block::verdict(tone, sentence));
    }
    for remark in found.remarks() {
        page = page.with(Block::verdict(Tone::Neutral, remark));
    }
    page = page
        .with(Block::Table(tables::parameters(found)))
        .with(Block::heading("Mean forces"))
        .with(Block::Chart(figures::over_feed(found)))
        .with(Block::Table(tables::means(found)))
        .with(Block::heading("Wave forms"));
    let mut waves = (0..found.account.cuts.len()).map(|i| Block::Chart(figures::wave(found, i)));
    for wave in waves.by_ref().take(SHOWN) {
        page = page.with(wave);
    }
    let others: Vec<Block> = waves.collect();
    if !others.is_empty() {
        page = page.with(Block::details("The other cuts", others));
    }
    let nuisance = Block::Table(tables::nuisance(found));
    page.with(Block::details("What was found along", vec![nuisance]))
}

fn subtitle(found: &Found) -> String {
    let name = |f: &crate::measurement::milling_force::MillingForce| {
        let short: String = f.sha256.chars().take(12).collect();
        format!("{} {short}", f.stem())
    };
    let names: Vec<String> = found.files.iter().map(name).collect();
    names.join(", ")
}
