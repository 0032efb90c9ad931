//! The aspects of a column: its level, its pattern, its change. What a law misses of one cause is of that cause's own
//! aspect: no error of a resonance is a constant, and none of a cutting edge comes and goes from turn to turn.

use crate::ground::stats::rms;

/// Rows in groups, coarse first, each group within one of the coarser ones: the first aspect of a column is what its means over
/// the first groups are, the next what those over the second ones add, and the last what is left of it. No grouping:
/// everything is one aspect.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Aspects {
    /// The group of every row, for every grouping.
    pub groups: Vec<Vec<usize>>,
}

impl Aspects {
    /// Rms of a column (an entry per row) in every aspect.
    pub fn sizes(&self, column: &[f64]) -> Vec<f64> {
        let rows = column.len().max(1) as f64;
        let mut before = 0.0;
        let mut squares: Vec<f64> = Vec::new();
        let means = self.groups.iter().map(|of| square_of_means(of, column));
        for square in means.chain([rows * rms(column).powi(2)]) {
            squares.push((square - before).max(0.0));
            before = square;
        }
        squares.iter().map(|s| (s / rows).sqrt()).collect()
    }
}

/// Squares of the means over groups, each for all rows of its group.
fn square_of_means(of: &[usize], column: &[f64]) -> f64 {
    let mut sums = vec![(0.0, 0.0); of.iter().max().map_or(0, |g| g + 1)];
    for (group, value) in of.iter().zip(column) {
        sums[*group].0 += value;
        sums[*group].1 += 1.0;
    }
    let own = sums.iter().filter(|s| s.1 > 0.0);
    own.map(|(sum, count)| sum * sum / count).sum()
}

/// Size of another part as far as its error can be of the aspects of which the own one is; sizes: rms in every aspect. What is
/// wrong of a level may be so over the turn as well; a wave has no level, and neither is a change.
pub(super) fn alike(own: &[f64], other: &[f64]) -> f64 {
    let last = other.len().saturating_sub(1);
    let square = |x: &f64| x * x;
    let seen = |aspect: usize| match aspect == last {
        true => square(&other[aspect]),
        false => other[..=aspect].iter().map(square).sum(),
    };
    let all: f64 = own.iter().map(square).sum();
    let each = own.iter().enumerate().map(|(a, own)| square(own) * seen(a));
    (each.sum::<f64>() / all.max(f64::MIN_POSITIVE)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{Aspects, alike};

    #[test]
    fn a_constant_a_pattern_and_a_change_are_aspects_of_their_own() {
        let aspects = Aspects {
            groups: vec![vec![0; 8], vec![0, 1, 0, 1, 0, 1, 0, 1]],
        };
        let whole = [9.0, 5.0, 9.0, 5.0, 5.0, 1.0, 5.0, 1.0];
        assert_eq!(aspects.sizes(&whole), [5.0, 2.0, 2.0]);
        assert_eq!(Aspects::default().sizes(&[3.0, -3.0]), [3.0]);
        assert!(Aspects::default().sizes(&[]).iter().all(|s| *s == 0.0));
    }

    #[test]
    fn what_a_law_misses_counts_in_the_aspects_that_both_have() {
        assert_eq!(alike(&[3.0, 0.0], &[0.0, 50.0]), 0.0);
        assert_eq!(alike(&[0.0, 3.0], &[7.0, 50.0]), 50.0);
        let mixed = alike(&[3.0, 4.0], &[10.0, 50.0]);
        assert!((mixed - (0.36_f64 * 100.0 + 0.64 * 2500.0).sqrt()).abs() < 1e-12);
        assert_eq!(alike(&[0.0, 3.0, 0.0], &[40.0, 30.0, 9.0]), 50.0);
        assert_eq!(alike(&[3.0], &[8.0]), 8.0);
    }
}
