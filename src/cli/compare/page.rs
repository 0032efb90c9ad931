//! The report page of `ident compare`.

use super::{alone, causes, sentence, told, verdict};
use crate::fit::compare::{Comparison, Pair};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::{ABSENT, significant};
use crate::sheet::page::{Block, Page, Tone};
use crate::sheet::table::Table;

/// The page.
pub fn page(names: &[String; 2], comparison: &Comparison) -> Page {
    let subtitle = format!("from {} to {}", names[0], names[1]);
    let mut page = Page::new("What changed", subtitle);
    let tone = match comparison.changed().is_empty() {
        true => Tone::Good,
        false => Tone::Attention,
    };
    page = page.with(Block::verdict(tone, verdict(comparison)));
    for pair in comparison.changed() {
        page = page.with(Block::text(sentence(pair)));
    }
    for line in causes::sentences(comparison) {
        page = page.with(Block::text(line));
    }
    page = page
        .with(Block::Chart(chart(comparison)))
        .with(Block::Table(table(comparison)));
    let lines = alone(names, comparison);
    lines
        .into_iter()
        .fold(page, |page, line| page.with(Block::text(line)))
}

fn judged(comparison: &Comparison) -> impl Iterator<Item = (&Pair, f64)> {
    let pairs = comparison.pairs.iter();
    pairs.filter_map(|pair| Some((pair, pair.in_errors()?)))
}

fn chart(comparison: &Comparison) -> Chart {
    let sites = judged(comparison).map(|(pair, _)| {
        let parameter = &pair.sides[0];
        format!("{} {}", parameter.site, parameter.name)
    });
    let sizes: Vec<f64> = judged(comparison).map(|(_, size)| size).collect();
    let panel = Panel::new(
        Axis::new("Parameter", ""),
        Axis::new("Change", "standard errors"),
    )
    .over(sites)
    .with(Series::bars("after less before", &sizes));
    Chart::new(
        "changes",
        "Changes in their standard errors",
        "After less before, over the standard error of both sides together.",
    )
    .with(panel)
}

fn table(comparison: &Comparison) -> Table {
    let header = [
        "fit",
        "parameter",
        "site",
        "unit",
        "before",
        "after",
        "standard errors",
        "changed",
    ];
    let table = Table::new("All parameters", header).numeric([4, 5, 6]);
    let row = |pair: &Pair| {
        let [before, after] = &pair.sides;
        [
            pair.fit.clone(),
            before.name.clone(),
            before.site.clone(),
            before.unit.clone(),
            told(before),
            told(after),
            pair.in_errors()
                .map_or(ABSENT.into(), |n| significant(n, 2)),
            if pair.changed { "yes" } else { "no" }.to_string(),
        ]
    };
    let noted = "Changed: beyond the intervals at 5 % for all parameters together (Holm 1979). Levers of both sides count as independent.";
    let table = comparison
        .pairs
        .iter()
        .fold(table, |table, pair| table.with(row(pair)));
    table.noted(noted)
}
