//! Which known cause would explain what changed between two sets of fits.
//!
//! Every parameter gives a row: its relative change and the standard error of that. A cause moves some rows by
//! one amount: a soft drive its stiffness in every fit that knows it, a gain of a force sensor every parameter
//! by the power with which its unit holds a force. Sets of causes are weighed by what they leave and what they
//! cost (Chen and Chen, Extended Bayesian information criteria, Biometrika 2008: the more causes could have
//! been taken, the dearer each is). Sets that are weighed alike are told as not separable.

mod suspects;

pub use suspects::Suspect;

use super::compare::Comparison;
use super::parameter::Z95;
use crate::ground::stats::above;
use std::cmp::Ordering;
use suspects::{Row, is_wide, row, suspects};

/// Sets within these odds of the best (1 to 20) are not separable from it: twice the logarithm.
const ALIKE: f64 = 5.99;
/// Most causes of whole campaigns in one set.
const WIDE: usize = 2;
/// Rows that every set leaves beyond this many standard errors, over all rows at 5 %, are told as left.
const LEVEL: f64 = 0.05;

/// A cause in a set, with its amount.
#[derive(Debug, Clone, PartialEq)]
pub struct Blamed {
    /// The cause.
    pub suspect: Suspect,
    /// Its factor less one, and the standard error of that.
    pub amount: [f64; 2],
}

/// A set of causes that would explain the change.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// The causes; empty: nothing happened.
    pub blamed: Vec<Blamed>,
    /// What is left: sum of squares in standard errors.
    pub left: f64,
    score: f64,
}

/// What would explain a comparison.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Explained {
    /// The best sets, best first; more than one: not separable.
    pub sets: Vec<Explanation>,
    /// Sum of squares in standard errors if nothing happened, over how many parameters.
    pub before: (f64, usize),
    /// How many causes were tried.
    pub tried: usize,
    /// Parameters that the best set leaves beyond their intervals.
    pub unexplained: Vec<String>,
}

/// Explains a comparison.
pub fn explain(comparison: &Comparison) -> Explained {
    let rows: Vec<Row> = comparison.pairs.iter().filter_map(row).collect();
    let suspects = suspects(&rows);
    let mut sets: Vec<Explanation> = Vec::new();
    let wide: Vec<usize> = (0..suspects.len())
        .filter(|s| is_wide(&suspects[*s]))
        .collect();
    for chosen in subsets(&wide) {
        let found = grown(&rows, &suspects, &chosen);
        keep(&mut sets, weighed(&rows, &suspects, &found));
        for other in replaced(&found, &suspects) {
            keep(&mut sets, weighed(&rows, &suspects, &other));
        }
    }
    // Rounding must not decide between sets that are weighed alike.
    let rank = |set: &Explanation| ((1e6 * set.score).round(), set.blamed.len());
    sets.sort_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(Ordering::Equal));
    let best = sets.first().map_or(0.0, |set| set.score);
    sets.retain(|set| set.score - best <= ALIKE);
    // A set that holds another one with something more tells nothing new.
    let small: Vec<Vec<Suspect>> = sets.iter().map(Explanation::suspects).collect();
    let holds = |a: &[Suspect], b: &[Suspect]| a.len() > b.len() && b.iter().all(|s| a.contains(s));
    sets.retain(|set| !small.iter().any(|other| holds(&set.suspects(), other)));
    Explained {
        before: (square(&rows, &vec![0.0; rows.len()]), rows.len()),
        unexplained: sets
            .first()
            .map_or(Vec::new(), |set| set.unexplained(&rows)),
        tried: suspects.len(),
        sets,
    }
}

fn subsets(wide: &[usize]) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for one in wide {
        let more: Vec<Vec<usize>> = all
            .iter()
            .filter(|set: &&Vec<usize>| set.len() < WIDE)
            .map(|set| [&set[..], &[*one]].concat())
            .collect();
        all.extend(more);
    }
    all
}

/// The set with every further single cause that pays, the best first.
fn grown(rows: &[Row], suspects: &[Suspect], start: &[usize]) -> Vec<usize> {
    let mut set = start.to_vec();
    let score = |set: &[usize]| weighed(rows, suspects, set).score;
    let mut best = score(&set);
    loop {
        let more = (0..suspects.len()).filter(|s| !is_wide(&suspects[*s]) && !set.contains(s));
        let tried = more
            .map(|s| [&set[..], &[s]].concat())
            .map(|set| (score(&set), set));
        match tried.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((found, larger)) if found < best => (best, set) = (found, larger),
            _ => return set,
        }
    }
}

/// The set with one of its causes exchanged for any other.
fn replaced(set: &[usize], suspects: &[Suspect]) -> Vec<Vec<usize>> {
    let mut all = Vec::new();
    for k in 0..set.len() {
        for other in (0..suspects.len()).filter(|s| !set.contains(s)) {
            let mut one = set.to_vec();
            one[k] = other;
            all.push(one);
        }
    }
    all
}

fn keep(sets: &mut Vec<Explanation>, set: Explanation) {
    let same = |a: &Explanation| {
        let (a, b) = (a.suspects(), set.suspects());
        a.len() == b.len() && a.iter().all(|s| b.contains(s))
    };
    if !sets.iter().any(same) {
        sets.push(set);
    }
}

/// A set with its amounts by least squares, and its score.
fn weighed(rows: &[Row], suspects: &[Suspect], set: &[usize]) -> Explanation {
    let count = set.len();
    let mut normal = nalgebra::DMatrix::<f64>::zeros(count, count);
    let mut slope = nalgebra::DVector::<f64>::zeros(count);
    let power = |s: usize, i: usize| {
        let found = suspects[set[s]].moves.iter().find(|(row, _)| *row == i);
        found.map_or(0.0, |(_, power)| *power)
    };
    for (i, row) in rows.iter().enumerate() {
        let weight = row.change[1].powi(-2);
        for a in 0..count {
            slope[a] += weight * power(a, i) * row.change[0];
            for b in 0..count {
                normal[(a, b)] += weight * power(a, i) * power(b, i);
            }
        }
    }
    let raised = &normal + nalgebra::DMatrix::from_diagonal(&(normal.diagonal() * 1e-9));
    let inverse = raised.try_inverse();
    // Causes that move the same rows alike cannot stand together: such a set tells nothing.
    let sound = inverse
        .as_ref()
        .is_some_and(|inverse| (0..count).all(|a| inverse[(a, a)] * normal[(a, a)] < 1e4));
    let inverse = inverse.unwrap_or_else(|| nalgebra::DMatrix::zeros(count, count));
    let amounts = &inverse * slope;
    let fitted: Vec<f64> = (0..rows.len())
        .map(|i| (0..count).map(|a| power(a, i) * amounts[a]).sum())
        .collect();
    let left = square(rows, &fitted);
    let (n, m) = (rows.len().max(2) as f64, suspects.len().max(1) as f64);
    let price = count as f64 * (n.ln() + 2.0 * m.ln());
    let blamed = (0..count).map(|a| Blamed {
        suspect: suspects[set[a]].clone(),
        amount: [amounts[a], inverse[(a, a)].max(0.0).sqrt()],
    });
    Explanation {
        blamed: blamed.collect(),
        left,
        score: if sound { left + price } else { f64::INFINITY },
    }
}

fn square(rows: &[Row], fitted: &[f64]) -> f64 {
    let one = |(row, fitted): (&Row, &f64)| ((row.change[0] - fitted) / row.change[1]).powi(2);
    rows.iter().zip(fitted).map(one).sum()
}

impl Explanation {
    fn suspects(&self) -> Vec<Suspect> {
        self.blamed.iter().map(|one| one.suspect.clone()).collect()
    }

    fn fitted(&self, i: usize) -> f64 {
        let of = |one: &Blamed| {
            let found = one.suspect.moves.iter().find(|(row, _)| *row == i);
            found.map_or(0.0, |(_, power)| power * one.amount[0])
        };
        self.blamed.iter().map(of).sum()
    }

    fn unexplained(&self, rows: &[Row]) -> Vec<String> {
        let beyond = |(i, row): &(usize, &Row)| {
            let z = (row.change[0] - self.fitted(*i)).abs() / row.change[1];
            2.0 * above(z) < LEVEL / rows.len() as f64
        };
        let left = rows.iter().enumerate().filter(beyond);
        left.map(|(_, row)| format!("{} of {}", row.name, row.site))
            .collect()
    }
}

impl Blamed {
    /// Whether its amount is a factor on what was there, with its interval in per cent.
    pub fn percent(&self) -> [f64; 3] {
        let [amount, error] = self.amount.map(|v| 100.0 * v);
        [amount, amount - Z95 * error, amount + Z95 * error]
    }
}

#[cfg(test)]
mod tests;
