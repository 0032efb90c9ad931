//! Whether every cause of a set is of a size that matters: beside the noise of one reading, and beside
//! all that is named. What the others can take over does not count as its own.

use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use super::statement::Statement;
use crate::ground::products::gram;
use crate::ground::stats::{quantile, rms};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Whether all causes of a set matter.
pub fn is_material(statement: &Statement, bank: &Bank, fit: &Fit, judgement: &Judgement) -> bool {
    if fit.members.is_empty() {
        return true;
    }
    let noise = fit.posterior.noise_variance.sqrt();
    let parts = parts(statement, bank, fit);
    let beside = Beside::of(statement, bank, fit);
    let total = rms(&beside.free_of(&[], &sum(statement, &parts)));
    let sizes: Vec<f64> = parts.iter().map(|p| rms(p)).collect();
    (0..parts.len()).all(|at| {
        let share = match (bank.suspect(fit.members[at]).named, has_kin(bank, fit, at)) {
            (false, _) => judgement.left_share,
            (true, true) => judgement.share_beside_kin,
            (true, false) => judgement.share,
        };
        let others: Vec<usize> = (0..parts.len()).filter(|i| *i != at).collect();
        let rough = |i: &usize| bank.suspect(fit.members[*i]).law_error * sizes[*i];
        let missed = others.iter().map(rough).fold(0.0, f64::max);
        let own = beside.free_of(&others, &parts[at]);
        if parts.len() > 1 && rms(&own) < (share * total).max(missed) {
            return false;
        }
        let peaks: Vec<f64> = own.iter().map(|v| v.abs()).collect();
        quantile(&peaks, 0.99) >= judgement.peak * noise
    })
}

/// Rms of all that a set explains beyond the nuisances, in noise deviations of a reading; 0 where its peak
/// is too small to be seen.
pub(super) fn explained_rms(
    statement: &Statement,
    bank: &Bank,
    fit: &Fit,
    judgement: &Judgement,
) -> f64 {
    let all = sum(statement, &parts(statement, bank, fit));
    let total = Beside::of(statement, bank, fit).free_of(&[], &all);
    let peaks: Vec<f64> = total.iter().map(|v| v.abs()).collect();
    let noise = fit.posterior.noise_variance.sqrt();
    match quantile(&peaks, 0.98) > judgement.left_peak * noise {
        true => rms(&total),
        false => 0.0,
    }
}

fn sum(statement: &Statement, parts: &[Vec<f64>]) -> Vec<f64> {
    let rows = 0..statement.reading.len();
    rows.map(|i| parts.iter().map(|p| p[i]).sum()).collect()
}

fn has_kin(bank: &Bank, fit: &Fit, at: usize) -> bool {
    let own = bank.suspect(fit.members[at]).mechanism;
    let others = fit.members.iter().enumerate();
    others
        .filter(|(i, _)| *i != at)
        .any(|(_, m)| bank.suspect(*m).mechanism == own)
}

/// What every member adds to the readings, in noise deviations of a reading.
fn parts(statement: &Statement, bank: &Bank, fit: &Fit) -> Vec<Vec<f64>> {
    let raw = raw_parts(bank, fit);
    raw.iter().map(|part| in_noise(statement, part)).collect()
}

/// What every member of a fit adds to the readings, in their unit.
pub(super) fn raw_parts(bank: &Bank, fit: &Fit) -> Vec<Vec<f64>> {
    let mut at = 0;
    let each = fit.members.iter().map(|member| {
        let (entry, own) = (&bank.entries[*member], bank.member(*member));
        let first = at;
        at += own.columns.len();
        let rows = own.columns[0].len();
        let amount = |k: usize| fit.posterior.mean[first + k] * entry.scale;
        let value = |i: usize| {
            own.columns
                .iter()
                .enumerate()
                .map(|(k, c)| amount(k) * c[i])
                .sum()
        };
        (0..rows).map(value).collect()
    });
    each.collect()
}

fn in_noise(statement: &Statement, raw: &[f64]) -> Vec<f64> {
    raw.iter()
        .zip(statement.noise.spread())
        .map(|(v, s)| v / s)
        .collect()
}

/// The columns of a set and of what nobody knows anyway, of unit length in noise deviations of a reading.
struct Beside {
    columns: DMatrix<f64>,
    gram: DMatrix<f64>,
    /// Columns of every member; the others are those of nuisances without prior.
    own: Vec<Range<usize>>,
}

impl Beside {
    fn of(statement: &Statement, bank: &Bank, fit: &Fit) -> Self {
        let unit = |c: &Vec<f64>| {
            let c = DVector::from_vec(in_noise(statement, c));
            let length = c.norm().max(f64::MIN_POSITIVE);
            c / length
        };
        let (mut columns, mut own) = (Vec::new(), Vec::new());
        for member in &fit.members {
            let first = columns.len();
            columns.extend(bank.member(*member).columns.iter().map(unit));
            own.push(first..columns.len());
        }
        let nuisances = statement.nuisances.iter();
        let flat = nuisances.filter(|n| n.spread.is_infinite());
        columns.extend(flat.map(|n| unit(&n.column)));
        let columns = match columns.is_empty() {
            true => DMatrix::zeros(statement.reading.len(), 0),
            false => DMatrix::from_columns(&columns),
        };
        Self {
            gram: gram(&columns),
            columns,
            own,
        }
    }

    /// What some members and the nuisances without prior leave of numbers in noise deviations.
    fn free_of(&self, members: &[usize], values: &[f64]) -> Vec<f64> {
        let flat = self.own.last().map_or(0, |r| r.end)..self.columns.ncols();
        let taken = members.iter().flat_map(|m| self.own[*m].clone());
        let taken: Vec<usize> = taken.chain(flat).collect();
        if taken.is_empty() {
            return values.to_vec();
        }
        let mut inner = self.gram.select_rows(&taken).select_columns(&taken);
        (0..taken.len()).for_each(|i| inner[(i, i)] += 1e-9);
        let y = DVector::from_column_slice(values);
        let seen = taken.iter().map(|c| self.columns.column(*c).dot(&y));
        let seen = DVector::from_iterator(taken.len(), seen);
        let amounts = inner.cholesky().map(|root| root.solve(&seen));
        let mut left = y;
        for (c, amount) in taken.iter().zip(amounts.iter().flat_map(|a| a.iter())) {
            left.axpy(-amount, &self.columns.column(*c), 1.0);
        }
        left.as_slice().to_vec()
    }
}
