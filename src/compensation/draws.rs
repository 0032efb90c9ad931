//! How large the largest of many deviations may be, the uncertain numbers being drawn.

use crate::ground::random::Random;
use crate::ground::spatial::{V3, norm};
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

    /// 95 % interval of the largest deviation, m: `changes` holds, per uncertain number, what one standard
    /// deviation of it changes at each station; those that are not `kept` are known exactly. The largest of many
    /// stations is no linear function of them: it is drawn.
    pub fn interval(
        &self,
        left: &[V3],
        changes: &[Vec<V3>],
        kept: impl Fn(usize) -> bool,
    ) -> Option<Likely> {
        let kept: Vec<usize> = (0..changes.len()).filter(|k| kept(*k)).collect();
        if kept.is_empty() || left.is_empty() {
            return None;
        }
        let of_block = |block: &Vec<f64>| largest(block, left, changes, &kept);
        let mut all: Vec<f64> = self.blocks.par_iter().flat_map_iter(of_block).collect();
        all.sort_by(f64::total_cmp);
        let at = |share: f64| all[((DRAWS - 1) as f64 * share).round() as usize];
        // the largest of many places that are uncertain is rarely as small as where nothing is off
        let as_told = left.iter().map(|l| norm(*l)).fold(0.0, f64::max);
        Some(Likely {
            ci95: [at(0.025).min(as_told), at(0.975)],
            at_most: at(0.999),
        })
    }
}

/// The largest deviation of each draw of a block, m.
fn largest(block: &[f64], left: &[V3], changes: &[Vec<V3>], kept: &[usize]) -> [f64; TOGETHER] {
    let mut largest = [0.0_f64; TOGETHER];
    for (i, left) in left.iter().enumerate() {
        let mut at = left.map(|x| [x; TOGETHER]);
        for k in kept {
            let draws = &block[k * TOGETHER..][..TOGETHER];
            for (at, change) in at.iter_mut().zip(changes[*k][i]) {
                let each = at.iter_mut().zip(draws);
                each.for_each(|(at, draw)| *at += change * draw);
            }
        }
        for (draw, largest) in largest.iter_mut().enumerate() {
            *largest = largest.max(at.iter().map(|x| x[draw] * x[draw]).sum());
        }
    }
    largest.map(f64::sqrt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_station_and_one_number_are_a_normal_distribution() {
        let (left, changes) = ([[1.0, 0.0, 0.0]], [vec![[0.1, 0.0, 0.0]]]);
        let likely = Draws::of(1).interval(&left, &changes, |_| true).unwrap();
        assert!((likely.ci95[0] - 0.804).abs() < 0.01, "{likely:?}");
        assert!((likely.ci95[1] - 1.196).abs() < 0.01, "{likely:?}");
        assert!((likely.at_most - 1.309).abs() < 0.03, "{likely:?}");
    }

    #[test]
    fn what_is_known_widens_nothing() {
        let left = [[1.0, 0.0, 0.0], [0.0, 0.9, 0.0]];
        let changes = [vec![[0.1, 0.0, 0.0]; 2], vec![[0.0, 0.3, 0.0]; 2]];
        let draws = Draws::of(2);
        let high = |kept: &dyn Fn(usize) -> bool| {
            let likely = draws.interval(&left, &changes, kept).unwrap();
            likely.ci95[1]
        };
        assert!(high(&|_| true) > high(&|k| k == 1) && high(&|k| k == 1) > high(&|k| k == 0));
        assert!(draws.interval(&left, &changes, |_| false).is_none());
    }
}
