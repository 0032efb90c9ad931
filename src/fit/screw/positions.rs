//! Readings of an axis, target by target.

use crate::ground::problem::{Outcome, Problem};
use crate::measurement::screw::ScrewTest;
use crate::signal::outliers::median;
use std::collections::BTreeMap;

/// One target with its deviations (actual less target), m, in the order of the runs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Target {
    /// Where it is, m.
    pub at: f64,
    /// Approached in positive direction.
    pub forward: Vec<f64>,
    /// Approached in negative direction.
    pub backward: Vec<f64>,
}

impl Target {
    /// Mean of some deviations; none without any.
    pub fn middle(deviations: &[f64]) -> Option<f64> {
        let n = deviations.len();
        (n > 0).then(|| deviations.iter().sum::<f64>() / n as f64)
    }

    /// Standard deviation with n − 1; none with fewer than two.
    pub fn deviation(deviations: &[f64]) -> Option<f64> {
        let mean = Self::middle(deviations).filter(|_| deviations.len() > 1)?;
        let squares: f64 = deviations.iter().map(|x| (x - mean).powi(2)).sum();
        Some((squares / (deviations.len() - 1) as f64).sqrt())
    }

    /// Mean of both directions, or of the one that there is.
    pub fn mean(&self) -> Option<f64> {
        match (Self::middle(&self.forward), Self::middle(&self.backward)) {
            (Some(forward), Some(backward)) => Some(0.5 * (forward + backward)),
            (one, other) => one.or(other),
        }
    }

    /// Readings of the direction that has fewer (of those that were measured).
    pub fn runs(&self) -> usize {
        let counts = [self.forward.len(), self.backward.len()];
        counts.into_iter().filter(|n| *n > 0).min().unwrap_or(0)
    }
}

/// Which readings a mean leaves out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extremes {
    /// The highest and the lowest of each target and direction (source 003, 3.2), from three on.
    Dropped,
    /// Those further from the median than 3.5 times the standard deviation that the median of all
    /// distances suggests.
    Robust,
    /// None.
    Kept,
}

impl Extremes {
    /// The targets without them, and how many readings were left out.
    pub fn without(self, targets: &[Target]) -> (Vec<Target>, usize) {
        let limit = 3.5 * spread(targets);
        let keep = |deviations: &[f64]| match self {
            Self::Kept => deviations.to_vec(),
            Self::Dropped => trimmed(deviations),
            Self::Robust => near(deviations, limit),
        };
        let thin = |t: &Target| Target {
            at: t.at,
            forward: keep(&t.forward),
            backward: keep(&t.backward),
        };
        let kept: Vec<Target> = targets.iter().map(thin).collect();
        let count = |targets: &[Target]| -> usize {
            targets
                .iter()
                .map(|t| t.forward.len() + t.backward.len())
                .sum()
        };
        let dropped = count(targets) - count(&kept);
        (kept, dropped)
    }
}

fn trimmed(deviations: &[f64]) -> Vec<f64> {
    if deviations.len() < 3 {
        return deviations.to_vec();
    }
    let mut sorted = deviations.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[1..sorted.len() - 1].to_vec()
}

fn near(deviations: &[f64], limit: f64) -> Vec<f64> {
    if deviations.len() < 3 || limit <= 0.0 {
        return deviations.to_vec();
    }
    let middle = median(deviations);
    deviations
        .iter()
        .copied()
        .filter(|x| (x - middle).abs() <= limit)
        .collect()
}

/// Standard deviation of the readings about the medians of their targets, from the median of the
/// distances; corrected for the share that the median of few takes away.
fn spread(targets: &[Target]) -> f64 {
    let lists = targets
        .iter()
        .flat_map(|t| [&t.forward, &t.backward])
        .filter(|l| l.len() > 2);
    let distances = lists.flat_map(|list| {
        let n = list.len() as f64;
        let middle = median(list);
        list.iter()
            .map(move |x| (x - middle).abs() * (n / (n - 1.0)).sqrt())
    });
    let distances: Vec<f64> = distances.collect();
    1.4826 * median(&distances)
}

/// Targets closer than this are one, m.
const SAME: f64 = 1e-9;

/// Everything that was read, by target from low to high.
///
/// # Errors
/// Fewer than three targets.
pub fn targets(tests: &[ScrewTest]) -> Outcome<Vec<Target>> {
    let mut found: BTreeMap<i64, Target> = BTreeMap::new();
    for reading in tests.iter().flat_map(|test| &test.readings) {
        let key = (reading.target / SAME).round() as i64;
        let target = found.entry(key).or_insert_with(|| Target {
            at: reading.target,
            ..Target::default()
        });
        let list = if reading.forward {
            &mut target.forward
        } else {
            &mut target.backward
        };
        list.push(reading.actual - reading.target);
    }
    if found.len() >= 3 {
        return Ok(found.into_values().collect());
    }
    let problem = Problem::new(
        format!("holds {} targets; a quadratic needs three", found.len()),
        "measure at more targets along the axis",
    );
    Err(match tests.first() {
        Some(test) => problem.in_text(&test.path),
        None => problem,
    })
}

/// The pitch that the files agree on, m.
///
/// # Errors
/// They state different ones.
pub fn one_pitch(tests: &[ScrewTest]) -> Outcome<Option<f64>> {
    let stated: Vec<(&ScrewTest, f64)> = tests
        .iter()
        .filter_map(|t| Some((t, t.facts.pitch?)))
        .collect();
    let Some((_, first)) = stated.first() else {
        return Ok(None);
    };
    match stated.iter().find(|(_, pitch)| pitch != first) {
        None => Ok(Some(*first)),
        Some((other, pitch)) => Err(Problem::new(
            format!(
                "states a pitch of {} mm, the first file {} mm",
                in_mm(*pitch),
                in_mm(*first)
            ),
            "give the files of one screw together, or correct `pitch_mm`",
        )
        .in_text(&other.path)
        .in_column("pitch_mm")),
    }
}

/// Metres as millimetres, without what the conversion leaves in the last bits: to 1e-9 mm.
pub fn in_mm(metres: f64) -> f64 {
    (metres * 1e12).round() / 1e9
}
