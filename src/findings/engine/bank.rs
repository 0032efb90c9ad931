//! Whitened columns with the nuisances integrated out, and the evidence of sets of members.
//!
//! With y ~ N(Φz, I + N P Nᵀ) the inner product is aᵀb − (Ua)·(Ub), U = L⁻¹Nᵀ, LLᵀ = NᵀN + P⁻¹
//! (Woodbury 1950): every product of columns is taken so, and nuisances are never seen again.

use super::entry::{Entry, entries};
use super::nuisances::Nuisances;
use super::statement::{Member, Statement, Suspect};
use crate::ground::products::{gram, tr_mul};
use crate::inference::gaussian::{Posterior, Products, Reading, Size, limited, update};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// A set of members (indices into the bank), ascending by suspect.
pub type Members = Vec<usize>;

/// All columns of all suspects.
pub struct Bank<'a> {
    /// Who they belong to.
    pub suspects: &'a [Suspect],
    pub(super) entries: Vec<Entry>,
    pub(super) columns: DMatrix<f64>,
    marginal: DMatrix<f64>,
    pub(super) right: DVector<f64>,
    pub(super) reading: Reading,
    whitened: (DVector<f64>, DVector<f64>),
    crosses: BTreeMap<usize, DMatrix<f64>>,
    nuisances: Nuisances,
}

/// A set with its fit.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The members, ascending.
    pub members: Members,
    /// What the data say of their amounts, in units of the bank.
    pub posterior: Posterior,
    /// Nats that the limits of the nuisances cost, in the evidence already.
    pub beyond: f64,
}

impl<'a> Bank<'a> {
    /// Of a statement.
    pub fn new(statement: &'a Statement) -> Self {
        let nuisances = Nuisances::of(statement);
        let white = |c: &Vec<f64>| DVector::from_vec(statement.noise.whiten(c));
        let all = statement.suspects.iter().flat_map(|s| &s.members);
        let columns: Vec<DVector<f64>> = all.flat_map(|m| m.columns.iter().map(white)).collect();
        let rows = statement.reading.len();
        let mut columns = match columns.is_empty() {
            true => DMatrix::zeros(rows, 0),
            false => DMatrix::from_columns(&columns),
        };
        let mut marginal = nuisances.seen(&columns);
        let entries = entries(&statement.suspects, &mut columns, &mut marginal);
        let y = DMatrix::from_column_slice(rows, 1, &statement.noise.whiten(&statement.reading));
        let seen = nuisances.seen(&y);
        let right = columns.tr_mul(&y) - marginal.tr_mul(&seen);
        let (y, seen) = (y.column(0).into_owned(), seen.column(0).into_owned());
        let reading = Reading {
            square: (y.norm_squared() - seen.norm_squared()).max(0.0),
            rows: (rows.saturating_sub(nuisances.flat)).max(1) as f64,
            noise_rows: statement.noise.rows(),
        };
        Self {
            suspects: &statement.suspects,
            entries,
            right: right.column(0).into_owned(),
            columns,
            marginal,
            reading,
            whitened: (y, seen),
            crosses: BTreeMap::new(),
            nuisances,
        }
    }

    /// The suspect of a member.
    pub fn suspect(&self, member: usize) -> &Suspect {
        &self.suspects[self.entries[member].suspect]
    }

    /// A member as its suspect stated it.
    pub fn member(&self, member: usize) -> &Member {
        let entry = &self.entries[member];
        &self.suspects[entry.suspect].members[entry.member]
    }

    /// The members of a suspect.
    pub(super) fn members_of(&self, suspect: usize) -> impl Iterator<Item = usize> {
        (0..self.entries.len()).filter(move |m| self.entries[*m].suspect == suspect)
    }

    /// The fit of a set. `None` where an amount has the wrong sign, or nothing is finite.
    pub fn fit(&self, members: &[usize]) -> Option<Fit> {
        let blocks = self.blocks(members);
        let mut posterior = update(&self.products(members), &self.reading, &blocks)?;
        let beyond = self.hold(members, &mut posterior);
        let fit = Fit {
            members: members.to_vec(),
            posterior,
            beyond,
        };
        (fit.posterior.ln_evidence.is_finite() && self.signs_hold(&fit)).then_some(fit)
    }

    /// Where the fit takes a nuisance further than is allowed to it, amounts and nuisances are solved again
    /// within the limits, and the evidence is that of what is left then: an uncertain number must not pay for
    /// what a cause explains.
    fn hold(&self, members: &[usize], posterior: &mut Posterior) -> f64 {
        let ranges = members.iter().map(|m| self.entries[*m].columns.clone());
        let own: Vec<usize> = ranges.flatten().collect();
        let held = &self.nuisances;
        let seen = &self.whitened.1 - self.marginal.select_columns(&own) * &posterior.mean;
        let solved = held
            .root
            .as_ref()
            .and_then(|r| r.l_dirty().tr_solve_lower_triangular(&seen));
        let beyond = |x: DVector<f64>| x.iter().zip(&held.most).any(|(x, most)| x.abs() > *most);
        if !solved.is_some_and(beyond) {
            return 0.0;
        }
        let marginal = self.marginal.select_columns(&own);
        let (k, p) = (held.most.len(), own.len());
        let products = self.products(members);
        let mut hessian = held.beside(&marginal, &products.gram);
        let sizes = self.blocks(members).into_iter().zip(&posterior.sizes);
        let sizes = sizes.flat_map(|((count, _), size)| std::iter::repeat_n(*size, count));
        sizes
            .enumerate()
            .for_each(|(i, size)| hessian[(k + i, k + i)] += (size * size).recip());
        let (y, known) = &self.whitened;
        let mut right = DVector::zeros(k + p);
        let known = DMatrix::from_column_slice(k, 1, known.as_slice());
        right.rows_mut(0, k).copy_from(&held.crossed(&known));
        right
            .rows_mut(k, p)
            .copy_from(&(products.right + marginal.tr_mul(&known)));
        let free = std::iter::repeat_n(f64::INFINITY, p);
        let most: Vec<f64> = held.most.iter().copied().chain(free).collect();
        let solved = limited(&hessian, &right, &most);
        let left = y.norm_squared() - 2.0 * right.dot(&solved) + solved.dot(&(&hessian * &solved));
        let left = left.max(posterior.left);
        let cost = self.reading.ln_evidence(posterior.left) - self.reading.ln_evidence(left);
        posterior.ln_evidence -= cost;
        posterior.mean = solved.rows(k, p).into_owned();
        posterior.noise_variance = self.reading.noise_variance(left);
        posterior.left = left;
        cost
    }

    fn blocks(&self, members: &[usize]) -> Vec<(usize, Size)> {
        let own = members.iter().map(|m| &self.entries[*m]);
        own.map(|e| (e.columns.len(), e.size)).collect()
    }

    /// Products of the columns of a set.
    pub(super) fn products(&self, members: &[usize]) -> Products {
        let own: Vec<&Entry> = members.iter().map(|m| &self.entries[*m]).collect();
        let total = own.iter().map(|e| e.columns.len()).sum();
        let mut gram = DMatrix::zeros(total, total);
        let mut right = DVector::zeros(total);
        let mut at = 0;
        for (i, entry) in own.iter().enumerate() {
            let p = entry.columns.len();
            gram.view_mut((at, at), (p, p)).copy_from(&entry.own);
            right
                .rows_mut(at, p)
                .copy_from(&self.right.rows(entry.columns.start, p));
            let mut other = 0;
            for (j, before) in own[..i].iter().enumerate() {
                let q = before.columns.len();
                let block = self.block(members[i], members[j]);
                gram.view_mut((other, at), (q, p))
                    .copy_from(&block.transpose());
                gram.view_mut((at, other), (p, q)).copy_from(&block);
                other += q;
            }
            at += p;
        }
        Products { gram, right }
    }

    /// Products of the columns of two members, first × second.
    fn block(&self, a: usize, b: usize) -> DMatrix<f64> {
        let (ra, rb) = (&self.entries[a].columns, &self.entries[b].columns);
        if let Some(cross) = self.crosses.get(&b) {
            return cross.rows(ra.start, ra.len()).into_owned();
        }
        if let Some(cross) = self.crosses.get(&a) {
            return cross.rows(rb.start, rb.len()).transpose();
        }
        let full = |m: &DMatrix<f64>| {
            let (x, y) = (m.columns(ra.start, ra.len()), m.columns(rb.start, rb.len()));
            tr_mul(x, y)
        };
        full(&self.columns) - full(&self.marginal)
    }

    /// Takes the products of a member with all columns once, for the sets that will hold it.
    pub fn keep(&mut self, member: usize) {
        if self.crosses.contains_key(&member) {
            return;
        }
        let own = self.entries[member].columns.clone();
        let full = |m: &DMatrix<f64>| tr_mul(m, m.columns(own.start, own.len()));
        let cross = full(&self.columns) - full(&self.marginal);
        self.crosses.insert(member, cross);
    }

    /// Products of all columns with those of a set that was kept, columns × amounts of the set.
    pub(super) fn cross(&self, members: &[usize]) -> DMatrix<f64> {
        let own: Vec<&DMatrix<f64>> = members.iter().filter_map(|m| self.crosses.get(m)).collect();
        let total = own.iter().map(|c| c.ncols()).sum();
        let mut all = DMatrix::zeros(self.columns.ncols(), total);
        let mut at = 0;
        for cross in own {
            all.columns_mut(at, cross.ncols()).copy_from(cross);
            at += cross.ncols();
        }
        all
    }

    /// Square of every column.
    pub(super) fn square(&self, entry: &Entry) -> f64 {
        entry.own[(0, 0)]
    }

    fn signs_hold(&self, fit: &Fit) -> bool {
        let mut at = 0;
        fit.members.iter().all(|member| {
            let first = at;
            at += self.entries[*member].columns.len();
            let own = &fit.posterior.mean.as_slice()[first..at];
            self.member(*member).allows(own) && self.member(*member).has_sign(own)
        })
    }

    /// See `Nuisances::room`.
    pub fn room(&self) -> f64 {
        self.nuisances.room()
    }

    /// The most probable amounts of the nuisances in whitened numbers, in the kind's own units, none beyond
    /// what is allowed to it.
    pub(super) fn nuisances_in(&self, whitened: &DVector<f64>) -> Vec<f64> {
        let right = self.nuisances.columns.tr_mul(whitened);
        let solved = limited(&self.nuisances.inner, &right, &self.nuisances.most);
        let each = solved.iter().zip(&self.nuisances.lengths);
        each.map(|(x, length)| x / length).collect()
    }

    /// Rows that say how large the noise is: infinite where it is certain.
    pub(super) fn noise_rows(&self) -> f64 {
        self.reading.rows + self.reading.noise_rows
    }

    /// The whitened reading.
    pub(super) fn whitened(&self) -> &DVector<f64> {
        &self.whitened.0
    }

    /// What a member adds to the whitened reading at these amounts (units of the bank).
    pub(super) fn part(&self, member: usize, amounts: &[f64]) -> DVector<f64> {
        let own = &self.entries[member].columns;
        self.columns.columns(own.start, own.len()) * DVector::from_column_slice(amounts)
    }

    /// Whitened extra columns beside those of the bank: their products with one another (`own` before the
    /// nuisances are integrated out), with the columns of a set, and with the reading.
    pub(super) fn beside(
        &self,
        members: &[usize],
        (extra, own_gram): (&DMatrix<f64>, &DMatrix<f64>),
    ) -> Products {
        let inside = self.products(members);
        let ranges = members.iter().map(|m| self.entries[*m].columns.clone());
        let own: Vec<usize> = ranges.flatten().collect();
        let (columns, marginal) = (
            self.columns.select_columns(&own),
            self.marginal.select_columns(&own),
        );
        let seen = self.nuisances.seen(extra);
        let (n, m) = (own.len(), extra.ncols());
        let mut all = DMatrix::zeros(n + m, n + m);
        all.view_mut((0, 0), (n, n)).copy_from(&inside.gram);
        let cross = tr_mul(&columns, extra) - marginal.tr_mul(&seen);
        all.view_mut((0, n), (n, m)).copy_from(&cross);
        all.view_mut((n, 0), (m, n)).copy_from(&cross.transpose());
        all.view_mut((n, n), (m, m))
            .copy_from(&(own_gram - gram(&seen)));
        let mut right = DVector::zeros(n + m);
        right.rows_mut(0, n).copy_from(&inside.right);
        let (y, known) = &self.whitened;
        right
            .rows_mut(n, m)
            .copy_from(&(extra.tr_mul(y) - seen.tr_mul(known)));
        Products { gram: all, right }
    }
}
