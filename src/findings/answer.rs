//! What every diagnosis answers, whatever was measured: the verdict, the causes, what cannot be told
//! apart, what is left.

use super::gain::Gain;
use crate::fit::suitability::{Doubt, is_fatal, is_odd};

/// The verdict on a simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The simulation is right to within the noise.
    Sufficient,
    /// Causes found, nothing left.
    Explained,
    /// Causes found, structure remains.
    PartlyExplained,
    /// Structure that nobody in the library explains.
    UnknownCause,
    /// The data cannot separate the candidates.
    CannotTell,
}

impl Verdict {
    /// By how many causes and groups of them were named, and whether structure is left.
    pub fn of(causes: usize, groups: usize, left: bool) -> Self {
        match (causes + groups == 0, left) {
            (true, true) => Self::UnknownCause,
            (true, false) => Self::Sufficient,
            (false, true) => Self::PartlyExplained,
            (false, false) if causes == 0 => Self::CannotTell,
            (false, false) => Self::Explained,
        }
    }

    /// As in the JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sufficient => "sufficient",
            Self::Explained => "explained",
            Self::PartlyExplained => "partly-explained",
            Self::UnknownCause => "unknown-cause",
            Self::CannotTell => "cannot-tell",
        }
    }
}

/// A named cause.
#[derive(Debug, Clone, PartialEq)]
pub struct Cause {
    /// Its name.
    pub effect: &'static str,
    /// Where.
    pub site: String,
    /// Probability that it is present.
    pub probability: f64,
    /// What it is, one sentence.
    pub summary: &'static str,
    /// Runners-up: effect, site, probability.
    pub alternatives: Vec<(&'static str, String, f64)>,
    /// Its parameters: name, value SI, unit.
    pub parameters: Vec<(&'static str, f64, &'static str)>,
    /// 95 % intervals of those that have one, by name, SI.
    pub ci95: Vec<(&'static str, [f64; 2])>,
    /// What naming it gains.
    pub gain: Gain,
}

/// Name of the parameter that says how large, at most, a cause that is gone may still be (95 %).
pub const LIMIT: &str = "limit95";

impl Cause {
    /// The largest first parameter that the data allow, where the cause is gone.
    pub fn limit(&self) -> Option<f64> {
        let found = self.parameters.iter().find(|(name, ..)| *name == LIMIT);
        found.map(|(_, limit, _)| *limit)
    }

    /// The 95 % interval of a parameter, where it has one.
    pub fn interval(&self, name: &str) -> Option<[f64; 2]> {
        let found = self.ci95.iter().find(|(own, _)| *own == name);
        found.map(|(_, interval)| *interval)
    }
}

/// Causes that these data cannot tell apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// The candidates, most probable first.
    pub effects: Vec<&'static str>,
    /// Their sites.
    pub sites: Vec<String>,
    /// What would tell.
    pub would_tell: String,
    /// What any of them gains.
    pub gain: Gain,
    /// Probability of the first.
    pub probability: f64,
}

/// One row of the candidates' table: causes (with their sites where these differ), probability, nats
/// of misfit explained.
pub type Candidate = (Vec<String>, f64, f64);

/// How far the present simulation is off.
#[derive(Debug, Clone, PartialEq)]
pub struct Discrepancy {
    /// Rms of measured − simulated, in the answer's unit.
    pub rms: f64,
    /// Noise that the data themselves show.
    pub noise_rms: f64,
    /// Where it is largest, a phrase.
    pub place: String,
}

/// Structure that is left, without a model: means over load on either branch, and over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Structure {
    /// Share of the discrepancy's variance that nothing explained.
    pub share_of_variance: f64,
    /// Mean residual over load: [load, residual].
    pub shape: Vec<[f64; 2]>,
    /// Mean residual over time: [s, residual].
    pub over_time: Vec<[f64; 2]>,
    /// What is seen, in words.
    pub description: String,
}

/// The answer to a measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The verdict.
    pub verdict: Verdict,
    /// How far the present simulation is off.
    pub discrepancy: Discrepancy,
    /// Named causes, in order of gain.
    pub causes: Vec<Cause>,
    /// Groups that cannot be separated.
    pub groups: Vec<Group>,
    /// What is left.
    pub unexplained: Structure,
    /// Probability that chance leaves so much.
    pub p_value: f64,
    /// The sets that were compared, most probable first.
    pub candidates: Vec<Candidate>,
    /// Unit of the discrepancy and of the errors of every gain.
    pub unit: &'static str,
    /// Noise in words.
    pub noise: String,
    /// Whether nobody stated a simulation: the error is then that of a straight spring fitted here.
    pub unstated: bool,
    /// What is odd about the data.
    pub doubts: Vec<Doubt>,
}

impl Answer {
    /// The same answer with what is odd about the data. Where that is fatal nothing is named: the data
    /// cannot tell, and the remedies say what would.
    #[must_use]
    pub fn doubted(mut self, doubts: Vec<Doubt>) -> Self {
        if is_fatal(&doubts) {
            self.verdict = Verdict::CannotTell;
            self.causes.clear();
            self.groups.clear();
            self.candidates.clear();
        }
        self.doubts = doubts;
        self
    }

    /// Whether these data cannot carry any answer.
    pub fn is_withheld(&self) -> bool {
        is_fatal(&self.doubts)
    }

    /// How many causes are named, groups of them as one.
    pub fn named(&self) -> usize {
        self.causes.len() + self.groups.len()
    }

    /// Whether something is left that no name makes.
    pub fn is_open(&self) -> bool {
        matches!(
            self.verdict,
            Verdict::UnknownCause | Verdict::PartlyExplained
        )
    }

    /// Whether the simulation is right to within the noise, and nothing is odd about the data.
    pub fn is_fine(&self) -> bool {
        self.verdict == Verdict::Sufficient && !is_odd(&self.doubts)
    }
}
