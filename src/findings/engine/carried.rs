//! What the present simulation gains where a cause is put into it: all that is merely uncertain stays as it is stated.
//!
//! Whether a cause is needed at all is another question, asked with everything that is uncertain free to take its place
//! ([`gains`](super::unseen::gains)). Told is the error of the simulation as it is used, without and with the cause, on rows
//! from which its amount was not fitted. Two things make the interval: other rows would have gained otherwise (the folds, left
//! out in turn), and the cause is as large as its amounts only within their doubt, which holds what the uncertain numbers
//! may have lent it. The second is no small change of a logarithm: amounts are drawn.

use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use super::materiality::raw_parts;
use super::statement::Statement;
use super::unseen::{Design, Fold, Split, compare};
use crate::findings::gain::Gain;
use crate::ground::products::{gram, tr_mul};
use crate::ground::random::Random;
use crate::ground::stats::rms;
use nalgebra::{DMatrix, DVector};

/// Draws of the amounts: either end of an interval stands on fifty of them.
const DRAWS: usize = 2000;

/// The gains of a set as they are told; `present`: measured less simulated as the simulation is, where the statement is about
/// something else.
pub(super) fn told(
    statement: &Statement,
    present: &[f64],
    (bank, fit): (&Bank, &Fit),
    judgement: &Judgement,
) -> Vec<Gain> {
    let design = Design::of(statement, bank, fit, judgement.companion_gain);
    let more = beyond(statement, present, bank, fit);
    let mut splits = Vec::new();
    let each = fit.members.iter().enumerate();
    each.map(|(at, member)| {
        let (decided, split) = design.decided(bank, (at, *member), &mut splits);
        split.map_or(decided, |split| {
            carried(&design, (at, &more[at]), &splits[split], fit)
        })
    })
    .collect()
}

/// What each cause adds beyond its columns, in noise deviations: the statement is about what was found, and what that changes
/// beyond first order is shared by size.
fn beyond(statement: &Statement, present: &[f64], bank: &Bank, fit: &Fit) -> Vec<DVector<f64>> {
    let parts = raw_parts(bank, fit);
    let squares: Vec<f64> = parts.iter().map(|part| rms(part).powi(2)).collect();
    let total = squares.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let more = present.iter().zip(&statement.reading);
    let more = more.zip(statement.noise.spread());
    let more = DVector::from_iterator(present.len(), more.map(|((p, r), s)| (p - r) / s));
    squares.iter().map(|s| &more * (s / total)).collect()
}

/// Without one cause, and with it.
fn carried(design: &Design, (at, more): (usize, &DVector<f64>), split: &Split, fit: &Fit) -> Gain {
    let all: Vec<usize> = (0..design.matrix.ncols()).collect();
    let others = design.others(at);
    let without = design.folds(split.of, &(&design.y + more));
    let before = design.predicted(&without, |fold| as_stated(design, fold, &others));
    let after = design.predicted(&split.folds, |fold| as_stated(design, fold, &all));
    let told = compare(&before, &after, split.of);
    let doubt = Doubt::of(design, fit);
    let kept = |c: usize| {
        if design.own[at].contains(&c) {
            0.0
        } else {
            1.0
        }
    };
    let kept: Vec<f64> = (doubt.first..design.matrix.ncols()).map(kept).collect();
    told.drawn(doubt.gains([&before, &after], &kept, told.ln_std()))
}

/// Amounts of some columns from all rows but a fold's, with what is uncertain as it is stated. What nobody states is fitted
/// to what that leaves.
fn as_stated(design: &Design, fold: &Fold, columns: &[usize]) -> DVector<f64> {
    let nuisances = &design.statement.nuisances;
    let mut amounts = design.amounts(&fold.gram, &fold.right, columns);
    amounts.rows_mut(0, nuisances.len()).fill(0.0);
    let is_open = |c: &usize| nuisances[*c].spread.is_infinite();
    let open: Vec<usize> = (0..nuisances.len()).filter(is_open).collect();
    if open.is_empty() {
        return amounts;
    }
    let right = &fold.right - &fold.gram * &amounts;
    amounts + design.amounts(&fold.gram, &right, &open)
}

/// How well the amounts of a set are known.
struct Doubt {
    /// The first column that is a cause's.
    first: usize,
    /// Columns of all causes in the unit of the errors.
    columns: DMatrix<f64>,
    /// Square root of the covariance of their amounts.
    root: DMatrix<f64>,
}

impl Doubt {
    fn of(design: &Design, fit: &Fit) -> Self {
        let first = design.statement.nuisances.len();
        let count = design.matrix.ncols() - first;
        let mut columns = design.matrix.columns(first, count).into_owned();
        let weights = design.statement.noise.weights();
        for (mut row, weight) in columns.row_iter_mut().zip(weights) {
            row *= weight;
        }
        let covariance = &fit.posterior.covariance * fit.posterior.noise_variance;
        Self {
            first,
            columns,
            root: covariance
                .cholesky()
                .map_or_else(|| DMatrix::zeros(count, count), |r| r.l()),
        }
    }

    /// ln(before/after) for amounts that are drawn, and other rows that might have been read (`ln_std`); `kept`: 1 for the
    /// columns that are there before as well.
    fn gains(&self, [before, after]: [&[f64]; 2], kept: &[f64], ln_std: f64) -> Vec<f64> {
        let mut random = Random::new(1);
        let inner = gram(&self.columns);
        let squares = [before, after].map(|errors| {
            let rows = DMatrix::from_column_slice(errors.len(), 1, errors);
            let pull = tr_mul(&self.columns, &rows).column(0).into_owned();
            (errors.iter().map(|e| e * e).sum::<f64>(), pull)
        });
        let mut one = || {
            let z = DVector::from_fn(kept.len(), |_, _| random.normal());
            let moved = &self.root * z;
            let others = DVector::from_fn(kept.len(), |k, _| kept[k] * moved[k]);
            let [before, after] = [(0, others), (1, moved)].map(|(k, moved)| {
                let (square, pull) = &squares[k];
                let changed = square - 2.0 * pull.dot(&moved) + moved.dot(&(&inner * &moved));
                changed.max(1e-12 * square).max(f64::MIN_POSITIVE)
            });
            0.5 * (before / after).ln() + ln_std * random.normal()
        };
        (0..DRAWS).map(|_| one()).collect()
    }
}
