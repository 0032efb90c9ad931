//! Scale errors: lever, inclined laser, or a stiffness that is not nominal.
//!
//! All three only stretch the curve. A second laser and the stated uncertainties of levers and
//! nominal stiffness tell them apart, nothing else does.

use crate::experiments::load_cycle::Settled;
use crate::findings::engine::Judgement;
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
pub(super) const LEVER_SPREAD: f64 = 0.003;
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

/// The lasers disagree: which one is off. An inclined one reads too little of what moves along itself, and too much of a plate that moves
/// square to its face.
fn disagreement(ratio: f64, excess: Option<f64>, spreads: &Spreads) -> (usize, ScaleFinding) {
    let nats = |e: f64| -0.5 * (e / spreads.total).powi(2);
    let odds = excess.map_or(0.0, |e| nats(e + ratio) - nats(e));
    let wrong = if odds >= 0.0 { 1 } else { 2 };
    let off = if wrong == 1 { -ratio } else { ratio };
    let site = if wrong == 1 { "sensor" } else { "sensor2" };
    let candidates = ["lever_arm", "cosine_error"].map(|effect| (effect, site.to_string(), 0.5));
    (
        wrong,
        ScaleFinding {
            candidates: candidates.to_vec(),
            excess: off.exp_m1(),
        },
    )
}

/// Both lasers agree on a deflection that the nominal stiffness does not give: the joint, unless the load's lever is
/// wrong, or the load pulls aslant, which turns the joint less. Heavy-tailed priors of the stated widths weigh them.
fn agreed(file: &LoadCycle, excess: f64, spreads: &Spreads) -> Option<ScaleFinding> {
    let own = [
        ("stiffness", file.site(), 1.0),
        ("lever_arm", "load".to_string(), 1.0),
        ("cosine_error", "load".to_string(), 1.0),
    ];
    let mut finding = weighed(own, excess, spreads)?;
    finding.candidates.sort_by(|a, b| b.2.total_cmp(&a.2));
    let (first, probability) = (finding.candidates[0].0, finding.candidates[0].2);
    let least = Judgement::default().ambiguous * probability;
    if first == "stiffness" {
        finding.candidates.retain(|c| c.2 >= least);
    }
    Some(finding)
}

/// One laser: nothing separates stiffness, lever and inclination.
fn alone(file: &LoadCycle, excess: f64, spreads: &Spreads) -> Option<ScaleFinding> {
    let own = [
        ("stiffness", file.site(), 1.0),
        ("lever_arm", "sensor".to_string(), 2.0),
        ("cosine_error", "sensor".to_string(), 1.0),
    ];
    weighed(own, excess, spreads)
}

/// Candidates, so many of each, by heavy-tailed priors of the stated widths; a load that pulls aslant turns the joint less.
fn weighed(
    candidates: [(&'static str, String, f64); 3],
    excess: f64,
    spreads: &Spreads,
) -> Option<ScaleFinding> {
    if excess.abs() <= LIMIT * spreads.total {
        return None;
    }
    let weight = |effect: &str| {
        let width = match effect {
            "stiffness" => spreads.nominal,
            _ => spreads.lever,
        };
        let width = width.max(1e-4);
        width / (width * width + excess * excess)
    };
    let possible =
        |(effect, site): (&str, &str)| excess < 0.0 || (effect, site) != ("cosine_error", "load");
    let all = candidates.map(|(effect, site, count)| {
        let count = if possible((effect, &site)) {
            count
        } else {
            0.0
        };
        (effect, site, count * weight(effect))
    });
    let total: f64 = all.iter().map(|c| c.2).sum();
    let possible = all.into_iter().filter(|c| c.2 > 0.0);
    Some(ScaleFinding {
        candidates: possible.map(|(e, s, w)| (e, s, w / total)).collect(),
        excess: excess.exp_m1(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::table::Table;

    /// Names by a file whose nominal stiffness is known so well, beside readings that are off by `excess`.
    fn told(known: f64, excess: f64, of: Judge) -> Vec<&'static str> {
        let text = format!(
            "# kind = \"load-cycle\"\n# joint = 6\n# axis = \"rotation\"\n# nominal_stiffness_Nm_rad = 1e6\n\
             # nominal_stiffness_rel_std = {known}\ntime_s,moment_Nm,angle_rad\n0,0,0\n1,100,1e-4\n2,0,0\n3,-100,-1e-4\n4,0,0\n"
        );
        let bytes = text.len() as u64;
        let table = Table::from_reader("cycle.csv".as_ref(), text.as_bytes(), bytes).unwrap();
        let file = LoadCycle::from_table(table).unwrap();
        let found = of(&file, excess, &Spreads::of(&file, 1e-4));
        let candidates = found.map_or(Vec::new(), |f| f.candidates);
        candidates.into_iter().map(|c| c.0).collect()
    }

    type Judge = fn(&LoadCycle, f64, &Spreads) -> Option<ScaleFinding>;

    #[test]
    fn two_lasers_that_agree_do_not_tell_a_joint_from_its_load() {
        assert_eq!(told(0.02, 0.09, agreed), ["stiffness", "lever_arm"]);
        let aslant = ["stiffness", "lever_arm", "cosine_error"];
        assert_eq!(told(0.02, -0.09, agreed), aslant);
        // who knows the joint worse than that believes that it is the joint
        assert_eq!(told(0.05, 0.3, agreed), ["stiffness"]);
        assert_eq!(told(0.05, -0.3, agreed), ["stiffness"]);
        assert!(told(0.05, 0.1, agreed).is_empty());
    }

    #[test]
    fn one_laser_tells_nothing() {
        assert_eq!(told(0.02, 0.09, alone).len(), 3);
        assert_eq!(told(0.02, -0.09, alone).len(), 3);
    }
}
