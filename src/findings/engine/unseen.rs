//! What a cause gains on rows that were not fitted.

use super::bank::{Bank, Fit};
use super::nuisances::allowed;
use super::statement::Statement;
use crate::findings::gain::Gain;
use crate::ground::stats::{Z95, mean, t95};
use crate::inference::gaussian::{Size, limited};
use nalgebra::{DMatrix, DVector};

/// The gain of one member of a set: on the first split that shows it, coarse before fine; where none does,
/// that of the coarsest. What happens once, in as many readings as it has amounts, shows in no other reading:
/// its gain is that on the readings themselves, each amount paid for.
pub fn gain(statement: &Statement, bank: &Bank, fit: &Fit, member: usize) -> Gain {
    let rest: Vec<usize> = fit
        .members
        .iter()
        .copied()
        .filter(|m| *m != member)
        .collect();
    let with = Design::of(statement, bank, &fit.members, fit);
    let without = Design::of(statement, bank, &rest, fit);
    if happens_once(bank, member) {
        let n = statement.reading.len() as f64;
        let errors = [&without, &with].map(|d| d.paid(statement));
        let found = Gain::of(errors[0], errors[1], n.max(1.0).sqrt().recip());
        if found.is_real() {
            return found;
        }
    }
    let mut first = None;
    for split in &statement.splits {
        let errors = [&without, &with].map(|d| d.held_out(statement, split));
        let found = compare(&errors[0], &errors[1], split);
        if found.is_real() {
            return found;
        }
        first.get_or_insert(found);
    }
    first.unwrap_or(Gain::of(1.0, 1.0, f64::INFINITY))
}

/// Whether a member acts on no more rows than it has amounts.
fn happens_once(bank: &Bank, member: usize) -> bool {
    let columns = &bank.member(member).columns;
    let acts = |row: &usize| columns.iter().any(|c| c[*row] != 0.0);
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows).filter(acts).count() <= columns.len()
}

/// Rows in noise deviations, how stiffly every amount is held by its prior, and how far it may go: what is
/// merely uncertain must not take over what a cause explains.
struct Design {
    matrix: DMatrix<f64>,
    precision: Vec<f64>,
    most: Vec<f64>,
}

impl Design {
    fn of(statement: &Statement, bank: &Bank, members: &[usize], fit: &Fit) -> Self {
        let spread = statement.noise.spread();
        let white = |c: &[f64], scale: f64| {
            let each = c.iter().zip(spread);
            DVector::from_iterator(c.len(), each.map(|(v, s)| v * scale / s))
        };
        let mut columns = Vec::new();
        let mut precision = Vec::new();
        let mut most = Vec::new();
        let allowed = allowed(&statement.nuisances);
        for nuisance in &statement.nuisances {
            let column = white(&nuisance.column, 1.0);
            let least = 1e-12 * column.norm_squared().max(f64::MIN_POSITIVE);
            precision.push((nuisance.spread * nuisance.spread).recip().max(least));
            columns.push(column);
            most.push(allowed * nuisance.spread);
        }
        for member in members {
            let own = bank.member(*member);
            let scale = bank.entries[*member].scale;
            let size = match own.size {
                Size::Given(size) => size,
                Size::Free | Size::Drawn => fit
                    .members
                    .iter()
                    .position(|m| m == member)
                    .map_or(1.0, |i| fit.posterior.sizes[i]),
            };
            columns.extend(own.columns.iter().map(|c| white(c, scale)));
            precision.extend(own.columns.iter().map(|_| (size * size).recip()));
            most.extend(own.columns.iter().map(|_| f64::INFINITY));
        }
        let rows = statement.reading.len();
        let matrix = match columns.is_empty() {
            true => DMatrix::zeros(rows, 0),
            false => DMatrix::from_columns(&columns),
        };
        Self {
            matrix,
            precision,
            most,
        }
    }

    /// Root mean square of what the fit leaves, in the unit of the readings, over the rows that its amounts
    /// leave free.
    fn paid(&self, statement: &Statement) -> f64 {
        let spread = statement.noise.spread();
        let each = statement.reading.iter().zip(spread);
        let y = DVector::from_iterator(spread.len(), each.map(|(r, s)| r / s));
        let mut gram = self.matrix.tr_mul(&self.matrix);
        for (i, p) in self.precision.iter().enumerate() {
            gram[(i, i)] += p;
        }
        let left = &y - &self.matrix * limited(&gram, &self.matrix.tr_mul(&y), &self.most);
        let squares: f64 = left.iter().zip(spread).map(|(l, s)| (l * s).powi(2)).sum();
        let free = spread.len() as f64 - self.matrix.ncols() as f64;
        (squares / free.max(1.0)).sqrt()
    }

    /// Error of every row in the unit of the readings, each fold predicted from the others.
    fn held_out(&self, statement: &Statement, split: &[usize]) -> Vec<f64> {
        let spread = statement.noise.spread();
        let each = statement.reading.iter().zip(spread);
        let y = DVector::from_iterator(split.len(), each.map(|(r, s)| r / s));
        let (gram, right) = (self.matrix.tr_mul(&self.matrix), self.matrix.tr_mul(&y));
        let folds = split.iter().copied().max().map_or(0, |f| f + 1);
        let mut error = statement.reading.clone();
        for fold in 0..folds {
            let rows: Vec<usize> = (0..split.len()).filter(|i| split[*i] == fold).collect();
            let (own, held) = (self.matrix.select_rows(&rows), y.select_rows(&rows));
            let mut rest = &gram - own.tr_mul(&own);
            let pull = &right - own.tr_mul(&held);
            for (i, p) in self.precision.iter().enumerate() {
                rest[(i, i)] += p;
            }
            let left = held - own * limited(&rest, &pull, &self.most);
            rows.iter()
                .zip(left.iter())
                .for_each(|(i, l)| error[*i] = l * spread[*i]);
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
