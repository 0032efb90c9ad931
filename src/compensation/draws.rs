//! How large the largest of many deviations may be, the uncertain numbers being drawn.

use crate::ground::random::Random;
use crate::ground::spatial::{V3, norm};
use crate::ground::stats::quantile;
use rayon::prelude::*;

/// Draws of the uncertain numbers.
const DRAWS: usize = 4000;
/// Draws that are carried along the stations together.
const TOGETHER: usize = 50;

/// How large the largest deviation may be, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Likely {
    /// 95 % interval.
    pub ci95: [f64; 2],
    /// In 999 of 1000 cases at most this: what a promise needs.
    pub at_most: f64,
}

/// Uncertain numbers, drawn in their standard deviations: the same draws whatever is asked about them.
pub struct Draws {
    /// Blocks of [`TOGETHER`] draws, number by number.
    blocks: Vec<Vec<f64>>,
}

impl Draws {
    /// Of so many numbers.
    pub fn of(numbers: usize) -> Self {
        let mut random = Random::new(1);
        let block = |_| {
            let mut block = vec![0.0; numbers * TOGETHER];
            for draw in 0..TOGETHER {
                (0..numbers).for_each(|k| block[k * TOGETHER + draw] = random.normal());
            }
            block
        };
        Self {
            blocks: (0..DRAWS / TOGETHER).map(block).collect(),
        }
    }

    /// 95 % interval of the largest deviation, m, once per set of numbers that are known exactly (none where all are):
    /// `changes` holds, per uncertain number, what one standard deviation of it changes at each station. The
    /// largest of many stations is no linear function of them: it is drawn.
    pub fn intervals(
        &self,
        left: &[V3],
        changes: &[Vec<V3>],
        known: &[Vec<usize>],
    ) -> Vec<Option<Likely>> {
        let of_block = |block: &Vec<f64>| largest(block, left, changes, known);
        let blocks: Vec<Vec<Draw>> = self.blocks.par_iter().map(of_block).collect();
        // the largest of many places that are uncertain is rarely as small as where nothing is off
        let as_told = left.iter().map(|l| norm(*l)).fold(0.0, f64::max);
        let of_set = |(set, known): (usize, &Vec<usize>)| {
            let is_open = known.len() < changes.len() && !left.is_empty();
            let all = || blocks.iter().flat_map(|block| block[set]);
            is_open.then(|| likely(&all().collect::<Vec<f64>>(), as_told))
        };
        known.iter().enumerate().map(of_set).collect()
    }
}

/// One value per draw of a block.
type Draw = [f64; TOGETHER];

fn likely(all: &[f64], as_told: f64) -> Likely {
    Likely {
        ci95: [quantile(all, 0.025).min(as_told), quantile(all, 0.975)],
        at_most: quantile(all, 0.999),
    }
}

/// The largest deviation of each draw of a block, m, once per set of numbers that are known exactly.
fn largest(block: &[f64], left: &[V3], changes: &[Vec<V3>], known: &[Vec<usize>]) -> Vec<Draw> {
    let mut largest = vec![[0.0; TOGETHER]; known.len()];
    let add = |at: &mut [Draw; 3], k: usize, i: usize, sign: f64| {
        let draws = &block[k * TOGETHER..][..TOGETHER];
        for (at, change) in at.iter_mut().zip(changes[k][i]) {
            let each = at.iter_mut().zip(draws);
            each.for_each(|(at, draw)| *at += sign * change * draw);
        }
    };
    for (i, left) in left.iter().enumerate() {
        let mut all = left.map(|x| [x; TOGETHER]);
        (0..changes.len()).for_each(|k| add(&mut all, k, i, 1.0));
        for (largest, known) in largest.iter_mut().zip(known) {
            let mut at = all;
            known.iter().for_each(|k| add(&mut at, *k, i, -1.0));
            for (draw, largest) in largest.iter_mut().enumerate() {
                let square: f64 = at.iter().map(|x| x[draw] * x[draw]).sum();
                *largest = f64::max(*largest, square);
            }
        }
    }
    largest.into_iter().map(|l| l.map(f64::sqrt)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_station_and_one_number_are_a_normal_distribution() {
        let (left, changes) = ([[1.0, 0.0, 0.0]], [vec![[0.1, 0.0, 0.0]]]);
        let likely = Draws::of(1).intervals(&left, &changes, &[vec![]])[0].unwrap();
        assert!((likely.ci95[0] - 0.804).abs() < 0.01, "{likely:?}");
        assert!((likely.ci95[1] - 1.196).abs() < 0.01, "{likely:?}");
        assert!((likely.at_most - 1.309).abs() < 0.03, "{likely:?}");
    }

    #[test]
    fn what_is_known_widens_nothing() {
        let left = [[1.0, 0.0, 0.0], [0.0, 0.9, 0.0]];
        let changes = [vec![[0.1, 0.0, 0.0]; 2], vec![[0.0, 0.3, 0.0]; 2]];
        let draws = Draws::of(2);
        let known = [vec![], vec![0], vec![1], vec![0, 1]];
        let said = draws.intervals(&left, &changes, &known);
        let high = |i: usize| said[i].map(|likely| likely.ci95[1]);
        assert!(high(0) > high(1) && high(1) > high(2));
        assert!(high(3).is_none());
    }
}
