//! The report page of `ident validate`.

use super::{Validated, figures, provenance, tables};
use crate::sheet::page::{Block, Page, Tone};

/// The page.
pub fn page(validated: &Validated) -> Page {
    let title = match validated.place.campaign.as_str() {
        "" => "Validation in the workspace".to_string(),
        name => format!("Validation in the workspace: {name}"),
    };
    let mut page = Page::new(title, subtitle(validated));
    page.synthetic = validated.test.facts.synthetic;
    for (tone, sentence) in tables::sentences(validated) {
        page = page.with(Block::verdict(tone, sentence));
    }
    for warning in &validated.found.warnings {
        page = page.with(Block::verdict(Tone::Attention, capital(warning)));
    }
    page = page
        .with(Block::heading("Measured and simulated"))
        .with(Block::Chart(figures::stiffness(validated)))
        .with(Block::Table(tables::points(validated)))
        .with(Block::Chart(figures::errors(validated)))
        .with(Block::heading("Where it was measured"));
    if let Some(scene) = figures::space(validated) {
        page = page.with(Block::Scene(scene));
    }
    page.with(Block::Chart(figures::map(validated)))
        .with(Block::heading("Re-identified"))
        .with(Block::Table(tables::parameters(validated)))
        .with(Block::Table(tables::inseparable(&validated.found)))
}

fn subtitle(validated: &Validated) -> String {
    format!(
        "{} with the robot {}, {} axis tests",
        provenance(&validated.test),
        validated.base.path,
        validated.tests.len()
    )
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    format!("{}{}.", first.unwrap_or_default(), letters.as_str())
}
