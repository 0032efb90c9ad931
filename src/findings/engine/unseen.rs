//! What a cause gains on rows that were not fitted, everything that is uncertain free to take its place: whether it is needed.

use super::bank::{Bank, Fit};
use super::nuisances::allowed;
use super::statement::Statement;
use crate::findings::gain::Gain;
use crate::ground::products::{gram, tr_mul};
use crate::ground::stats::{Z95, mean, t95};
use crate::inference::gaussian::{Size, limited};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// The gain of every member of a set: on the first split that plainly shows it, coarse before fine; where none does, on the first that
/// shows it, else that of the coarsest. Whole cycles held out show little of a delay beside a drift that nobody can continue into them.
/// What happens once, in as many readings as it has amounts, shows in no other reading: its gain is that on the readings themselves, each
/// amount paid for. `plainly`: percent (`Design`).
pub fn gains(statement: &Statement, bank: &Bank, fit: &Fit, plainly: f64) -> Vec<Gain> {
    let design = Design::of(statement, bank, fit, plainly);
    let mut splits = Vec::new();
    let each = fit.members.iter().enumerate();
    each.map(|(at, member)| design.decided(bank, (at, *member), &mut splits).0)
        .collect()
}

/// Whether a member acts on no more rows than it has amounts.
fn happens_once(bank: &Bank, member: usize) -> bool {
    let columns = &bank.member(member).columns;
    let acts = |row: &usize| columns.iter().any(|c| c[*row] != 0.0);
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows).filter(acts).take(columns.len() + 1).count() <= columns.len()
}

/// Rows in noise deviations, how stiffly every amount is held by its prior, and how far it may go: what is
/// merely uncertain must not take over what a cause explains.
pub(super) struct Design<'a> {
    pub statement: &'a Statement,
    /// Nuisances, then the columns of every member.
    pub matrix: DMatrix<f64>,
    pub y: DVector<f64>,
    precision: Vec<f64>,
    most: Vec<f64>,
    /// Columns of every member.
    pub own: Vec<Range<usize>>,
    /// Gain from which a split plainly shows a cause, percent: what a companion must gain (`Judgement::companion_gain`).
    plainly: f64,
}

/// One way to hold out rows.
pub(super) struct Split<'a> {
    pub folds: Vec<Fold>,
    pub of: &'a [usize],
    /// Errors with all members.
    errors: Vec<f64>,
}

/// Rows that are held out together, with the products of all others.
pub(super) struct Fold {
    pub rows: Vec<usize>,
    pub own: DMatrix<f64>,
    pub held: DVector<f64>,
    pub gram: DMatrix<f64>,
    pub right: DVector<f64>,
}

impl<'a> Design<'a> {
    pub fn of(statement: &'a Statement, bank: &Bank, fit: &Fit, plainly: f64) -> Self {
        let spread = statement.noise.spread();
        let white = |c: &[f64], scale: f64| {
            let each = c.iter().zip(spread);
            DVector::from_iterator(c.len(), each.map(|(v, s)| v * scale / s))
        };
        let (mut columns, mut own) = (Vec::new(), Vec::new());
        let (mut precision, mut most) = (Vec::new(), Vec::new());
        let allowed = allowed(&statement.nuisances);
        for nuisance in &statement.nuisances {
            let column = white(&nuisance.column, 1.0);
            let least = 1e-12 * column.norm_squared().max(f64::MIN_POSITIVE);
            precision.push((nuisance.spread * nuisance.spread).recip().max(least));
            columns.push(column);
            most.push(allowed * nuisance.spread);
        }
        for (at, member) in fit.members.iter().enumerate() {
            let (first, scale) = (columns.len(), bank.entries[*member].scale);
            let size = match bank.member(*member).size {
                Size::Given(size) => size,
                Size::Free | Size::Drawn => fit.posterior.sizes[at],
            };
            let member = &bank.member(*member).columns;
            columns.extend(member.iter().map(|c| white(c, scale)));
            precision.extend(member.iter().map(|_| (size * size).recip()));
            most.extend(member.iter().map(|_| f64::INFINITY));
            own.push(first..columns.len());
        }
        Self {
            matrix: match columns.is_empty() {
                true => DMatrix::zeros(spread.len(), 0),
                false => DMatrix::from_columns(&columns),
            },
            y: white(&statement.reading, 1.0),
            statement,
            precision,
            most,
            own,
            plainly,
        }
    }

    /// The gain of a member beside the others, and the split that shows it; none: the readings themselves do.
    pub fn decided(
        &self,
        bank: &Bank,
        (at, member): (usize, usize),
        splits: &mut Vec<Split<'a>>,
    ) -> (Gain, Option<usize>) {
        let all: Vec<usize> = (0..self.matrix.ncols()).collect();
        let others = self.others(at);
        if happens_once(bank, member) {
            let found = self.once(&others, &all);
            if found.is_real() {
                return (found, None);
            }
        }
        let mut first: Option<(Gain, Option<usize>)> = None;
        for (i, of) in self.statement.splits.iter().enumerate() {
            if splits.len() == i {
                splits.push(self.split(of, &all));
            }
            let split = &splits[i];
            let found = compare(
                &self.held_out(&split.folds, &others),
                &split.errors,
                split.of,
            );
            if found.is_real() && found.reduction_percent >= self.plainly {
                return (found, Some(i));
            }
            let shown_before = first.as_ref().is_some_and(|(gain, _)| gain.is_real());
            if first.is_none() || found.is_real() && !shown_before {
                first = Some((found, Some(i)));
            }
        }
        first.unwrap_or((Gain::of(1.0, 1.0, f64::INFINITY), None))
    }

    /// All columns but those of a member.
    pub fn others(&self, at: usize) -> Vec<usize> {
        let is_other = |c: &usize| !self.own[at].contains(c);
        (0..self.matrix.ncols()).filter(is_other).collect()
    }

    /// What some columns gain on the readings themselves. The squares that k amounts explain, λ variances of the noise,
    /// scatter by √(2k + 4λ) of these (noncentral χ²), and what is left, of n free rows, by √(2n).
    fn once(&self, before: &[usize], after: &[usize]) -> Gain {
        let free = (self.y.len() as f64 - after.len() as f64).max(1.0);
        let [b, a] = [before, after].map(|columns| self.paid(columns));
        let left = (a / b.max(f64::MIN_POSITIVE)).powi(2).min(1.0);
        let amounts = after.len() as f64 - before.len() as f64;
        let explained = (2.0 * amounts * left * left + 4.0 * free * left * (1.0 - left)).sqrt();
        let noise = (1.0 - left) * (2.0 * free).sqrt();
        Gain::of(b, a, explained.hypot(noise) / (2.0 * free))
    }

    fn split(&self, of: &'a [usize], all: &[usize]) -> Split<'a> {
        let folds = self.folds(of, &self.y);
        Split {
            errors: self.held_out(&folds, all),
            folds,
            of,
        }
    }

    /// Folds of readings in noise deviations.
    pub fn folds(&self, of: &[usize], y: &DVector<f64>) -> Vec<Fold> {
        let (whole, pull) = (gram(&self.matrix), self.matrix.tr_mul(y));
        let count = of.iter().copied().max().map_or(0, |f| f + 1);
        let fold = |fold: usize| {
            let rows: Vec<usize> = (0..of.len()).filter(|i| of[*i] == fold).collect();
            let (own, held) = (self.matrix.select_rows(&rows), y.select_rows(&rows));
            Fold {
                gram: &whole - gram(&own),
                right: &pull - own.tr_mul(&held),
                rows,
                own,
                held,
            }
        };
        (0..count).map(fold).collect()
    }

    /// Amounts of some columns by products.
    pub fn amounts(
        &self,
        gram: &DMatrix<f64>,
        right: &DVector<f64>,
        columns: &[usize],
    ) -> DVector<f64> {
        let mut own = gram.select_rows(columns).select_columns(columns);
        for (i, c) in columns.iter().enumerate() {
            own[(i, i)] += self.precision[*c];
        }
        let most: Vec<f64> = columns.iter().map(|c| self.most[*c]).collect();
        let solved = limited(&own, &right.select_rows(columns), &most);
        let mut all = DVector::zeros(self.matrix.ncols());
        let each = columns.iter().zip(solved.iter());
        each.for_each(|(c, x)| all[*c] = *x);
        all
    }

    /// Root mean square of what a fit of some columns leaves, in the unit of the readings, over the rows that
    /// its amounts leave free.
    fn paid(&self, columns: &[usize]) -> f64 {
        let right = tr_mul(&self.matrix, &self.y).column(0).into_owned();
        let left = &self.y - &self.matrix * self.amounts(&gram(&self.matrix), &right, columns);
        let weights = self.statement.noise.weights();
        let each = left.iter().zip(&weights);
        let squares: f64 = each.map(|(l, w)| (l * w).powi(2)).sum();
        let free = self.y.len() as f64 - columns.len() as f64;
        (squares / free.max(1.0)).sqrt()
    }

    /// Error of every row in the unit of the readings, each fold predicted from the others by some columns.
    fn held_out(&self, folds: &[Fold], columns: &[usize]) -> Vec<f64> {
        self.predicted(folds, |fold| self.amounts(&fold.gram, &fold.right, columns))
    }

    /// The same by amounts for every fold.
    pub fn predicted(&self, folds: &[Fold], amounts: impl Fn(&Fold) -> DVector<f64>) -> Vec<f64> {
        let weights = self.statement.noise.weights();
        let mut error = vec![0.0; weights.len()];
        for fold in folds {
            let left = &fold.held - &fold.own * amounts(fold);
            let each = fold.rows.iter().zip(left.iter());
            each.for_each(|(i, l)| error[*i] = l * weights[*i]);
        }
        error
    }
}

/// From errors before and after; the interval by leaving out each fold in turn (jackknife).
pub fn compare(before: &[f64], after: &[f64], split: &[usize]) -> Gain {
    let folds = split.iter().copied().max().map_or(0, |f| f + 1);
    let sums = |errors: &[f64]| {
        let mut sums = vec![0.0; folds];
        errors
            .iter()
            .zip(split)
            .for_each(|(e, f)| sums[*f] += e * e);
        sums
    };
    let (b, a) = (sums(before), sums(after));
    let total = |s: &[f64]| s.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let log = |skip: usize| {
        let less = |s: &[f64]| (total(s) - s[skip]).max(1e-12 * total(s));
        0.5 * (less(&b) / less(&a)).ln()
    };
    let parts: Vec<f64> = (0..folds).map(log).collect();
    let middle = mean(&parts);
    let squares: f64 = parts.iter().map(|g| (g - middle) * (g - middle)).sum();
    let freedom = folds.saturating_sub(1) as f64;
    let deviation = (squares * freedom / folds.max(1) as f64).sqrt();
    let root = |s: &[f64]| (total(s) / before.len().max(1) as f64).sqrt();
    Gain::of(root(&b), root(&a), t95(freedom) / Z95 * deviation)
}
