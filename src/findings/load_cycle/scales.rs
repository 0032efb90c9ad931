//! Scale errors: lever, inclined laser, or a stiffness that is not nominal.
//!
//! All three only stretch the curve. A second laser and the stated uncertainties of levers and
//! nominal stiffness tell them apart, nothing else does.

use crate::experiments::load_cycle::Settled;
use crate::fit::second::log_ratio;
use crate::ground::stats::ends;
use crate::measurement::load_cycle::LoadCycle;

/// What the scales say.
#[derive(Debug, Clone, Default)]
pub struct Scales {
    /// Findings: candidates (one: named), site of each, relative excess of the reading.
    pub findings: Vec<ScaleFinding>,
}

/// One scale error.
#[derive(Debug, Clone)]
pub struct ScaleFinding {
    /// Candidate effects with their sites and probabilities, most probable first.
    pub candidates: Vec<(&'static str, String, f64)>,
    /// Relative excess of reading over expectation.
    pub excess: f64,
}

/// Stated spreads where the file states none.
const NOMINAL_SPREAD: f64 = 0.05;
const LEVER_SPREAD: f64 = 0.003;
/// Standard deviations beyond which a scale is wrong.
const LIMIT: f64 = 3.3;

/// Logarithm of nominal over identified stiffness, nearest to zero among the stiffnesses that one
/// may call the joint's (spring, secant, tangent, reversal): what a definition can explain is no
/// error. `None` without a nominal value.
pub fn nominal_excess(file: &LoadCycle, spring: f64, settled: &Settled) -> Option<f64> {
    let nominal = file.facts.nominal_stiffness?;
    let all = [spring, settled.secant, settled.tangent, settled.reversal];
    let logs: Vec<f64> = all
        .iter()
        .filter(|k| **k > 0.0)
        .map(|k| (nominal / k).ln())
        .collect();
    let (low, high) = ends(&logs);
    if logs.is_empty() {
        return None;
    }
    Some(if low <= 0.0 && high >= 0.0 {
        0.0
    } else if low > 0.0 {
        low
    } else {
        high
    })
}

/// Judges the scales of a file. `excess` as from [`nominal_excess`], `stderr` its standard error.
pub fn judge(file: &LoadCycle, excess: Option<f64>, stderr: f64) -> Scales {
    let spreads = Spreads::of(file, stderr);
    let mut scales = Scales::default();
    let Some((ratio, error)) = log_ratio(file) else {
        scales
            .findings
            .extend(excess.and_then(|e| alone(file, e, &spreads)));
        return scales;
    };
    let between = (2.0 * spreads.lever.powi(2) + error * error).sqrt();
    if ratio.abs() > LIMIT * between {
        let (wrong, finding) = disagreement(ratio, excess, &spreads);
        scales.findings.push(finding);
        let good = excess.map(|e| if wrong == 1 { e + ratio } else { e });
        scales
            .findings
            .extend(good.and_then(|e| agreed(file, e, &spreads)));
    } else {
        let mean = excess.map(|e| e + 0.5 * ratio);
        scales
            .findings
            .extend(mean.and_then(|e| agreed(file, e, &spreads)));
    }
    scales
}

struct Spreads {
    nominal: f64,
    lever: f64,
    total: f64,
}

impl Spreads {
    fn of(file: &LoadCycle, stderr: f64) -> Self {
        let nominal = file.facts.nominal_rel_std.unwrap_or(NOMINAL_SPREAD);
        let lever = file.facts.lever_rel_std.unwrap_or(LEVER_SPREAD);
        let total = (nominal * nominal + 2.0 * lever * lever + stderr * stderr).sqrt();
        Self {
            nominal,
            lever,
            total,
        }
    }
}

/// The lasers disagree: which one is off, and whether it can be an inclined one (reads too little).
fn disagreement(ratio: f64, excess: Option<f64>, spreads: &Spreads) -> (usize, ScaleFinding) {
    let nats = |e: f64| -0.5 * (e / spreads.total).powi(2);
    let odds = excess.map_or(0.0, |e| nats(e + ratio) - nats(e));
    let wrong = if odds >= 0.0 { 1 } else { 2 };
    let off = if wrong == 1 { -ratio } else { ratio };
    let site = if wrong == 1 { "sensor" } else { "sensor2" };
    let decided = odds.abs() > 3.0;
    let long_only = off > 0.0 && decided;
    let candidates = match long_only {
        true => vec![("lever_arm", site.to_string(), 1.0)],
        false => vec![
            ("lever_arm", site.to_string(), 0.5),
            ("cosine_error", site.to_string(), 0.5),
        ],
    };
    (
        wrong,
        ScaleFinding {
            candidates,
            excess: off.exp_m1(),
        },
    )
}

/// Both lasers agree on a deflection that the nominal stiffness does not give: the joint, unless
/// the load lever is wrong. Heavy-tailed priors of the stated widths weigh the two.
fn agreed(file: &LoadCycle, excess: f64, spreads: &Spreads) -> Option<ScaleFinding> {
    if excess.abs() <= LIMIT * spreads.total {
        return None;
    }
    let tail = |width: f64| width / (width * width + excess * excess);
    let (joint, lever) = (
        tail(spreads.nominal.max(1e-4)),
        tail(spreads.lever.max(1e-4)),
    );
    let probability = joint / (joint + lever);
    let mut candidates = vec![
        ("stiffness", file.site(), probability),
        ("lever_arm", "load".to_string(), 1.0 - probability),
    ];
    candidates.sort_by(|a, b| b.2.total_cmp(&a.2));
    if candidates[0].2 > 0.6 && candidates[0].0 == "stiffness" {
        candidates.truncate(1);
    }
    Some(ScaleFinding {
        candidates,
        excess: excess.exp_m1(),
    })
}

/// One laser: nothing separates stiffness, lever and inclination.
fn alone(file: &LoadCycle, excess: f64, spreads: &Spreads) -> Option<ScaleFinding> {
    if excess.abs() <= LIMIT * spreads.total {
        return None;
    }
    let tail = |width: f64| width / (width * width + excess * excess);
    let weights = [
        ("stiffness", file.site(), tail(spreads.nominal.max(1e-4))),
        (
            "lever_arm",
            "sensor".to_string(),
            2.0 * tail(spreads.lever.max(1e-4)),
        ),
        (
            "cosine_error",
            "sensor".to_string(),
            if excess < 0.0 {
                tail(spreads.lever.max(1e-4))
            } else {
                0.0
            },
        ),
    ];
    let total: f64 = weights.iter().map(|w| w.2).sum();
    let candidates = weights
        .into_iter()
        .filter(|w| w.2 > 0.0)
        .map(|(e, s, w)| (e, s, w / total))
        .collect();
    Some(ScaleFinding {
        candidates,
        excess: excess.exp_m1(),
    })
}
