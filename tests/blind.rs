//! The tests hide an effect in the data and require finding it.
//!
//! The generator is written independently of `src/effects`. Seeds are fixed ones and ones that
//! change with the day; `IDENT_BLIND_SEED` and `IDENT_BLIND_CASES` choose others.

mod blind_generator;

use blind_generator::{Case, EFFECTS, OUTSIDE};
use ident::findings::{Diagnosis, Settings, Verdict, diagnose};
use ident::measurement::load_cycle::LoadCycle;
use std::collections::BTreeMap;

fn run(case: &Case) -> Diagnosis {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.csv");
    std::fs::write(&path, &case.csv).unwrap();
    diagnose(&LoadCycle::read(&path).unwrap(), &Settings::default())
}

fn answer(diagnosis: &Diagnosis) -> String {
    let mut parts: Vec<String> = diagnosis
        .causes
        .iter()
        .map(|c| c.effect.to_string())
        .collect();
    parts.extend(
        diagnosis
            .groups
            .iter()
            .map(|g| format!("{{{}}}", g.effects.join("|"))),
    );
    let verdict = diagnosis.verdict;
    if matches!(verdict, Verdict::UnknownCause | Verdict::PartlyExplained) || parts.is_empty() {
        parts.push(verdict.name().to_uppercase());
    }
    parts.join("+")
}

/// How an answer compares with the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Score {
    Exact,
    Covered,
    Extra,
    Missed,
    Wrong,
}

fn score(case: &Case, diagnosis: &Diagnosis) -> Score {
    let mut truths: Vec<&str> = case.truths.iter().map(|t| t.effect).collect();
    let named: Vec<&str> = diagnosis.causes.iter().map(|c| c.effect).collect();
    let right = named.iter().filter(|n| truths.contains(n)).count();
    let wrong = named.len() - right;
    truths.retain(|t| !named.contains(t));
    let mut stray = 0;
    for group in &diagnosis.groups {
        match truths
            .iter()
            .position(|t| group.effects.contains(t) && group.effects.len() <= 3)
        {
            Some(k) => {
                truths.remove(k);
            }
            None => stray += 1,
        }
    }
    let unknown = matches!(
        diagnosis.verdict,
        Verdict::UnknownCause | Verdict::PartlyExplained
    );
    match (truths.is_empty(), wrong + stray, unknown) {
        (true, 0, false) if diagnosis.groups.is_empty() => Score::Exact,
        (true, 0, false) => Score::Covered,
        (true, _, _) => Score::Extra,
        (false, 0, _) => Score::Missed,
        (false, _, _) => Score::Wrong,
    }
}

#[test]
#[ignore]
fn explore() {
    use rayon::prelude::*;
    let number = |name: &str, other: u64| {
        std::env::var(name)
            .ok()
            .and_then(|v| v.parse().ok())
            .unwrap_or(other)
    };
    let (n, seed) = (number("N", 10), number("SEED", 1));
    let only = std::env::var("ONLY").unwrap_or_default();
    let debug = std::env::var("IDENT_DEBUG").is_ok();
    let wanted = |name: &str| {
        only.is_empty()
            || only.split(',').any(|o| {
                o == name
                    || (o == "outside" && name.starts_with("outside"))
                    || (o == "singles" && EFFECTS.contains(&name))
            })
    };
    let kinds: Vec<&str> = EFFECTS
        .iter()
        .copied()
        .chain(["clean", "pair"])
        .chain(OUTSIDE.iter().copied())
        .collect();
    for effect in kinds {
        if !wanted(effect) {
            continue;
        }
        let one = |i: u64| {
            let s = seed * 1000 + i;
            let case = match effect {
                "clean" => blind_generator::clean(s),
                "pair" => blind_generator::random_pair(s),
                e if e.starts_with("outside") => blind_generator::outside(e, s),
                e => blind_generator::single(e, s),
            };
            if debug {
                let t: Vec<String> = case
                    .truths
                    .iter()
                    .map(|t| format!("{} x{:.1} {:?}", t.effect, t.strength, t.parameters))
                    .collect();
                eprintln!(
                    "--- {effect} seed {s} {} {} n{} lasers {} outliers {} noise {:.3e} truth {:?}",
                    case.schedule,
                    case.noise,
                    case.samples,
                    case.lasers,
                    case.outliers,
                    case.noise_rms,
                    t
                );
            }
            let d = run(&case);
            if debug {
                eprintln!("  => {} {:?}", answer(&d), d.adequacy);
            }
            let truth = case
                .truths
                .iter()
                .map(|t| t.effect)
                .collect::<Vec<_>>()
                .join("+");
            (
                score(&case, &d),
                format!(
                    "{:?} {} <- {}",
                    score(&case, &d),
                    answer(&d),
                    if effect == "pair" {
                        truth
                    } else {
                        String::new()
                    }
                ),
                s,
            )
        };
        let answers: Vec<(Score, String, u64)> = if debug {
            (0..n).map(one).collect()
        } else {
            (0..n).into_par_iter().map(one).collect()
        };
        let mut tally: BTreeMap<String, Vec<u64>> = BTreeMap::new();
        let mut scores: BTreeMap<Score, u64> = BTreeMap::new();
        for (score, a, s) in answers {
            *scores.entry(score).or_default() += 1;
            tally.entry(a).or_default().push(s);
        }
        println!("{effect}: {scores:?}");
        for (a, seeds) in tally {
            println!(
                "    {:3}  {a}   {:?}",
                seeds.len(),
                &seeds[..seeds.len().min(6)]
            );
        }
    }
}
