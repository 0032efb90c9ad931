//! What a kind of measurement brings to its diagnosis.

use super::arrival::Arrival;
use super::aspect::Aspects;
use super::noise::Noise;
use crate::inference::gaussian::Size;
use nalgebra::DMatrix;
use std::collections::BTreeSet;

/// What is uncertain although nothing is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct Nuisance {
    /// What one unit of it adds to the readings.
    pub column: Vec<f64>,
    /// Its standard deviation before the data; infinite: nothing is known.
    pub spread: f64,
}

/// One shape in which a suspect may act.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// What one unit of each amount adds to the readings.
    pub columns: Vec<Vec<f64>>,
    /// The amounts' standard deviation before the data: [`Size::Given`] in units of the columns (one for
    /// all: scale the columns), or [`Size::Free`] where nobody knows how large the effect is,
    /// [`Size::Drawn`] where many amounts follow one prior.
    pub size: Size,
    /// Where physics fixes the sign: weights of the amounts whose sum must come out positive.
    pub positive: Option<Vec<f64>>,
    /// Where the columns are those of an effect of one strength and no straight line: the largest amount must come out between these
    /// ([`Size::Given`] alone).
    pub within: Option<[f64; 2]>,
    /// What the kind needs to know its shape again (a width, a place, a time constant).
    pub shape: Vec<f64>,
    /// Nats by which it is less likely than the other shapes of its suspect.
    pub rare: f64,
}

impl Member {
    /// One column of free size and either sign.
    pub fn free(column: Vec<f64>) -> Self {
        Self {
            columns: vec![column],
            size: Size::Free,
            positive: None,
            within: None,
            shape: Vec::new(),
            rare: 0.0,
        }
    }

    /// One column whose amount has this standard deviation before the data.
    pub fn given(column: Vec<f64>, spread: f64) -> Self {
        Self {
            size: Size::Given(spread),
            ..Self::free(column)
        }
    }

    /// The same, known to be positive.
    #[must_use]
    pub fn positive(mut self) -> Self {
        self.positive = Some(vec![1.0; self.columns.len()]);
        self
    }

    /// The same, less likely by so many nats.
    #[must_use]
    pub fn rare(mut self, nats: f64) -> Self {
        self.rare = nats;
        self
    }

    /// Whether amounts are of the strength that its columns are of.
    pub fn allows(&self, amounts: &[f64]) -> bool {
        let largest = amounts
            .iter()
            .copied()
            .max_by(|a, b| a.abs().total_cmp(&b.abs()));
        self.within
            .zip(largest)
            .is_none_or(|([least, most], x)| (least..=most).contains(&x))
    }

    /// Whether amounts are of the sign that it has, where it has one.
    pub fn has_sign(&self, amounts: &[f64]) -> bool {
        let Some(weights) = &self.positive else {
            return true;
        };
        let own = weights.iter().zip(amounts);
        own.map(|(weight, x)| weight * x).sum::<f64>() > 0.0
    }

    /// The same with its shape.
    #[must_use]
    pub fn shaped(mut self, shape: &[f64]) -> Self {
        self.shape = shape.to_vec();
        self
    }
}

/// Whether a cause can be of this shape and of these amounts.
pub type CanBe = fn(&[f64], &[f64]) -> bool;

/// Who may be to blame: an effect at a site, in any of its shapes.
#[derive(Debug, Clone)]
pub struct Suspect {
    /// Name of the effect.
    pub effect: &'static str,
    /// Where.
    pub site: String,
    /// What it is, one sentence.
    pub summary: &'static str,
    /// Suspects of one mechanism hardly ever act together: one law of another shape explains both.
    pub mechanism: &'static str,
    /// Logarithm of its share among the sites of its effect: 0 for the only one.
    pub share: f64,
    /// Its shapes.
    pub members: Vec<Member>,
    /// Whether it is a cause of the library. A pattern that none of them has competes with them, so that it
    /// takes none of their names, and is never named.
    pub named: bool,
    /// Share of its own size by which its law may miss nature: a companion must be above that. 0 where
    /// [`Judgement::share`](super::Judgement::share) says enough.
    pub law_error: f64,
    /// Whether it can be of a shape and amounts (units of the columns): beyond what is uncertain of it anyway, and no larger
    /// than such a cause is.
    pub can_be: CanBe,
}

/// Mechanism of what is the same in every reading. Its law is exact, and its size, any zero, says nothing of the others': beside it
/// nothing is small, and it has no misfit that could be taken for another cause.
pub const LEVEL: &str = "constant";

impl Suspect {
    /// How many shapes it has, the strengths of one counted once.
    pub fn forms(&self) -> usize {
        let form = |m: &Member| -> Option<Vec<u64>> {
            let (_, form) = m.shape.split_last().filter(|_| m.within.is_some())?;
            Some(form.iter().map(|x| x.to_bits()).collect())
        };
        let bent: BTreeSet<Vec<u64>> = self.members.iter().filter_map(form).collect();
        let straight = self.members.iter().filter(|m| form(m).is_none()).count();
        bent.len() + straight
    }

    /// Whether it is the same in every reading.
    pub fn is_level(&self) -> bool {
        self.mechanism == LEVEL
    }
}

/// The linear statement of a diagnosis: reading = nuisances + causes + noise.
pub struct Statement {
    /// Measured less simulated. About amounts other than zero: measured less simulated there, plus the
    /// columns times these amounts, so that amounts are always totals.
    pub reading: Vec<f64>,
    /// The noise.
    pub noise: Box<dyn Noise>,
    /// What is uncertain although nothing is wrong.
    pub nuisances: Vec<Nuisance>,
    /// Who may be to blame.
    pub suspects: Vec<Suspect>,
    /// Smooth or local structure of any kind, falling with its order, one unit rms each: what shows that
    /// something is left. Left out: no test of what is left but the noise's own size.
    pub span: Vec<Vec<f64>>,
    /// Ways to hold out rows, coarse first: the fold of every row.
    pub splits: Vec<Vec<usize>>,
    /// What kinds of change laws make: a cause stands beside another if it is larger than what that one's law misses of
    /// its own kind.
    pub aspects: Aspects,
}

impl Statement {
    /// A reading and its noise: nothing uncertain, nobody to blame.
    pub fn bare(reading: Vec<f64>, noise: Box<dyn Noise>) -> Self {
        Self {
            reading,
            noise,
            nuisances: Vec::new(),
            suspects: Vec::new(),
            span: Vec::new(),
            splits: Vec::new(),
            aspects: Aspects::default(),
        }
    }

    /// Whether the readings are those of another statement to well within the noise.
    pub fn reads_as(&self, other: &Statement) -> bool {
        let each = self
            .reading
            .iter()
            .zip(&other.reading)
            .zip(self.noise.spread());
        each.map(|((a, b), s)| (a - b).abs() / s)
            .fold(0.0, f64::max)
            < ALIKE
    }
}

/// Noise deviations below which two readings are one.
const ALIKE: f64 = 0.3;

/// A cause in a chosen set.
#[derive(Debug, Clone, PartialEq)]
pub struct Blamed {
    /// Name of the effect.
    pub effect: &'static str,
    /// Where.
    pub site: String,
    /// The member's shape.
    pub shape: Vec<f64>,
    /// Its amounts, in units of its columns.
    pub amounts: Vec<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// What it adds to the readings, per row.
    pub part: Vec<f64>,
}

/// What is left, in the words and axes of the kind.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Remaining {
    /// Over load (or what stands for it): [load, residual].
    pub shape: Vec<[f64; 2]>,
    /// Over time: [s, residual].
    pub over_time: Vec<[f64; 2]>,
    /// In words.
    pub description: String,
}

/// Rivals that are fitted until they arrive and weighed by what they are worth there (`engine/peers`). Statements about different
/// causes differ in little but their readings where any is, so that evidence of several compares.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Peers {
    /// None: straight lines say enough.
    Nobody,
    /// Those of the same mechanism.
    Kin,
    /// All that are near; every statement has the same uncertain numbers in the same order.
    Near,
}

/// A kind of measurement, as its diagnosis needs it.
pub trait Experiment: Sync {
    /// Unit of the readings.
    fn unit(&self) -> &'static str;
    /// The linear statement about these causes; linear kinds ignore them.
    fn state(&self, about: &[Blamed]) -> Statement;
    /// The same with what is merely uncertain as found too, an amount for each nuisance of the statement; in
    /// the new statement these too are totals. Kinds whose readings are linear in it ignore it.
    fn state_beside(&self, about: &[Blamed], _uncertain: &[f64]) -> Statement {
        self.state(about)
    }
    /// The same where only some suspects (effect, site) are asked for; whoever else is in it is not looked at.
    fn state_among(
        &self,
        about: &[Blamed],
        uncertain: &[f64],
        _names: &[(&'static str, String)],
    ) -> Statement {
        self.state_beside(about, uncertain)
    }
    /// Whether [`Experiment::state`] depends on the causes.
    fn is_linear(&self) -> bool {
        true
    }
    /// Which rivals of what was found are fitted until they arrive.
    fn peers(&self) -> Peers {
        Peers::Nobody
    }
    /// Whether a statement about what was found says the same as the one before, so that nobody need look again.
    fn is_settled(&self, _before: &Statement, _after: &Statement) -> bool {
        false
    }
    /// Whether laws are only nearly right, so that a small misfit of a large effect does not tell which of
    /// them is at work.
    fn has_rough_laws(&self) -> bool {
        false
    }
    /// Whether intervals of the parameters of an effect hold the truth as often as they say, as far as was counted.
    fn has_sure_intervals(&self, _effect: &str) -> bool {
        true
    }
    /// Whether what a set leaves scatters from reading to reading and no more: then nothing beyond the set is
    /// asked for. Kinds whose readings have no neighbours cannot say.
    fn is_scatter(&self, _left: &[f64]) -> bool {
        false
    }
    /// Causes that are told by where they fit best beside all others that were found. None: as the last statement has them.
    fn arrived(&self, _found: &[Blamed]) -> Vec<Arrival> {
        Vec::new()
    }
    /// The parameters of a named cause: name, value SI, unit.
    fn parameters(&self, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)>;
    /// What would tell these rivals (effect, site) apart: a phrase.
    fn would_tell(&self, rivals: &[(&'static str, String)]) -> String;
    /// Where a residual is largest: a phrase that ends "the error is ...".
    fn place(&self, missed: &[f64]) -> String;
    /// What is left.
    fn remaining(&self, left: &[f64]) -> Remaining;
}
