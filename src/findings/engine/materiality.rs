//! Whether every cause of a set is of a size that matters: beside the noise of one reading, and beside
//! all that is named. What the others can take over does not count as its own.

use super::aspect::alike;
use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use super::statement::Statement;
use crate::ground::products::{gram, tr_mul};
use crate::ground::stats::{quantile, rms};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use std::collections::BTreeMap;

/// What tells whether causes matter, for many sets: the columns of members without what nobody knows anyway.
pub struct Materiality<'a> {
    statement: &'a Statement,
    bank: &'a Bank<'a>,
    judgement: &'a Judgement,
    flat: Flat,
    columns: BTreeMap<usize, DMatrix<f64>>,
    products: BTreeMap<(usize, usize), DMatrix<f64>>,
}

impl<'a> Materiality<'a> {
    /// Of the members of a bank.
    pub fn new(statement: &'a Statement, bank: &'a Bank, judgement: &'a Judgement) -> Self {
        Self {
            flat: Flat::of(statement),
            statement,
            bank,
            judgement,
            columns: BTreeMap::new(),
            products: BTreeMap::new(),
        }
    }

    /// Whether all causes of a set matter.
    pub fn holds(&mut self, fit: &Fit) -> bool {
        self.learn(&fit.members);
        let total = self.total(fit);
        (0..fit.members.len()).all(|at| self.matters(fit, at, total))
    }

    /// Rms of all that is named, less what is the same in every reading.
    fn total(&self, fit: &Fit) -> f64 {
        let own = amounts(self.bank, fit);
        let mut bent = all_of(fit);
        bent.retain(|at| !self.bank.suspect(fit.members[*at]).is_level());
        let amounts: Vec<DVector<f64>> = bent.iter().map(|at| own[*at].clone()).collect();
        self.rms_of(fit, &bent, &amounts)
    }

    fn matters(&self, fit: &Fit, at: usize, total: f64) -> bool {
        let (bank, judgement) = (self.bank, self.judgement);
        let share = match (bank.suspect(fit.members[at]).named, has_kin(bank, fit, at)) {
            (false, _) => judgement.left_share,
            (true, true) => judgement.share_beside_kin,
            (true, false) => judgement.share,
        };
        let own = self.own_amounts(fit, at);
        let size = self.rms_of(fit, &all_of(fit), &own);
        if fit.members.len() > 1 && size < (share * total).max(self.missed(fit, at)) {
            return false;
        }
        let mut part = DVector::zeros(self.statement.reading.len());
        for (member, amounts) in fit.members.iter().zip(&own) {
            part.gemv(1.0, &self.columns[member], amounts, 1.0);
        }
        let columns = &bank.member(fit.members[at]).columns;
        let acts = |i: &usize| columns.iter().any(|c| c[*i] != 0.0);
        let rows = (0..part.len()).filter(acts);
        let peaks: Vec<f64> = rows.map(|i| part[i].abs()).collect();
        let noise = fit.posterior.noise_variance.sqrt();
        let suspect = bank.suspect(fit.members[at]);
        let is_exact = suspect.named && suspect.law_error == 0.0;
        let exact = judgement.exact_peak.filter(|_| is_exact);
        let peak = quantile(&peaks, judgement.peak_above);
        peak >= exact.unwrap_or(judgement.peak) * noise
            || suspect.named
                && judgement.faint_nats.is_finite()
                && self.worth(fit, at) >= judgement.faint_nats
    }

    /// Nats that a cause of a set is worth beside the others.
    fn worth(&self, fit: &Fit, at: usize) -> f64 {
        let mut others = fit.members.clone();
        others.remove(at);
        let without = self.bank.fit(&others);
        without.map_or(0.0, |without| {
            fit.posterior.ln_evidence - without.posterior.ln_evidence
        })
    }

    /// The most that the laws of the others miss of the kind of this one, noise deviations rms.
    fn missed(&self, fit: &Fit, at: usize) -> f64 {
        let law = |i: &usize| self.bank.suspect(fit.members[*i]).law_error;
        let mut others = all_of(fit);
        others.retain(|i| *i != at && law(i) > 0.0);
        if others.is_empty() {
            return 0.0;
        }
        let parts = raw_parts(self.bank, fit);
        let sizes = |i: usize| {
            let part = in_noise(self.statement, &parts[i]);
            self.statement.aspects.sizes(&part)
        };
        let own = sizes(at);
        let missed = |i: &usize| law(i) * alike(&own, &sizes(*i));
        others.iter().map(missed).fold(0.0, f64::max)
    }

    /// Amounts of all members that make the part of one which the others cannot take over.
    fn own_amounts(&self, fit: &Fit, at: usize) -> Vec<DVector<f64>> {
        let mut all = amounts(self.bank, fit);
        let others: Vec<usize> = (0..fit.members.len()).filter(|i| *i != at).collect();
        if others.is_empty() {
            return all;
        }
        let own = self.gram(fit, &others, &others);
        let mut inner = own.clone();
        (0..own.nrows()).for_each(|i| inner[(i, i)] += 1e-9 * own[(i, i)] + f64::MIN_POSITIVE);
        let seen = self.gram(fit, &others, &[at]) * &all[at];
        let taken = inner.cholesky().map(|root| root.solve(&seen));
        let mut first = 0;
        for i in others {
            let count = all[i].len();
            all[i] = match &taken {
                Some(taken) => -taken.rows(first, count),
                None => DVector::zeros(count),
            };
            first += count;
        }
        all
    }

    fn rms_of(&self, fit: &Fit, members: &[usize], amounts: &[DVector<f64>]) -> f64 {
        let all: Vec<f64> = amounts.iter().flat_map(|a| a.iter().copied()).collect();
        let all = DVector::from_vec(all);
        let square = all.dot(&(self.gram(fit, members, members) * &all));
        (square.max(0.0) / self.statement.reading.len().max(1) as f64).sqrt()
    }

    /// Products of the columns of some members of a set with those of others.
    fn gram(&self, fit: &Fit, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
        let count = |i: &usize| self.columns[&fit.members[*i]].ncols();
        let (height, width) = (
            rows.iter().map(count).sum(),
            columns.iter().map(count).sum(),
        );
        let mut all = DMatrix::zeros(height, width);
        let mut top = 0;
        for i in rows {
            let mut left = 0;
            for j in columns {
                let (a, b) = (fit.members[*i], fit.members[*j]);
                let shape = (count(i), count(j));
                let mut view = all.view_mut((top, left), shape);
                match a <= b {
                    true => view.copy_from(&self.products[&(a, b)]),
                    false => view.copy_from(&self.products[&(b, a)].transpose()),
                }
                left += shape.1;
            }
            top += count(i);
        }
        all
    }

    fn learn(&mut self, members: &[usize]) {
        for member in members {
            if !self.columns.contains_key(member) {
                let columns = self.bank.member(*member).columns.iter();
                let own: Vec<DVector<f64>> = columns
                    .map(|c| DVector::from_vec(in_noise(self.statement, c)))
                    .collect();
                let free = self.flat.free_of(DMatrix::from_columns(&own));
                self.columns.insert(*member, free);
            }
        }
        for a in members {
            for b in members.iter().filter(|b| a <= b) {
                let own = || tr_mul(&self.columns[a], &self.columns[b]);
                self.products.entry((*a, *b)).or_insert_with(own);
            }
        }
    }
}

fn all_of(fit: &Fit) -> Vec<usize> {
    (0..fit.members.len()).collect()
}

/// Amounts of every member, in units of its columns.
pub(super) fn amounts(bank: &Bank, fit: &Fit) -> Vec<DVector<f64>> {
    let mut at = 0;
    let each = fit.members.iter().map(|member| {
        let count = bank.member(*member).columns.len();
        at += count;
        fit.posterior.mean.rows(at - count, count) * bank.entries[*member].scale
    });
    each.collect()
}

/// The columns of what nobody knows anyway, of unit length in noise deviations of a reading.
struct Flat {
    columns: DMatrix<f64>,
    root: Option<Cholesky<f64, Dyn>>,
}

impl Flat {
    fn of(statement: &Statement) -> Self {
        let nuisances = statement.nuisances.iter();
        let flat = nuisances.filter(|n| n.spread.is_infinite());
        let unit = |c: &Vec<f64>| {
            let c = DVector::from_vec(in_noise(statement, c));
            let length = c.norm().max(f64::MIN_POSITIVE);
            c / length
        };
        let columns: Vec<DVector<f64>> = flat.map(|n| unit(&n.column)).collect();
        let columns = match columns.is_empty() {
            true => DMatrix::zeros(statement.reading.len(), 0),
            false => DMatrix::from_columns(&columns),
        };
        let mut inner = gram(&columns);
        (0..inner.nrows()).for_each(|i| inner[(i, i)] += 1e-9);
        Self {
            root: inner.cholesky(),
            columns,
        }
    }

    /// What they leave of columns in noise deviations.
    fn free_of(&self, columns: DMatrix<f64>) -> DMatrix<f64> {
        match &self.root {
            Some(root) if self.columns.ncols() > 0 => {
                let taken = root.solve(&tr_mul(&self.columns, &columns));
                columns - &self.columns * taken
            }
            _ => columns,
        }
    }
}

/// Rms of all that a set explains beyond the nuisances, in noise deviations of a reading; 0 where its peak
/// is too small to be seen.
pub(super) fn explained_rms(
    statement: &Statement,
    bank: &Bank,
    fit: &Fit,
    judgement: &Judgement,
) -> f64 {
    let all = in_noise(statement, &sum(statement, &raw_parts(bank, fit)));
    let all = DMatrix::from_column_slice(all.len(), 1, &all);
    let total = Flat::of(statement).free_of(all);
    let peaks: Vec<f64> = total.iter().map(|v| v.abs()).collect();
    let noise = fit.posterior.noise_variance.sqrt();
    match quantile(&peaks, 0.98) > judgement.left_peak * noise {
        true => rms(total.as_slice()),
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

pub(super) fn in_noise(statement: &Statement, raw: &[f64]) -> Vec<f64> {
    raw.iter()
        .zip(statement.noise.spread())
        .map(|(v, s)| v / s)
        .collect()
}
