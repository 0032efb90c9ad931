//! The account of a run: cause by cause, and what stated probabilities are worth.

use super::super::{Judged, same};
use ident::findings::Verdict;
use std::collections::BTreeMap;

/// Of one effect: visible truths, named ones, and how often it was named where it is not.
#[derive(Default, Clone, Copy)]
struct Row {
    all: usize,
    named: usize,
    untrue: usize,
}

fn untrue(one: &Judged) -> Vec<String> {
    let truths = &one.case.truths;
    let grouped = |e: &str| {
        one.groups.iter().any(|g| {
            g.iter().any(|m| m.0 == e)
                && g.iter().any(|(e, s)| truths.iter().any(|t| same(t, e, s)))
        })
    };
    let stray =
        |c: &&(String, String, f64)| !truths.iter().any(|t| same(t, &c.0, &c.1)) && !grouped(&c.0);
    one.causes
        .iter()
        .filter(stray)
        .map(|c| c.0.clone())
        .collect()
}

/// Whether a shape that nobody knows is said to be one, or at least nothing is said with certainty.
fn careful(one: &Judged) -> bool {
    one.flagged()
        || one.verdict == Verdict::CannotTell
        || one.verdict != Verdict::Sufficient && one.causes.iter().all(|c| c.2 < 0.9)
}

/// Prints the misses and the table.
pub fn table(all: &[Judged]) {
    for one in all.iter().filter(|j| !j.right()) {
        println!("{}", super::super::line("load-cycle", one));
    }
    let mut rows = BTreeMap::<&str, Row>::new();
    let mut names = BTreeMap::<String, usize>::new();
    let inside = all.iter().filter(|j| j.case.class() != "outside");
    for one in inside {
        for truth in one.case.visible() {
            let row = rows.entry(truth.effect).or_default();
            row.all += 1;
            row.named += usize::from(one.names(truth));
        }
        for name in untrue(one) {
            *names.entry(name).or_default() += 1;
        }
    }
    for (effect, row) in &rows {
        let untrue = names.remove(*effect).unwrap_or(row.untrue);
        println!(
            "| {effect} | visible {} | named {} | missed {} | named where it is not {untrue} |",
            row.all,
            row.named,
            row.all - row.named
        );
    }
    for (effect, untrue) in names {
        println!("| {effect} | visible 0 | named 0 | missed 0 | named where it is not {untrue} |");
    }
    let outside: Vec<&Judged> = all.iter().filter(|j| j.case.class() == "outside").collect();
    let count = |f: &dyn Fn(&&&Judged) -> bool| outside.iter().filter(f).count();
    println!(
        "outside: {} cases, flagged {}, flagged or not certain {}",
        outside.len(),
        count(&|j| j.flagged()),
        count(&|j| careful(j))
    );
    reliability(all);
}

fn reliability(all: &[Judged]) {
    for (low, high) in [(0.0, 0.5), (0.5, 0.9), (0.9, 0.98), (0.98, 1.01)] {
        let (mut told, mut right, mut sum) = (0, 0, 0.0);
        for one in all {
            for (effect, site, p) in one.causes.iter().filter(|c| (low..high).contains(&c.2)) {
                told += 1;
                sum += p;
                right += usize::from(one.case.truths.iter().any(|t| same(t, effect, site)));
            }
        }
        if told > 0 {
            println!(
                "stated {low} to {}: {:.3} on average, true {right} of {told}",
                f64::min(high, 1.0),
                sum / f64::from(told)
            );
        }
    }
}
