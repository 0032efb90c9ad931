//! From compliances along the axes of a frame to those about any axis.

use crate::causes::turns::{LOWER, SIX};

/// Root of a compliance that nothing speaks for yet.
const FAINT: f64 = 0.2;
/// The ways in which an axis may lean, its first component being positive: signs of the second and of the third.
const LEANS: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

/// Lower roots of symmetric matrices, `count` numbers in all, that start from the amounts `own` along the axes of the frame: with these for
/// axes, and with one soft axis that leans any way.
pub(super) fn roots(count: usize, own: &[f64]) -> Vec<Vec<f64>> {
    let along = |k: usize| if k % SIX < 3 { FAINT } else { 0.0 };
    let mut straight: Vec<f64> = (0..count).map(along).collect();
    let known = straight.iter_mut().zip(own);
    known.for_each(|(root, amount)| *root = amount.sqrt().max(FAINT));
    let leaning = LEANS.map(|leans| {
        let mut leaning = straight.clone();
        leaning[1..3].fill(FAINT);
        let shared = LOWER.into_iter().enumerate().skip(3);
        for (k, (row, _)) in shared.filter(|(_, (_, column))| *column == 0) {
            leaning[k] = leans[row - 1] * straight[row];
        }
        leaning
    });
    std::iter::once(straight).chain(leaning).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::turns::squared;

    #[test]
    fn a_soft_axis_leans_any_way_and_is_as_soft_along_each() {
        let own = [0.5, 1.0, 0.25];
        for (k, roots) in roots(2 * SIX, &own).into_iter().enumerate() {
            let all = squared(&roots[..SIX]);
            let near = all[..3].iter().zip(own).all(|(a, b)| (a - b).abs() < 0.05);
            assert!(near, "{all:?}");
            let leans = all[3..].iter().filter(|shared| shared.abs() > 0.3).count();
            assert_eq!(leans, if k == 0 { 0 } else { 3 }, "{all:?}");
        }
    }
}
