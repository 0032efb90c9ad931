//! The tests hide an effect in the data and require finding it.
//!
//! The generator is written independently of `src/effects`. Seeds are fixed ones and ones that
//! change with the day; `IDENT_BLIND_SEED` and `IDENT_BLIND_CASES` (per effect) choose others;
//! `IDENT_DEBUG=1` prints the misses, and `IDENT_BLIND_KEEP=FOLDER` keeps their files.
//! `cargo test --test suite blind:: -- --nocapture` prints the confusion matrix.

use crate::blind_generator;
use crate::common::few_or_all;

use crate::blind_generator::{Case, EFFECTS, OUTSIDE};
use ident::effects::Effect;
use ident::findings::{Diagnosis, Settings, Verdict, diagnose};
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

fn run(case: &Case) -> Diagnosis {
    run_with(case, &Settings::default())
}

fn run_with(case: &Case, settings: &Settings) -> Diagnosis {
    let table = Table::from_reader(
        Path::new("case.csv"),
        case.csv.as_bytes(),
        case.csv.len() as u64,
    )
    .unwrap();
    diagnose(&LoadCycle::from_table(table).unwrap(), settings)
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

/// What a suite counts.
#[derive(Default)]
struct Tally {
    rows: BTreeMap<String, BTreeMap<String, usize>>,
    scores: BTreeMap<(String, Score), usize>,
}

impl Tally {
    fn add(&mut self, kind: &str, case: &Case, diagnosis: &Diagnosis) {
        *self
            .rows
            .entry(kind.into())
            .or_default()
            .entry(answer(diagnosis))
            .or_default() += 1;
        *self
            .scores
            .entry((kind.into(), score(case, diagnosis)))
            .or_default() += 1;
    }

    fn count(&self, wanted: impl Fn(&str) -> bool, scores: &[Score]) -> usize {
        let hit = self
            .scores
            .iter()
            .filter(|((kind, s), _)| wanted(kind) && scores.contains(s));
        hit.map(|(_, n)| n).sum()
    }

    fn log(&self) {
        for (kind, answers) in &self.rows {
            let mut sorted: Vec<_> = answers.iter().collect();
            sorted.sort_by_key(|(_, n)| std::cmp::Reverse(**n));
            let line: Vec<String> = sorted.iter().map(|(a, n)| format!("{n} {a}")).collect();
            say(&format!("| {kind} | {} |", line.join(", ")));
        }
    }
}

/// Writes into the test log even where the test passes: the harness keeps only `println!` back.
fn say(line: &str) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr(), "{line}");
}

const ALL: [Score; 5] = [
    Score::Exact,
    Score::Covered,
    Score::Extra,
    Score::Missed,
    Score::Wrong,
];

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|v| v.parse().ok())
}

/// Fixed seeds; `IDENT_BLIND_SEED` asks for others (the evidence is taken with those of a day).
fn seeds(count: u64) -> Vec<u64> {
    let base = number("IDENT_BLIND_SEED").unwrap_or(0) * 10_000;
    (0..count).map(|i| base + i).collect()
}

/// Cases per kind; `IDENT_BLIND_CASES` asks for more.
fn per_kind(default: u64) -> u64 {
    number("IDENT_BLIND_CASES").unwrap_or(default)
}

/// Keeps the file of a missed case in the folder that `IDENT_BLIND_KEEP` names.
fn keep(kind: &str, case: &Case) {
    if let Ok(folder) = std::env::var("IDENT_BLIND_KEEP") {
        let path = Path::new(&folder).join(format!("{kind}-{}.csv", case.seed).replace(':', "-"));
        std::fs::write(path, &case.csv).unwrap();
    }
}

fn tally(kinds: &[(String, u64)], make: impl Fn(&str, u64) -> Case + Sync) -> Tally {
    let results: Vec<(String, Case, Diagnosis)> = kinds
        .par_iter()
        .map(|(kind, seed)| {
            let case = make(kind, *seed);
            let diagnosis = run(&case);
            (kind.clone(), case, diagnosis)
        })
        .collect();
    let mut tally = Tally::default();
    for (kind, case, diagnosis) in &results {
        tally.add(kind, case, diagnosis);
        if std::env::var("IDENT_DEBUG").is_ok()
            && score(case, diagnosis) > Score::Covered
            && (!kind.starts_with("outside") || diagnosis.verdict != Verdict::UnknownCause)
        {
            keep(kind, case);
            let truth: Vec<_> = case
                .truths
                .iter()
                .map(|t| format!("{} x{:.1}", t.effect, t.strength))
                .collect();
            println!(
                "# {kind} {} {} {} {} o{} n{} {truth:?} -> {} {:?} noise {:.2e}/{:.2e}",
                case.seed,
                case.schedule,
                case.noise,
                case.lasers,
                case.outliers,
                case.samples,
                answer(diagnosis),
                diagnosis.unexplained,
                diagnosis.discrepancy.noise_rms,
                case.noise_rms
            );
        }
    }
    tally
}

fn product(kinds: &[&str], count: u64) -> Vec<(String, u64)> {
    kinds
        .iter()
        .flat_map(|k| seeds(count).into_iter().map(move |s| (k.to_string(), s)))
        .collect()
}

fn scale(kind: &str) -> bool {
    matches!(kind, "lever_arm" | "cosine_error" | "stiffness")
}

fn share(part: usize, all: usize) -> f64 {
    part as f64 / all.max(1) as f64
}

/// Singles, pairs, clean data and effects outside the library. Scale errors are counted apart: in
/// files with one laser the stated spread of the nominal stiffness hides most of them, honestly.
#[test]
fn hidden_effects_are_found() {
    let mut kinds = product(EFFECTS, per_kind(few_or_all(1, 5)));
    kinds.extend(product(&["clean"], per_kind(few_or_all(1, 5)) * 6));
    kinds.extend(product(&["pair"], per_kind(few_or_all(1, 5)) * 6));
    kinds.extend(product(OUTSIDE, per_kind(few_or_all(2, 5)) / 2));
    let tally = tally(&kinds, |kind, seed| match kind {
        "clean" => blind_generator::clean(seed),
        "pair" => shape_pair(seed),
        outside if outside.starts_with("outside") => blind_generator::outside(outside, seed),
        single => blind_generator::single(single, seed),
    });
    tally.log();
    let single = |k: &str| EFFECTS.contains(&k) && !scale(k);
    let right = [Score::Exact, Score::Covered];
    let rate = |wanted: &dyn Fn(&str) -> bool, scores: &[Score]| {
        share(tally.count(wanted, scores), tally.count(wanted, &ALL))
    };
    let clean = rate(&|k| k == "clean", &[Score::Exact]);
    let unknown = flagged(&tally);
    say(&format!("cases {}", kinds.len()));
    say(&format!(
        "single, shape: right {:.3}, exact {:.3}, wrong {:.3}",
        rate(&single, &right),
        rate(&single, &[Score::Exact]),
        rate(&single, &[Score::Wrong])
    ));
    say(&format!(
        "single, scale: right {:.3}, wrong {:.3}",
        rate(&scale, &right),
        rate(&scale, &[Score::Wrong])
    ));
    say(&format!(
        "pairs: right {:.3}, exact {:.3}, wrong {:.3}",
        rate(&|k| k == "pair", &right),
        rate(&|k| k == "pair", &[Score::Exact]),
        rate(&|k| k == "pair", &[Score::Wrong])
    ));
    say(&format!(
        "clean: no alarm {clean:.3}; outside the library: flagged unknown {unknown:.3}"
    ));
    assert!(
        rate(&single, &right) >= SINGLES,
        "single effects named right"
    );
    assert!(rate(&|k| k == "pair", &right) >= PAIRS, "pairs named right");
    assert!(rate(&single, &[Score::Wrong]) <= WRONG, "wrong causes");
    assert!(clean >= 1.0 - ALARMS, "false alarms");
    assert!(unknown >= UNKNOWN, "effects outside the library");
}

/// Thresholds below the rates measured over 1000 and more cases (see ARCHITECTURE.md) by what a
/// sample of this size may fall short by chance.
const SINGLES: f64 = 0.93;
const PAIRS: f64 = 0.77;
const WRONG: f64 = 0.03;
const ALARMS: f64 = 0.04;
/// The two that fell when families of shapes took the place of one law per cause: what is wide enough to know
/// a stranger's law also knows more of what no law makes (one law per cause: 0.92 and 0.90 here, and a wrong or
/// invented name in 23 % of the cases of `tests/stranger.rs`, families 7 to 11 %).
const UNKNOWN: f64 = 0.72;
const MISSING: f64 = 0.42;

/// A pair without scale errors.
fn shape_pair(seed: u64) -> Case {
    (0..)
        .map(|k| blind_generator::random_pair(seed * 31 + k))
        .find(|case| case.truths.iter().all(|t| !scale(t.effect)))
        .unwrap()
}

fn flagged(tally: &Tally) -> f64 {
    let outside = tally.rows.iter().filter(|(k, _)| k.starts_with("outside"));
    let (mut flagged, mut all) = (0, 0);
    for (answer, count) in outside.flat_map(|(_, answers)| answers) {
        all += count;
        if answer.contains("UNKNOWN") {
            flagged += count;
        }
    }
    share(flagged, all)
}

/// With the true cause taken out of the library, a cause without look-alikes comes back unknown.
#[test]
fn a_missing_cause_is_not_invented() {
    let kinds = product(
        &["backlash", "asymmetry", "loosening"],
        per_kind(few_or_all(2, 8)),
    );
    let unknown = kinds
        .par_iter()
        .filter(|(kind, seed)| {
            let case = blind_generator::single_at(kind, 12.0, *seed);
            let library = ident::effects::EFFECTS
                .iter()
                .copied()
                .filter(|e| e.card().cause != kind)
                .collect();
            let settings = Settings {
                library,
                ..Settings::default()
            };
            let diagnosis = run_with(&case, &settings);
            let unknown = matches!(
                diagnosis.verdict,
                Verdict::UnknownCause | Verdict::PartlyExplained
            );
            if std::env::var("IDENT_DEBUG").is_ok() && !unknown {
                keep(&format!("missing-{kind}"), &case);
                println!(
                    "# missing {kind} {seed} {} {} {:?} -> {} {:?}",
                    case.schedule,
                    case.noise,
                    case.truths[0].parameters,
                    answer(&diagnosis),
                    diagnosis.unexplained
                );
            }
            unknown
        })
        .count();
    say(&format!(
        "true cause out of the library: unknown in {unknown} of {}",
        kinds.len()
    ));
    assert!(share(unknown, kinds.len()) >= MISSING, "missing causes");
}

/// The stated interval of the gain covers the gain that the generator knows.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn gains_are_honest() {
    let kinds = product(
        &[
            "backlash",
            "soft_zone",
            "cubic_stiffness",
            "asymmetry",
            "coulomb_friction",
            "creep",
            "time_skew",
        ],
        per_kind(8),
    );
    let covered: Vec<bool> = kinds
        .par_iter()
        .filter_map(|(kind, seed)| {
            let case = blind_generator::single(kind, *seed);
            let diagnosis = run(&case);
            let cause = diagnosis.causes.iter().find(|c| c.effect == kind)?;
            if diagnosis.causes.len() + diagnosis.groups.len() > 1 {
                return None;
            }
            let truth = true_gain(&case);
            if std::env::var("IDENT_DEBUG").is_ok() {
                println!(
                    "{kind} {seed} {} {} n{} noise {:.2e} est after {:.2e} truth {truth:.2} {:?}",
                    case.schedule,
                    case.noise,
                    case.samples,
                    case.noise_rms,
                    cause.gain.after,
                    cause.gain
                );
            }
            Some((cause.gain.ci95_percent[0]..=cause.gain.ci95_percent[1]).contains(&truth))
        })
        .collect();
    let rate = share(covered.iter().filter(|c| **c).count(), covered.len());
    say(&format!(
        "gain intervals cover the true gain in {rate:.3} of {}",
        covered.len()
    ));
    assert!(rate >= 0.88, "gain intervals");
}

/// 1 − σ/√(σ² + d²) in percent, d what the straight spring fitted to the other cycles misses.
fn true_gain(case: &Case) -> f64 {
    let (s, y) = (&case.straight, &case.clean);
    let mut d2 = 0.0;
    for cycle in 0..=case.cycle.iter().copied().max().unwrap_or(0) {
        let sums = |other: bool| {
            let rows = (0..y.len()).filter(move |i| (case.cycle[*i] != cycle) == other);
            rows.fold((0.0, 0.0, 0.0), |(a, b, c), i| {
                (a + s[i] * s[i], b + s[i] * y[i], c + y[i] * y[i])
            })
        };
        let (ss, sy, _) = sums(true);
        let (own_ss, own_sy, own_yy) = sums(false);
        let slope = sy / ss;
        d2 += own_yy - 2.0 * slope * own_sy + slope * slope * own_ss;
    }
    let (d2, n2) = (d2 / y.len() as f64, case.noise_rms * case.noise_rms);
    100.0 * (1.0 - (n2 / (n2 + d2)).sqrt())
}

/// One file of an effect and one table line are all it takes: a toy effect that no other file knows
/// is found in blind data.
#[test]
fn a_toy_effect_is_named() {
    let toy: &'static dyn Effect = &toy::Detent;
    let library: Vec<&'static dyn Effect> = ident::effects::EFFECTS
        .iter()
        .copied()
        .chain([toy])
        .collect();
    let settings = Settings {
        library,
        ..Settings::default()
    };
    let found = (0..12)
        .filter(|seed| named_detent(*seed, &settings))
        .count();
    assert!(found >= 11, "toy effect named in {found} of 12");
}

fn named_detent(seed: u64, settings: &Settings) -> bool {
    let mut case = blind_generator::clean(500 + seed);
    let angle: Vec<f64> = case.clean.clone();
    let peak = angle.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let strength = 12.0 * case.noise_rms;
    let extra: Vec<f64> = angle
        .iter()
        .map(|a| strength * toy::bump(a / peak))
        .collect();
    case.csv = toy::with(&case.csv, &extra);
    let diagnosis = run_with(&case, settings);
    diagnosis.causes.iter().any(|c| c.effect == "detent")
}

use crate::toy;
