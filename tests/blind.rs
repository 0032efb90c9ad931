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

#[test]
#[ignore]
fn explore() {
    let number = |name: &str, other: u64| {
        std::env::var(name)
            .ok()
            .and_then(|v| v.parse().ok())
            .unwrap_or(other)
    };
    let (n, seed) = (number("N", 10), number("SEED", 1));
    let only = std::env::var("ONLY").unwrap_or_default();
    let wanted = |name: &str| only.is_empty() || only.split(',').any(|o| o == name);
    for effect in EFFECTS.iter().chain(["clean"].iter()).chain(OUTSIDE) {
        if !wanted(effect) && !(only == "outside" && effect.starts_with("outside")) {
            continue;
        }
        let mut tally: BTreeMap<String, Vec<u64>> = BTreeMap::new();
        for i in 0..n {
            let s = seed * 1000 + i;
            let case = match *effect {
                "clean" => blind_generator::clean(s),
                e if e.starts_with("outside") => blind_generator::outside(e, s),
                e => blind_generator::single(e, s),
            };
            if std::env::var("IDENT_DEBUG").is_ok() {
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
            if std::env::var("IDENT_DEBUG").is_ok() {
                eprintln!("  => {} {:?}", answer(&d), d.adequacy);
            }
            tally.entry(answer(&d)).or_default().push(s);
        }
        println!("{effect}:");
        for (a, seeds) in tally {
            println!(
                "    {:3}  {a}   {:?}",
                seeds.len(),
                &seeds[..seeds.len().min(6)]
            );
        }
    }
}
