//! Milling forces that hide a cause, alone or two together, nothing, or something that no effect makes:
//! how often the diagnosis names it. `IDENT_BLIND_SEED` and `IDENT_BLIND_CASES` ask for more.

use crate::common::few_or_all;
use crate::milling_bench::hidden::{FAULTS, Hidden, STRANGERS, hidden};
use ident::findings::engine::diagnose;
use ident::findings::kinds::Measured;
use ident::findings::milling_force::Case;
use ident::findings::{Answer, Verdict};
use ident::ground::random::Random;
use ident::measurement::milling_force::MillingForce;
use ident::measurement::table::Table;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

fn number(variable: &str, default: u64) -> u64 {
    let said = std::env::var(variable).ok();
    said.and_then(|v| v.parse().ok()).unwrap_or(default)
}

fn answered(hidden: &Hidden) -> Answer {
    let bytes = hidden.text.len() as u64;
    let table = Table::from_reader("cuts.csv".as_ref(), hidden.text.as_bytes(), bytes).unwrap();
    let case = Case::new(MillingForce::from_table(table).unwrap());
    diagnose(&case, &case.judgement()).answer
}

/// All cases, each on the next free thread, in their order.
fn all(cases: &[(u64, Vec<&'static str>)]) -> Vec<(Hidden, Answer)> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some((seed, faults)) = cases.get(i) else {
                        break;
                    };
                    let case = hidden(*seed, faults);
                    let answer = answered(&case);
                    done.lock().unwrap().push((i, case, answer));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap();
    done.sort_by_key(|d| d.0);
    done.into_iter().map(|(_, h, a)| (h, a)).collect()
}

/// Whether a fault is named, alone or in a group of few; what is the same for two teeth counts.
fn is_named(fault: &str, answer: &Answer) -> bool {
    let alone = answer.causes.iter().any(|c| c.effect == fault);
    let groups = answer.groups.iter();
    let among = |e: &[&'static str]| e.contains(&fault) && e.len() <= 4;
    alone || groups.map(|g| g.effects.as_slice()).any(among)
}

/// Causes that were named and not hidden.
fn wrong(hidden: &Hidden, answer: &Answer) -> Vec<&'static str> {
    let named = answer.causes.iter().map(|c| c.effect);
    named.filter(|e| !hidden.faults.contains(e)).collect()
}

fn told(answer: &Answer) -> String {
    let causes: Vec<String> = answer
        .causes
        .iter()
        .map(|c| {
            let own: Vec<String> = c
                .parameters
                .iter()
                .map(|p| format!("{}={:.4e}", p.0, p.1))
                .collect();
            format!(
                "{} {} ({:.2}; {})",
                c.effect,
                c.site,
                c.probability,
                own.join(" ")
            )
        })
        .collect();
    let groups: Vec<String> = answer
        .groups
        .iter()
        .map(|g| format!("{:?}", g.effects))
        .collect();
    format!("{:?} {causes:?} {groups:?}", answer.verdict)
}

struct Rates {
    right: usize,
    wrong: usize,
    of: usize,
}

fn judged(name: &str, cases: &[(u64, Vec<&'static str>)]) -> Rates {
    let mut rates = Rates {
        right: 0,
        wrong: 0,
        of: cases.len(),
    };
    for (hidden, answer) in all(cases) {
        let holds = match hidden.faults.first() {
            None => answer.verdict == Verdict::Sufficient,
            Some(first) if STRANGERS.contains(first) => matches!(
                answer.verdict,
                Verdict::UnknownCause | Verdict::PartlyExplained
            ),
            _ => hidden.faults.iter().all(|f| is_named(f, &answer)),
        };
        let stranger = hidden.faults.first().is_some_and(|f| STRANGERS.contains(f));
        let bad = !stranger && !wrong(&hidden, &answer).is_empty();
        rates.right += usize::from(holds);
        rates.wrong += usize::from(bad);
        if !holds || bad {
            println!(
                "{name}: {:?} teeth {}: {}",
                hidden.told,
                hidden.teeth,
                told(&answer)
            );
        }
    }
    println!(
        "{name}: {} of {} right, {} wrong",
        rates.right, rates.of, rates.wrong
    );
    rates
}

fn seeds(first: u64, count: usize) -> impl Iterator<Item = u64> {
    let base = 10_000 * number("IDENT_BLIND_SEED", 1) + first;
    (0..count as u64).map(move |i| base + i)
}

/// How far apart those are that are asked: of a few, of a thorough run, or all where a number of cases is asked for.
fn apart([few, thorough]: [usize; 2]) -> usize {
    match std::env::var_os("IDENT_BLIND_CASES") {
        Some(_) => 1,
        None => few_or_all(few as u64, thorough as u64) as usize,
    }
}

/// How many of one class for each time that is asked: a few, or as many as a thorough run has.
fn each(few: usize, all: usize) -> usize {
    match std::env::var_os("IDENT_BLIND_CASES") {
        Some(_) => all,
        None => few_or_all(few as u64, all as u64) as usize,
    }
}

fn times() -> usize {
    number("IDENT_BLIND_CASES", 1) as usize
}

#[test]
fn single_causes_are_named() {
    let mut cases = Vec::new();
    let apart = apart([7, 2]);
    for (k, fault) in FAULTS.iter().enumerate().step_by(apart) {
        cases.extend(seeds(100 * k as u64, times()).map(|s| (s, vec![*fault])));
    }
    let rates = judged("singles", &cases);
    assert!(rates.right * 100 >= 80 * rates.of && rates.wrong * 20 <= rates.of);
}

#[test]
fn two_causes_are_named() {
    let mut random = Random::new(number("IDENT_BLIND_SEED", 1));
    let cases: Vec<(u64, Vec<&'static str>)> = seeds(2000, each(1, 4) * times())
        .map(|s| {
            let first = random.below(FAULTS.len());
            let second = (first + 1 + random.below(FAULTS.len() - 1)) % FAULTS.len();
            (s, vec![FAULTS[first], FAULTS[second]])
        })
        .collect();
    let rates = judged("pairs", &cases);
    assert!(rates.right * 100 >= 60 * rates.of);
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_cut_as_stated_is_sufficient() {
    let cases: Vec<(u64, Vec<&'static str>)> =
        seeds(4000, 2 * times()).map(|s| (s, vec![])).collect();
    let rates = judged("clean", &cases);
    assert!(rates.right == rates.of);
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn what_no_effect_makes_is_flagged() {
    let apart = apart([STRANGERS.len(), 3]);
    let cases: Vec<(u64, Vec<&'static str>)> = seeds(6000, STRANGERS.len() * times())
        .enumerate()
        .step_by(apart)
        .map(|(k, s)| (s, vec![STRANGERS[k % STRANGERS.len()]]))
        .collect();
    let rates = judged("strangers", &cases);
    assert!(rates.right * 100 >= 60 * rates.of);
}
