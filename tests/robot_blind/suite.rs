//! A suite of blind cases: seeds, the run beside each other, counts and log.

use super::case::Case;
use super::judge::{Answer, ask};
use super::score::{SCORES, Score, alarm, in_effects, in_words, place_right, score, unknown};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::Write;

/// What a suite must reach at least, or at most.
pub struct Floors {
    pub single: f64,
    pub pair: f64,
    pub wrong: f64,
    pub alarms: f64,
    pub unknown: f64,
}

/// A case and its answer, without the file.
pub struct Judged {
    kind: String,
    label: String,
    answer: Answer,
    score: Score,
    place: bool,
}

impl Judged {
    /// Whether the truth was named, alone or in a small group, and nothing else.
    pub fn is_covered(&self) -> bool {
        self.score <= Score::Covered
    }
}

/// Writes into the test log even where the test passes.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|v| v.parse().ok())
}

/// Cases per kind; `IDENT_BLIND_ROBOT_CASES` asks for more.
pub fn per_kind(default: u64) -> u64 {
    number("IDENT_BLIND_ROBOT_CASES").unwrap_or(default)
}

/// Fixed seeds; `IDENT_BLIND_SEED` asks for others (the evidence is taken with those of a day).
pub fn seeds(count: u64) -> Vec<u64> {
    let base = number("IDENT_BLIND_SEED").unwrap_or(0) * 10_000;
    (0..count).map(|i| base + i).collect()
}

/// Every kind with its seeds: singles and unknowns `count` times, clean and pairs three times that;
/// `IDENT_BLIND_ROBOT_KIND` asks for one kind alone.
pub fn kinds(effects: &[&str], outside: &[&str], count: u64) -> Vec<(String, u64)> {
    let times = |kinds: &[&str], count: u64| {
        let each = kinds.iter().map(|k| k.to_string());
        let each = each.flat_map(move |k| seeds(count).into_iter().map(move |s| (k.clone(), s)));
        each.collect::<Vec<_>>()
    };
    let mut out = times(effects, count);
    out.extend(times(&["clean", "pair"], 3 * count));
    out.extend(times(outside, count));
    let only = std::env::var("IDENT_BLIND_ROBOT_KIND");
    out.retain(|(kind, _)| only.as_ref().is_ok_and(|o| o == kind) || only.is_err());
    out
}

/// Writes the case into `IDENT_BLIND_ROBOT_KEEP`, if that is set, for a closer look.
fn keep(case: &Case) {
    if let Ok(folder) = std::env::var("IDENT_BLIND_ROBOT_KEEP") {
        let name = format!("{}-{}", case.kind.replace(':', "-"), case.seed);
        let folder = std::path::Path::new(&folder).join(name);
        std::fs::create_dir_all(&folder).unwrap();
        case.write(&folder);
        std::fs::write(folder.join("hidden.txt"), case.hidden() + "\n" + &case.note).unwrap();
    }
}

/// Makes and judges every case.
pub fn judged(kinds: &[(String, u64)], make: impl Fn(&str, u64) -> Case + Sync) -> Vec<Judged> {
    let debug = std::env::var("IDENT_DEBUG").is_ok();
    let one = |(kind, seed): &(String, u64)| {
        let case = make(kind, *seed);
        keep(&case);
        let answer = ask(&case);
        let score = score(&case, &answer);
        let outside = kind.starts_with("outside") && unknown(&answer);
        say(&format!(
            "{kind} {seed}: {:.2} s, {score:?}",
            answer.seconds
        ));
        if debug && score > Score::Covered && !outside {
            let (hidden, said) = (case.hidden(), in_words(&answer));
            say(&format!(
                "# {kind} {seed} [{}]\n#   {hidden}\n#   -> {said}",
                case.note
            ));
        }
        Judged {
            kind: kind.clone(),
            label: case
                .truths
                .iter()
                .map(|t| t.effect)
                .collect::<Vec<_>>()
                .join("+"),
            place: place_right(&case, &answer),
            answer,
            score,
        }
    };
    kinds.par_iter().map(one).collect()
}

fn is_single(kind: &str) -> bool {
    !kind.starts_with("outside") && kind != "clean" && kind != "pair"
}

fn share<'a>(
    all: &'a [Judged],
    kind: impl Fn(&str) -> bool,
    hit: impl Fn(&'a Judged) -> bool,
) -> f64 {
    let of: Vec<&Judged> = all.iter().filter(|j| kind(&j.kind)).collect();
    of.iter().filter(|j| hit(j)).count() as f64 / of.len().max(1) as f64
}

/// Rows of hidden kinds, answers and how often.
fn confusion(all: &[Judged]) {
    let mut rows: BTreeMap<&str, BTreeMap<String, usize>> = BTreeMap::new();
    for j in all {
        let answer = match j.kind.as_str() {
            "pair" => format!("{} -> {}", j.label, in_effects(&j.answer)),
            _ => in_effects(&j.answer),
        };
        *rows.entry(&j.kind).or_default().entry(answer).or_default() += 1;
    }
    for (kind, answers) in rows {
        let mut sorted: Vec<_> = answers.iter().collect();
        sorted.sort_by_key(|(_, n)| std::cmp::Reverse(**n));
        let line: Vec<String> = sorted.iter().map(|(a, n)| format!("{n} {a}")).collect();
        say(&format!("| {kind} | {} |", line.join(", ")));
    }
}

fn scores(all: &[Judged], name: &str, kind: impl Fn(&str) -> bool + Copy) {
    let rates = SCORES.map(|s| format!("{s:?} {:.3}", share(all, kind, |j| j.score == s)));
    let place = share(all, kind, |j| j.place);
    say(&format!(
        "{name}: {}; place right {place:.3}",
        rates.join(", ")
    ));
}

fn times(all: &[Judged]) {
    let mut seconds: Vec<f64> = all.iter().map(|j| j.answer.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let (middle, last) = (seconds[seconds.len() / 2], seconds[seconds.len() - 1]);
    let mean = seconds.iter().sum::<f64>() / seconds.len() as f64;
    say(&format!(
        "seconds a case: median {middle:.2}, mean {mean:.2}, longest {last:.2}"
    ));
}

/// Prints everything; holds the floors where every kind was asked.
pub fn conclude(name: &str, all: &[Judged], floors: &Floors) {
    if all.is_empty() {
        return say(&format!("{name}: no case of this kind"));
    }
    confusion(all);
    say(&format!("{name}: {} cases", all.len()));
    scores(all, "singles", is_single);
    scores(all, "pairs", |k| k == "pair");
    scores(all, "outside", |k| k.starts_with("outside"));
    let right = |j: &Judged| j.score <= Score::Covered;
    let single = share(all, is_single, right);
    let pair = share(all, |k| k == "pair", right);
    let wrong = share(all, is_single, |j| j.score == Score::Wrong);
    let alarms = share(all, |k| k == "clean", |j| alarm(&j.answer));
    let flagged = share(all, |k| k.starts_with("outside"), |j| unknown(&j.answer));
    say(&format!(
        "right: singles {single:.3}, pairs {pair:.3}; wrong cause {wrong:.3}; false alarm {alarms:.3}; outside flagged unknown {flagged:.3}"
    ));
    times(all);
    let failed = all.iter().find_map(|j| j.answer.failed.as_ref());
    failed
        .iter()
        .for_each(|why| say(&format!("first failure: {}", why.trim())));
    assert!(single >= floors.single, "single causes named right");
    assert!(pair >= floors.pair, "pairs named right");
    assert!(wrong <= floors.wrong, "wrong causes");
    assert!(
        alarms <= floors.alarms && failed.is_none(),
        "false alarms and failures"
    );
    assert!(flagged >= floors.unknown, "effects outside the library");
}
