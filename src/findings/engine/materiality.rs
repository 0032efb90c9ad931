//! Whether every cause of a set is of a size that matters: beside the noise of one reading, and beside
//! all that is named. What the others can take over does not count as its own.

use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use super::statement::Statement;
use crate::ground::stats::{quantile, rms};
use nalgebra::{DMatrix, DVector};

/// Whether all causes of a set matter.
pub fn is_material(statement: &Statement, bank: &Bank, fit: &Fit, judgement: &Judgement) -> bool {
    if fit.members.is_empty() {
        return true;
    }
    let noise = fit.posterior.noise_variance.sqrt();
    let parts = parts(statement, bank, fit);
    let total = rms(&free_of(statement, &[], &sum(statement, &parts)));
    (0..parts.len()).all(|at| {
        let own = own_part(statement, bank, fit, (at, &parts[at]));
        let peaks: Vec<f64> = own.iter().map(|v| v.abs()).collect();
        let share = match (bank.suspect(fit.members[at]).named, has_kin(bank, fit, at)) {
            (false, _) => judgement.left_share,
            (true, true) => judgement.share_beside_kin,
            (true, false) => judgement.share,
        };
        let beside = (0..parts.len()).filter(|i| *i != at);
        let rough = |i: usize| bank.suspect(fit.members[i]).law_error * rms(&parts[i]);
        let missed = beside.map(rough).fold(0.0, f64::max);
        quantile(&peaks, 0.99) >= judgement.peak * noise
            && (parts.len() == 1 || rms(&own) >= (share * total).max(missed))
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
    let total = free_of(
        statement,
        &[],
        &sum(statement, &parts(statement, bank, fit)),
    );
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

/// The part of a member that the others and what nobody knows anyway cannot take over.
fn own_part(
    statement: &Statement,
    bank: &Bank,
    fit: &Fit,
    (at, part): (usize, &[f64]),
) -> Vec<f64> {
    let others = fit.members.iter().enumerate().filter(|(i, _)| *i != at);
    let columns = others.flat_map(|(_, m)| bank.member(*m).columns.iter());
    let columns: Vec<Vec<f64>> = columns.map(|c| in_noise(statement, c)).collect();
    free_of(statement, &columns, part)
}

/// What columns and the nuisances without prior leave of numbers in noise deviations.
fn free_of(statement: &Statement, columns: &[Vec<f64>], values: &[f64]) -> Vec<f64> {
    let flat = statement
        .nuisances
        .iter()
        .filter(|n| n.spread.is_infinite());
    let flat = flat.map(|n| in_noise(statement, &n.column));
    let unit = |c: Vec<f64>| {
        let c = DVector::from_vec(c);
        let length = c.norm().max(f64::MIN_POSITIVE);
        c / length
    };
    let all: Vec<DVector<f64>> = columns.iter().cloned().chain(flat).map(unit).collect();
    if all.is_empty() {
        return values.to_vec();
    }
    let matrix = DMatrix::from_columns(&all);
    let mut inner = matrix.tr_mul(&matrix);
    (0..all.len()).for_each(|i| inner[(i, i)] += 1e-9);
    let y = DVector::from_column_slice(values);
    let taken = match inner.cholesky() {
        Some(root) => &matrix * root.solve(&matrix.tr_mul(&y)),
        None => DVector::zeros(values.len()),
    };
    (y - taken).as_slice().to_vec()
}
