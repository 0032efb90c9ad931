//! Members of a family under construction.

use super::view::View;
use crate::findings::engine::Member;
use crate::ground::stats::rms;

/// The shapes of one cause under one load.
pub struct Shapes {
    /// As the engine takes them.
    pub members: Vec<Member>,
}

/// The sign that a density has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sign {
    /// None.
    Any,
    /// The sum of its amounts is positive.
    Positive,
    /// What it moves takes work from the load, as all that creeps or rubs does: its loops do not go the wrong way round. Its sum is positive where
    /// the load does not come back, whose work is not all lost.
    Loses,
}

impl Shapes {
    /// None yet.
    pub fn none() -> Self {
        Self {
            members: Vec::new(),
        }
    }

    /// One shape of either sign.
    pub fn one(&mut self, view: &View, column: &[f64]) {
        if let Some(column) = view.beyond_spring(column) {
            self.members.push(Member::free(column));
        }
    }

    /// One shape that can only add.
    pub fn positive(&mut self, view: &View, column: &[f64]) {
        if let Some(column) = view.beyond_spring(column) {
            self.members.push(Member::free(column).positive());
        }
    }

    /// Independent columns: a smooth curve of any form, each column of the size at which it is given.
    pub fn free(&mut self, view: &View, columns: &[Vec<f64>]) {
        let columns: Vec<Vec<f64>> = columns
            .iter()
            .filter_map(|c| view.beyond_spring(c))
            .collect();
        if !columns.is_empty() {
            let member = Member::free(Vec::new());
            self.members.push(Member { columns, ..member });
        }
    }

    /// A density over columns: amounts about the means `mean` with a relative spread `freedom` each, all
    /// of one unknown size. With z₀ for the size and zᵢ for the freedoms the prior of the amounts is
    /// μμᵀ + κ² diag(μ²); a fit of the wrong sign is refused.
    pub fn density(
        &mut self,
        view: &View,
        columns: &[Vec<f64>],
        mean: &[f64],
        (freedom, sign): (f64, Sign),
    ) {
        let each = columns.iter().zip(mean);
        let kept: Vec<(Vec<f64>, f64)> = each
            .filter(|(_, m)| **m > 0.0)
            .filter_map(|(c, m)| Some((view.beyond_spring(c)?, *m)))
            .collect();
        if kept.is_empty() {
            return;
        }
        let at = |i: usize| kept.iter().map(|(c, m)| m * c[i]).sum::<f64>();
        let middle: Vec<f64> = (0..view.rows()).map(at).collect();
        let size = rms(&middle).max(f64::MIN_POSITIVE);
        let total: f64 = kept.iter().map(|k| k.1).sum();
        let mut all = vec![middle.iter().map(|v| v / size).collect::<Vec<f64>>()];
        let mut weights = vec![1.0];
        for (column, m) in &kept {
            all.push(column.iter().map(|v| v * freedom * m / size).collect());
            weights.push(freedom * m / total);
        }
        let positive = match sign {
            Sign::Any => None,
            Sign::Loses if view.comes_back() => {
                Some(all.iter().map(|column| view.work(column)).collect())
            }
            Sign::Positive | Sign::Loses => Some(weights),
        };
        let member = Member::free(Vec::new());
        self.members.push(Member {
            columns: all,
            positive,
            ..member
        });
    }
}

/// `count` values from `low` to `high`, each a like multiple of the one before.
pub fn geometric(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = (high / low).ln() / (count.max(2) - 1) as f64;
    (0..count).map(|k| low * (step * k as f64).exp()).collect()
}

/// `count` values from `low` to `high`, equally far apart.
pub fn even(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = (high - low) / (count.max(2) - 1) as f64;
    (0..count).map(|k| low + step * k as f64).collect()
}
