//! The diagnosis of load cycles before data by strangers: `tests/stranger_generator`.
//!
//! `IDENT_STRANGER_SEED` and `IDENT_STRANGER_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses.
//! `cargo test --test suite stranger:: -- --nocapture` prints the rates.

use crate::common::few_or_all;
use crate::stranger_generator;

use crate::stranger_generator::Case;
use ident::findings::{Diagnosis, Settings, Verdict, diagnose};
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;
use rayon::prelude::*;
use std::path::Path;

fn run(case: &Case) -> Diagnosis {
    let bytes = case.csv.as_bytes();
    let table = Table::from_reader(Path::new("case.csv"), bytes, bytes.len() as u64).unwrap();
    diagnose(&LoadCycle::from_table(table).unwrap(), &Settings::default())
}

/// How an answer compares with the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Score {
    /// Everything true is named, alone or in a group of at most three, and nothing else.
    right: bool,
    /// Something is named that is not true.
    wrong: bool,
    /// Something is said to be left.
    flagged: bool,
}

fn score(case: &Case, found: &Diagnosis) -> Score {
    let mut missing: Vec<&str> = case.truths.clone();
    let mut strays = 0;
    let causes = found.causes.iter().map(|c| vec![c.effect]);
    let groups = found.groups.iter().map(|g| g.effects.clone());
    for names in causes.chain(groups) {
        let hit = missing
            .iter()
            .position(|t| names.contains(t) && names.len() <= 3);
        match hit {
            Some(at) => {
                missing.remove(at);
            }
            None => strays += 1,
        }
    }
    let flagged = matches!(
        found.verdict,
        Verdict::UnknownCause | Verdict::PartlyExplained
    );
    Score {
        right: missing.is_empty() && strays == 0,
        wrong: strays > 0,
        flagged,
    }
}

fn kind(case: &Case) -> &'static str {
    match case.truths[..] {
        [] => "clean",
        [one] if one.starts_with("outside") => "outside",
        [_] => "single",
        _ => "pair",
    }
}

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|v| v.parse().ok())
}

fn describe(case: &Case, found: &Diagnosis) -> String {
    let causes = found.causes.iter();
    let causes = causes.map(|c| format!("{} {:.2}", c.effect, c.probability));
    let groups = found
        .groups
        .iter()
        .map(|g| format!("{{{}}}", g.effects.join("|")));
    let all: Vec<String> = causes.chain(groups).collect();
    format!(
        "# {} {} {:?} {:?} x{:.1?} {} / {} n{} -> {} {} (left {:.2})",
        case.seed,
        kind(case),
        case.truths,
        case.laws,
        case.strengths,
        case.schedule,
        case.noise,
        case.rows,
        all.join(" + "),
        found.verdict.name(),
        found.unexplained.share_of_variance,
    )
}

/// Counts of one kind of case.
#[derive(Default, Debug, Clone, Copy)]
struct Count {
    all: usize,
    good: usize,
    wrong: usize,
}

impl Count {
    fn rate(&self) -> f64 {
        self.good as f64 / self.all.max(1) as f64
    }
}

/// Classes of stated probability.
const CLASSES: [(f64, f64); 6] = [
    (0.0, 0.5),
    (0.5, 0.7),
    (0.7, 0.85),
    (0.85, 0.95),
    (0.95, 0.98),
    (0.98, 1.0),
];

/// How often a cause that is named alone is true, by the probability that was stated for it. What is named
/// beside something outside the library counts: nobody who reads the file knows that it is.
fn reliability(judged: &[(Case, Diagnosis)]) {
    let each = judged.iter().flat_map(|(case, found)| {
        let own = found.causes.iter();
        own.map(|c| (c.probability, case.truths.contains(&c.effect)))
    });
    let stated: Vec<(f64, bool)> = each.collect();
    println!("stated     mean   true  of");
    for (low, high) in CLASSES {
        let own: Vec<&(f64, bool)> = stated
            .iter()
            .filter(|(p, _)| low <= *p && *p < high)
            .collect();
        let (n, right) = (own.len(), own.iter().filter(|(_, t)| *t).count());
        let share = |sum: f64| sum / n.max(1) as f64;
        println!(
            "{low:.2}-{high:.2} {:6.3} {:6.3} {n:3}",
            share(own.iter().map(|(p, _)| p).sum()),
            share(right as f64)
        );
    }
}

#[test]
fn data_by_strangers_are_judged_rightly() {
    let base = number("IDENT_STRANGER_SEED").unwrap_or(1) * 100_000;
    let count = number("IDENT_STRANGER_CASES").unwrap_or_else(|| few_or_all(30, 60));
    let seeds: Vec<u64> = (base..base + count).collect();
    let judged: Vec<(Case, Diagnosis)> = seeds
        .par_iter()
        .map(|seed| {
            let case = stranger_generator::draw(*seed);
            let found = run(&case);
            (case, found)
        })
        .collect();
    let mut counts = std::collections::BTreeMap::<&str, Count>::new();
    for (case, found) in &judged {
        let (own, score) = (counts.entry(kind(case)).or_default(), score(case, found));
        let good = match kind(case) {
            "clean" => score.right && found.verdict == Verdict::Sufficient,
            "outside" => score.flagged,
            _ => score.right,
        };
        own.all += 1;
        own.good += usize::from(good);
        own.wrong += usize::from(score.wrong && kind(case) != "outside");
        if (!good || score.wrong) && std::env::var("IDENT_DEBUG").is_ok() {
            println!("{}", describe(case, found));
            for doubt in &found.doubts {
                println!("      {doubt:?}");
            }
            for (names, p, nats) in found.candidates.iter().take(5) {
                println!("      {p:.3} {nats:7.1} {}", names.join(" + "));
            }
        }
    }
    let of = |name: &str| counts.get(name).copied().unwrap_or_default();
    let named = [of("single"), of("pair")];
    let wrong = named.iter().map(|c| c.wrong).sum::<usize>() as f64
        / named.iter().map(|c| c.all).sum::<usize>().max(1) as f64;
    println!("{counts:?} wrong {wrong:.3}");
    reliability(&judged);
    assert!(of("single").rate() >= SINGLES, "single causes");
    assert!(of("clean").rate() >= CLEAN, "clean files");
    assert!(wrong <= WRONG, "wrong or invented causes");
}

/// Rates of families of shapes over 360 cases of three other seeds (single 0.77 to 0.92, clean 0.90 to 0.98,
/// wrong 0.065 to 0.113) less what a sample of this size may fall short by chance.
const SINGLES: f64 = 0.7;
const CLEAN: f64 = 0.8;
const WRONG: f64 = 0.2;
