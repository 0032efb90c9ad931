//! Judges of the diagnosis that know the physics and the contract of files, and nothing of the program's
//! own formulas: each kind of data is one file that draws cases with a known truth. What noise lets nobody
//! see (an optimal statistic below five standard deviations) is counted apart, never as missed.
#![allow(dead_code)]

pub mod algebra;
mod arm;
mod chosen;
pub mod cubes;
mod cut;
pub mod force_sensor;
pub mod hammer;
pub mod intervals;
pub mod joint_motion;
pub mod load_cycle;
pub mod milling_force;
pub mod part;
mod rigid;
pub mod screw;
pub mod workspace;

use ident::findings::kinds::kind;
use ident::findings::{Answer, Verdict};
use ident::ground::random::Random;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// What was hidden.
#[derive(Debug, Clone)]
pub struct Truth {
    /// Its name in the contract; `outside` for what nobody in the library explains.
    pub effect: &'static str,
    /// Its site, where the answer must say it.
    pub site: Option<String>,
    /// Statistic of the best test for it, in standard deviations: everything else known but what is free anyway.
    pub sight: f64,
    /// The same with the nearest rival free as well.
    pub apart: f64,
    /// Names that no data of this kind tell from it (knowledge of the pairs).
    pub twins: Vec<(&'static str, Option<String>)>,
    /// Largest part of the effect over the noise of a reading.
    pub strength: f64,
    /// The law it follows.
    pub law: String,
}

/// A file with its truth.
#[derive(Debug, Clone)]
pub struct Case {
    pub seed: u64,
    pub truths: Vec<Truth>,
    /// How the laboratory worked, for the list of misses.
    pub habit: String,
    /// Name and text of every file; the first is diagnosed.
    pub files: Vec<(String, String)>,
}

/// Weakest statistic that counts as visible.
const VISIBLE: f64 = 5.0;

impl Case {
    fn visible(&self) -> impl Iterator<Item = &Truth> {
        let seen = |t: &&Truth| {
            if t.effect == "outside" {
                t.apart >= VISIBLE
            } else {
                t.sight >= VISIBLE
            }
        };
        self.truths.iter().filter(seen)
    }

    /// The class it is counted in.
    pub fn class(&self) -> &'static str {
        let outside = self.truths.iter().any(|t| t.effect == "outside");
        match (outside, self.truths.len(), self.visible().count()) {
            (true, _, n) if n > 0 => "outside",
            (_, 0, _) => "clean",
            (_, _, 0) => "unseen",
            (_, 1, _) => "single",
            _ => "pair",
        }
    }

    fn hidden(&self) -> String {
        let one = |t: &Truth| match &t.site {
            Some(site) => format!("{} {site}", t.effect),
            None if t.effect == "outside" => format!("outside: {}", t.law),
            None => t.effect.to_string(),
        };
        let all: Vec<String> = self.truths.iter().map(one).collect();
        all.join(" + ")
    }
}

/// An answer beside the truth.
#[derive(Debug, Clone)]
pub struct Judged {
    pub case: Case,
    /// Causes named alone: effect, site, probability.
    pub causes: Vec<(String, String, f64)>,
    /// Groups: effects and sites.
    pub groups: Vec<Vec<(String, String)>>,
    pub verdict: Verdict,
    /// Intervals of 95 % of the gain of each cause, percent.
    pub gains: Vec<[f64; 2]>,
    /// That what is left is chance.
    pub p_value: f64,
    /// The file was not read.
    pub refused: bool,
}

/// Whether a site is the wanted one; a bearing is `A3` or `A3-tilt`.
fn at(wanted: Option<&str>, site: &str) -> bool {
    wanted.is_none_or(|w| w == site || site.strip_suffix("-tilt") == Some(w))
}

/// Whether a name and site are this truth's.
fn is(truth: &Truth, effect: &str, site: &str) -> bool {
    truth.effect == effect && at(truth.site.as_deref(), site)
}

/// Whether they are this truth's or of what nothing tells from it.
fn same(truth: &Truth, effect: &str, site: &str) -> bool {
    is(truth, effect, site)
        || truth
            .twins
            .iter()
            .any(|(e, s)| *e == effect && at(s.as_deref(), site))
}

impl Judged {
    fn new(case: Case, answer: &Answer) -> Self {
        let cause =
            |c: &ident::findings::Cause| (c.effect.to_string(), c.site.clone(), c.probability);
        let group = |g: &ident::findings::Group| {
            let sites = g.sites.iter().cycle();
            g.effects
                .iter()
                .zip(sites)
                .map(|(e, s)| (e.to_string(), s.clone()))
                .collect()
        };
        Self {
            case,
            causes: answer.causes.iter().map(cause).collect(),
            groups: answer.groups.iter().map(group).collect(),
            verdict: answer.verdict,
            gains: answer.causes.iter().map(|c| c.gain.ci95_percent).collect(),
            p_value: answer.p_value,
            refused: false,
        }
    }

    /// A truth is named alone, or within a group of at most three.
    fn names(&self, truth: &Truth) -> bool {
        let alone = self.causes.iter().any(|(e, s, _)| same(truth, e, s));
        alone
            || self
                .groups
                .iter()
                .any(|g| g.len() <= 3 && g.iter().any(|(e, s)| same(truth, e, s)))
    }

    /// A truth is named alone where rivals lie far off.
    fn exact(&self) -> bool {
        let alone = |t: &&Truth| self.causes.iter().any(|(e, s, _)| same(t, e, s));
        self.case.visible().all(|t| alone(&t)) && self.right()
    }

    /// Named things that are no truth: a cause alone, or a group none of whose members is true.
    fn strays(&self) -> usize {
        let true_one = |e: &str, s: &str| self.case.truths.iter().any(|t| same(t, e, s));
        let shared = |e: &str, s: &str| {
            let member = |g: &&Vec<(String, String)>| g.iter().any(|(a, b)| a == e && b == s);
            self.groups
                .iter()
                .filter(member)
                .any(|g| g.iter().any(|(a, b)| true_one(a, b)))
        };
        let stray = |(e, s, _): &&(String, String, f64)| !true_one(e, s) && !shared(e, s);
        let alone = self.causes.iter().filter(stray).count();
        let lost = |g: &&Vec<(String, String)>| !g.iter().any(|(e, s)| true_one(e, s));
        alone + self.groups.iter().filter(lost).count()
    }

    /// Something is said to be left that nobody explains.
    fn flagged(&self) -> bool {
        matches!(
            self.verdict,
            Verdict::UnknownCause | Verdict::PartlyExplained
        )
    }

    /// Everything visible is named, and nothing that is not there.
    fn right(&self) -> bool {
        if self.refused {
            return false;
        }
        match self.case.class() {
            "clean" | "unseen" => {
                self.strays() == 0
                    && (self.verdict == Verdict::Sufficient
                        || !self.case.truths.is_empty() && !self.flagged())
            }
            "outside" => self.flagged(),
            _ => self.case.visible().all(|t| self.names(t)) && self.strays() == 0,
        }
    }

    /// Something that is not true is named.
    fn wrong(&self) -> bool {
        match self.case.class() {
            "outside" => !self.flagged() && self.strays() > 0,
            _ => self.strays() > 0,
        }
    }

    /// The answer in one line.
    fn said(&self) -> String {
        let one = |(e, s, p): &(String, String, f64)| format!("{e} {s} {p:.2}");
        let group = |g: &Vec<(String, String)>| {
            let names: Vec<String> = g.iter().map(|(e, s)| format!("{e} {s}")).collect();
            format!("{{{}}}", names.join("|"))
        };
        let all: Vec<String> = self
            .causes
            .iter()
            .map(one)
            .chain(self.groups.iter().map(group))
            .collect();
        let left = match self.p_value {
            p if p < 1e-3 => format!(", p {p:.0e}"),
            _ => String::new(),
        };
        format!("{} [{}{left}]", all.join(" + "), self.verdict.name())
    }
}

/// Diagnoses a case as the program would from the command line.
pub fn answer(case: Case) -> Judged {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in &case.files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    if let Some(kept) = std::env::var_os("IDENT_JUDGE_KEEP") {
        for (name, text) in &case.files {
            let path = Path::new(&kept).join(format!("{}_{name}", case.seed));
            std::fs::write(path, text).unwrap();
        }
    }
    let path = folder.path().join(&case.files[0].0);
    let (_, diagnose) = kind(&path).unwrap();
    match diagnose(&path) {
        Ok(found) => Judged::new(case, found.answer()),
        Err(problem) => {
            println!("# case {} was refused: {}", case.seed, problem.what);
            Judged {
                case,
                causes: Vec::new(),
                groups: Vec::new(),
                verdict: Verdict::CannotTell,
                gains: Vec::new(),
                p_value: 1.0,
                refused: true,
            }
        }
    }
}

/// A number from the environment.
pub fn number(name: &str, default: u64) -> u64 {
    std::env::var(name)
        .ok()
        .and_then(|v| v.parse().ok())
        .unwrap_or(default)
}

/// Cases of a kind: `IDENT_BLIND_SEED` draws others, `IDENT_JUDGE_CASES` more, `IDENT_JUDGE_FIRST` from another one on.
pub fn judged(draw: fn(u64) -> Case, cases: u64) -> Vec<Judged> {
    judged_from(draw, 0, cases)
}

/// The same from a case on that stands for the others.
pub fn judged_from(draw: fn(u64) -> Case, first: u64, cases: u64) -> Vec<Judged> {
    let base = number("IDENT_BLIND_SEED", 1) * 100_000;
    let first = number("IDENT_JUDGE_FIRST", first);
    let count = number("IDENT_JUDGE_CASES", cases);
    let seeds: Vec<u64> = (base + first..base + first + count).collect();
    seeds.par_iter().map(|seed| answer(draw(*seed))).collect()
}

/// Counts of one class.
#[derive(Default, Debug, Clone, Copy)]
pub struct Count {
    pub all: usize,
    pub right: usize,
    pub exact: usize,
    pub wrong: usize,
}

impl Count {
    /// Share that is right.
    pub fn rate(&self) -> f64 {
        self.right as f64 / self.all.max(1) as f64
    }
}

/// Rates of a kind.
#[derive(Debug, Default)]
pub struct Rates {
    counts: BTreeMap<&'static str, Count>,
}

impl Rates {
    /// Of one class.
    pub fn of(&self, class: &str) -> Count {
        self.counts.get(class).copied().unwrap_or_default()
    }

    /// Share of singles and pairs in which something untrue is named.
    pub fn wrong(&self) -> f64 {
        let both = [self.of("single"), self.of("pair"), self.of("clean")];
        let all: usize = both.iter().map(|c| c.all).sum();
        both.iter().map(|c| c.wrong).sum::<usize>() as f64 / all.max(1) as f64
    }
}

/// Prints the matrix, the rates, the stated probabilities against the truth, and the misses on request.
pub fn conclude(kind: &str, all: &[Judged]) -> Rates {
    let mut rates = Rates::default();
    let mut rows = BTreeMap::<String, BTreeMap<String, usize>>::new();
    for one in all {
        let own = rates.counts.entry(one.case.class()).or_default();
        own.all += 1;
        own.right += usize::from(one.right());
        own.exact += usize::from(one.exact());
        own.wrong += usize::from(one.wrong());
        let plain = |t: &Truth| match t.effect {
            "outside" => format!("outside: {}", t.law.split(';').next().unwrap_or("")),
            effect => effect.to_string(),
        };
        let hidden: Vec<String> = one.case.truths.iter().map(plain).collect();
        let row = match one.case.class() {
            "clean" => "clean".to_string(),
            "unseen" => "unseen".to_string(),
            _ => hidden.join(" + "),
        };
        if one.case.class() != "pair" {
            *rows.entry(row).or_default().entry(short(one)).or_default() += 1;
        }
        let told = std::env::var("IDENT_DEBUG").ok();
        if told.as_deref() == Some("2") || told.is_some() && !one.right() {
            println!("{}", line(kind, one));
        }
    }
    for (row, answers) in &rows {
        let cells: Vec<String> = answers.iter().map(|(a, n)| format!("{a} ({n})")).collect();
        println!("| {kind}: {row} | {} |", cells.join(", "));
    }
    print_rates(kind, &rates);
    print_probabilities(kind, all);
    rates
}

fn short(one: &Judged) -> String {
    let names = one.causes.iter().map(|(e, ..)| e.clone());
    let groups = one.groups.iter().map(|g| {
        let names: Vec<&str> = g.iter().map(|(e, _)| e.as_str()).collect();
        format!("{{{}}}", names.join("/"))
    });
    let mut all: Vec<String> = names.chain(groups).collect();
    if all.is_empty() || one.flagged() {
        all.push(one.verdict.name().to_string());
    }
    all.join(" + ")
}

fn line(kind: &str, one: &Judged) -> String {
    let truths = one.case.truths.iter().map(|t| {
        format!(
            "{} {} [{}; {:.1} sd a reading, sight {:.0}, apart {:.0}]",
            t.effect,
            t.site.clone().unwrap_or_default(),
            t.law,
            t.strength,
            t.sight,
            t.apart
        )
    });
    let truths: Vec<String> = truths.collect();
    let mark = if one.wrong() {
        "WRONG"
    } else if one.right() {
        "right"
    } else {
        "missed"
    };
    format!(
        "# {kind} {} {} {mark}: {} / {} -> {}",
        one.case.seed,
        one.case.class(),
        truths.join(" + "),
        one.case.habit,
        one.said()
    )
}

fn print_rates(kind: &str, rates: &Rates) {
    for class in ["clean", "single", "pair", "outside", "unseen"] {
        let c = rates.of(class);
        println!(
            "{kind} {class} cases: right {} of {} (alone {}), something untrue named in {}",
            c.right, c.all, c.exact, c.wrong
        );
    }
}

fn print_probabilities(kind: &str, all: &[Judged]) {
    let edges = [0.0, 0.5, 0.8, 0.95, 0.99, 1.01];
    for pair in edges.windows(2) {
        let mut told = (0usize, 0usize, 0.0);
        for one in all {
            for (e, s, p) in one
                .causes
                .iter()
                .filter(|c| (pair[0]..pair[1]).contains(&c.2))
            {
                told.0 += 1;
                told.1 += usize::from(one.case.truths.iter().any(|t| same(t, e, s)));
                told.2 += p;
            }
        }
        if told.0 > 0 {
            println!(
                "{kind} stated probability {:.2} on average: true cause in {} of {}",
                told.2 / told.0 as f64,
                told.1,
                told.0
            );
        }
    }
}

/// What a kind reached when its judge was landed, less what a sample of this size falls short of by chance.
#[derive(Debug, Clone, Copy)]
pub struct Floors {
    /// Clean files that come back as `sufficient`.
    pub clean: f64,
    /// Single causes that are right.
    pub single: f64,
    /// Pairs that are right.
    pub pair: f64,
    /// Structure of no cause that is said to be left.
    pub outside: f64,
    /// Clean, single and pair in which something untrue is named.
    pub wrong: f64,
}

impl Floors {
    /// Whether the rates hold them.
    pub fn hold(&self, rates: &Rates) {
        let least = [
            ("clean", self.clean),
            ("single", self.single),
            ("pair", self.pair),
            ("outside", self.outside),
        ];
        for (class, floor) in least {
            let found = rates.of(class);
            assert!(
                found.all == 0 || found.rate() >= floor,
                "{class}: {found:?} below {floor}"
            );
        }
        assert!(
            rates.wrong() <= self.wrong,
            "untrue names {} above {}",
            rates.wrong(),
            self.wrong
        );
    }
}

/// Intervals that hold the truth, by name.
#[derive(Debug, Default)]
pub struct Held {
    counts: BTreeMap<String, (usize, usize)>,
}

impl Held {
    /// One interval more.
    pub fn add(&mut self, name: &str, low: f64, high: f64, truth: f64) {
        let own = self.counts.entry(name.to_string()).or_default();
        own.1 += 1;
        own.0 += usize::from(low <= truth && truth <= high);
    }

    /// All together.
    pub fn merge(&mut self, other: Held) {
        for (name, (held, all)) in other.counts {
            let own = self.counts.entry(name).or_default();
            own.0 += held;
            own.1 += all;
        }
    }

    /// Prints and returns the share.
    pub fn conclude(&self, kind: &str) -> (usize, usize) {
        let sum = self
            .counts
            .values()
            .fold((0, 0), |s, c| (s.0 + c.0, s.1 + c.1));
        for (name, (held, all)) in &self.counts {
            println!("{kind} {name}: intervals of 95 % hold the truth in {held} of {all}");
        }
        println!(
            "{kind} all: intervals of 95 % hold the truth in {} of {}",
            sum.0, sum.1
        );
        sum
    }
}

/// Whether the interval of the gain holds what the true cause is worth, where one is hidden and it alone is named:
/// with everything else as the files state it, and with everything else as it is.
pub fn gains(all: &[Judged], worth: fn(u64) -> [f64; 2]) -> Held {
    let mut held = Held::default();
    let plain = |j: &&Judged| j.case.class() == "single" && j.exact() && j.causes.len() == 1;
    for one in all.iter().filter(plain) {
        let ([low, high], truth) = (one.gains[0], worth(one.case.seed));
        held.add("gain over the stated model", low, high, truth[0]);
        held.add("gain over the true model", low, high, truth[1]);
        if std::env::var("IDENT_DEBUG").is_ok() && !truth.iter().any(|t| (low..=high).contains(t)) {
            println!(
                "# {} gain {truth:.1?} % not in [{low:.1}, {high:.1}]",
                one.case.seed
            );
        }
    }
    held
}

/// Whether what a rival leaves of an effect is nothing that data tell: within chance, or within the few percent
/// by which nature misses any law.
pub fn twin(left: f64, sight: f64) -> bool {
    left < 3.0 || left < 0.07 * sight
}

/// Picks one.
pub fn pick<'a, T>(random: &mut Random, from: &'a [T]) -> &'a T {
    &from[random.below(from.len())]
}

/// True with this probability.
pub fn chance(random: &mut Random, p: f64) -> bool {
    random.unit() < p
}
