//! What may be wrong with one channel, whatever was measured: it is dead, clipped, wild, or follows
//! nothing.

use super::{Rule, Said, Weight, extent, range, said_if};
use crate::ground::stats::largest;
use nalgebra::{DMatrix, DVector};

/// A channel beside what drives it, reading by reading.
pub struct Channel {
    /// Its name, as in the header.
    pub name: String,
    /// Its readings; NaN where there is none.
    pub values: Vec<f64>,
    /// What makes readings differ.
    pub drive: Vec<f64>,
}

impl Channel {
    /// Readings with their drive.
    pub fn new(name: impl Into<String>, values: Vec<f64>, drive: Vec<f64>) -> Self {
        let name = name.into();
        Self {
            name,
            values,
            drive,
        }
    }
}

/// Fewer readings than this tell nothing of a channel.
const FEW: usize = 4;
/// Change of a channel below which it is none, as a share of its size.
const STILL: f64 = 1e-12;
/// Equal readings at an extreme that are no coincidence.
const PLATEAU: usize = 4;
/// So many times as many stand there as on the levels beside it.
const STANDS: usize = 5;
/// Levels beside the extreme that are looked at.
const BESIDE: usize = 3;
/// Share of its range by which the drive differs over the plateau.
const DRIVEN: f64 = 0.1;
/// Times the usual size of a channel that no reading has.
const WILD: f64 = 100.0;
/// Share of the readings whose size is usual.
const USUAL: f64 = 0.9;

/// Whether values never change.
pub fn is_dead(values: &[f64]) -> bool {
    let size = largest(values);
    values.iter().filter(|v| v.is_finite()).count() >= FEW && extent(values) <= STILL * size
}

/// A channel that never changes passes for a load that is not there.
pub const fn dead_rule<L>(look: L) -> Rule<L> {
    Rule {
        name: "dead",
        remedy: "check the cable of that channel, and measure again",
        look,
    }
}

/// Channels that never change.
pub fn dead(channels: &[Channel]) -> Said {
    let dead = channels.iter().filter(|c| is_dead(&c.values));
    dead.map(|c| {
        let what = format!("{} never changes: a dead channel", c.name);
        (Weight::Fatal, what)
    })
    .collect()
}

/// A channel at the end of its range repeats one number while the test goes on.
pub const fn clipped_rule<L>(look: L) -> Rule<L> {
    Rule {
        name: "clipped",
        remedy: "measure again with a wider range of that channel",
        look,
    }
}

/// Channels that stand at an extreme while the drive goes on.
pub fn clipped(channels: &[Channel]) -> Said {
    let stands = |c: &Channel| {
        let rows = standing(&c.values, &c.drive)?;
        let what = format!(
            "{} stands at its extreme in {rows} readings while the test goes on: it is clipped",
            c.name
        );
        Some((Weight::Fatal, what))
    };
    channels.iter().filter_map(stands).collect()
}

/// Readings that stand at an extreme, beyond coincidence.
pub fn standing(values: &[f64], drive: &[f64]) -> Option<usize> {
    let (low, high) = range(values);
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let levels: Vec<usize> = sorted.chunk_by(|a, b| a == b).map(<[f64]>::len).collect();
    if high <= low || levels.len() < 2 * BESIDE {
        return None;
    }
    let beside = |counts: Vec<usize>| (counts[0], counts[1..=BESIDE].iter().copied().max());
    let up = levels.iter().rev().take(BESIDE + 1).copied().collect();
    let down = levels.iter().take(BESIDE + 1).copied().collect();
    let ends = [(high, beside(up)), (low, beside(down))];
    let driven = |end: f64| {
        let here = values.iter().zip(drive).filter(|(v, _)| **v == end);
        let here: Vec<f64> = here.map(|(_, d)| *d).collect();
        extent(&here) > DRIVEN * extent(drive)
    };
    let found = ends.into_iter().filter(|(end, (rows, next))| {
        *rows >= PLATEAU && *rows >= STANDS * next.unwrap_or(1) && driven(*end)
    });
    found.map(|(_, (rows, _))| rows).max()
}

/// Share of copied readings that is no coincidence.
const MANY: f64 = 0.1;

/// Readings that stand in the file twice, by what makes each its own.
pub fn copied<T: Ord>(readings: impl Iterator<Item = T>) -> Said {
    let mut all: Vec<T> = readings.collect();
    let rows = all.len();
    all.sort_unstable();
    all.dedup();
    let copies = rows - all.len();
    said_if(
        copies as f64 > MANY * rows as f64,
        Weight::Odd,
        format!("{copies} of {rows} readings are exact copies of others"),
    )
}

/// One absurd reading turns every mean and every fit.
pub const fn wild_rule<L>(look: L) -> Rule<L> {
    Rule {
        name: "wild",
        remedy: "empty that cell, or correct it",
        look,
    }
}

/// Readings beyond anything that the channel shows elsewhere.
pub fn wild(channels: &[Channel]) -> Said {
    let far = |c: &Channel| {
        let mut sizes: Vec<f64> = c.values.iter().map(|v| v.abs()).collect();
        sizes.retain(|v| v.is_finite());
        sizes.sort_by(f64::total_cmp);
        let usual = *sizes.get((USUAL * sizes.len() as f64) as usize)?;
        let count = sizes.iter().filter(|v| **v > WILD * usual).count();
        (usual > 0.0 && count > 0).then(|| {
            let what = format!(
                "{count} of {} readings of {} are more than {WILD} times the usual one",
                sizes.len(),
                c.name
            );
            (Weight::Fatal, what)
        })
    };
    channels.iter().filter_map(far).collect()
}

/// A channel as a sum of columns.
pub struct Sum {
    /// Coefficients.
    pub of: Vec<f64>,
    /// Share of the squares about the mean that the columns describe, less what chance would.
    pub share: f64,
}

/// Least squares of `values` over columns and a constant; none where rows are too few to tell.
pub fn sum(values: &[f64], columns: &[Vec<f64>]) -> Option<Sum> {
    let whole = |i: &usize| values[*i].is_finite() && columns.iter().all(|c| c[*i].is_finite());
    let rows: Vec<usize> = (0..values.len()).filter(whole).collect();
    let (n, k) = (rows.len(), columns.len());
    if n < k + 3 {
        return None;
    }
    let mean = |v: &[f64]| rows.iter().map(|i| v[*i]).sum::<f64>() / n as f64;
    let centred = |v: &[f64]| -> Vec<f64> {
        let middle = mean(v);
        rows.iter().map(|i| v[*i] - middle).collect()
    };
    let y = centred(values);
    let own: Vec<Vec<f64>> = columns.iter().map(|c| centred(c)).collect();
    let sizes: Vec<f64> = own
        .iter()
        .map(|c| largest(c).max(f64::MIN_POSITIVE))
        .collect();
    let scale = largest(&y);
    if !(scale.is_finite() && scale > 0.0) {
        return None;
    }
    let matrix = DMatrix::from_fn(n, k, |i, j| own[j][i] / sizes[j]);
    let right = DVector::from_iterator(n, y.iter().map(|v| v / scale));
    let found = matrix.clone().svd(true, true).solve(&right, 1e-9).ok()?;
    let left = (&right - &matrix * &found).norm_squared() / (n - k - 1) as f64;
    let all = right.norm_squared() / (n - 1) as f64;
    Some(Sum {
        of: (0..k).map(|j| found[j] * scale / sizes[j]).collect(),
        share: 1.0 - left / all,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plateau_is_told_from_a_turning_point_and_from_rounding() {
        let drive: Vec<f64> = (0..400).map(|i| f64::from(i) * 0.05).collect();
        let sine: Vec<f64> = drive.iter().map(|t| t.sin()).collect();
        let round =
            |step: f64| -> Vec<f64> { sine.iter().map(|s| (s / step).round() * step).collect() };
        let cut = |at: f64| -> Vec<f64> { sine.iter().map(|s| s.min(at)).collect() };
        assert_eq!(standing(&sine, &drive), None);
        assert_eq!(standing(&round(0.01), &drive), None);
        assert_eq!(standing(&round(0.1), &drive), None);
        assert!(standing(&cut(0.8), &drive).is_some_and(|rows| rows > 40));
    }

    #[test]
    fn a_sum_knows_its_columns_and_noise_has_none() {
        let x: Vec<f64> = (0..50).map(|i| f64::from(i % 7)).collect();
        let z: Vec<f64> = (0..50).map(|i| f64::from(i * i % 11)).collect();
        let y: Vec<f64> = x
            .iter()
            .zip(&z)
            .map(|(x, z)| 3.0 * x - 2e-3 * z + 5.0)
            .collect();
        let found = sum(&y, &[x.clone(), z]).unwrap();
        assert!((found.of[0] - 3.0).abs() < 1e-9 && (found.of[1] + 2e-3).abs() < 1e-9);
        assert!(found.share > 0.999_999);
        let mut random = crate::ground::random::Random::new(3);
        let noise: Vec<f64> = (0..50).map(|_| random.normal()).collect();
        assert!(sum(&noise, &[x]).unwrap().share < 0.3);
    }
}
