//! What is uncertain although nothing is wrong: whitened columns that are integrated out, and how far each may
//! be off.

use super::statement::{Nuisance, Statement};
use crate::ground::products::{gram, tr_mul};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use statrs::distribution::{ContinuousCDF, Normal};

/// What is merely uncertain, and alone, may be off by so many of its standard deviations; beyond, something
/// is wrong.
pub const ALLOWED: f64 = 2.5;

/// How far each of many nuisances may be off, in standard deviations: a sound file has one of them beyond as
/// seldom as a single one is beyond [`ALLOWED`] (Bonferroni).
pub(super) fn allowed(nuisances: &[Nuisance]) -> f64 {
    let normal = Normal::standard();
    let count = nuisances.iter().filter(|n| n.spread.is_finite()).count();
    -normal.inverse_cdf(normal.cdf(-ALLOWED) / count.max(1) as f64)
}

/// What a column alone explains of a reading, all that is uncertain being integrated out.
pub struct Alone {
    /// Its most probable amount, and the standard error of that where the noise is as stated; none of a column that what is uncertain holds.
    pub amount: Option<[f64; 2]>,
    /// Squares that it takes, in noise deviations.
    pub taken: f64,
    /// Squares that there are without it.
    pub all: f64,
    /// Mean square of what it leaves: 1 where the noise and all that is uncertain are as stated.
    pub left: f64,
}

impl Alone {
    /// Of a column beside what is uncertain in a statement.
    pub fn of(statement: &Statement, column: &[f64]) -> Self {
        let nuisances = Nuisances::of(statement);
        let white = |c: &[f64]| DMatrix::from_vec(c.len(), 1, statement.noise.whiten(c));
        let [column, reading] = [column, &statement.reading].map(white);
        let [by_column, by_reading] = [&column, &reading].map(|c| nuisances.seen(c));
        let square = column.norm_squared() - by_column.norm_squared();
        let pull = column.dot(&reading) - by_column.dot(&by_reading);
        let all = reading.norm_squared() - by_reading.norm_squared();
        let is_own = square > 1e-12 * column.norm_squared();
        let taken = if is_own { pull * pull / square } else { 0.0 };
        let free = reading.len().saturating_sub(nuisances.flat + 1).max(1);
        Self {
            amount: is_own.then(|| [pull / square, square.sqrt().recip()]),
            taken,
            all,
            left: (all - taken) / free as f64,
        }
    }
}

/// What is left of the reading of a statement where all that is uncertain is at its most probable, however far that is, and nobody is to
/// blame, in noise deviations, and the farthest of what is known of it from what is known, in standard deviations.
pub fn unblamed(statement: &Statement) -> (Vec<f64>, f64) {
    let nuisances = Nuisances::of(statement);
    let reading = DVector::from_vec(statement.noise.whiten(&statement.reading));
    let pull = nuisances.columns.tr_mul(&reading);
    let amounts = match &nuisances.root {
        Some(root) => root.solve(&pull),
        None => DVector::zeros(pull.len()),
    };
    let most = nuisances.most.iter().zip(amounts.iter());
    let far = most.map(|(most, amount)| (amount / most).abs());
    let farthest = far.fold(0.0, f64::max) * nuisances.allowed;
    let left = reading - &nuisances.columns * amounts;
    (left.as_slice().to_vec(), farthest)
}

/// Columns that are integrated out.
pub(super) struct Nuisances {
    pub columns: DMatrix<f64>,
    pub root: Option<Cholesky<f64, Dyn>>,
    /// NᵀN + P⁻¹ of the scaled columns.
    pub inner: DMatrix<f64>,
    /// By which the columns were divided.
    pub lengths: Vec<f64>,
    /// How far each may be off, in units of the scaled columns; infinite without prior.
    pub most: Vec<f64>,
    /// How many are without prior.
    pub flat: usize,
    /// How far each may be off, in standard deviations.
    allowed: f64,
}

impl Nuisances {
    /// Of a statement.
    pub fn of(statement: &Statement) -> Self {
        let rows = statement.reading.len();
        let white = |c: &[f64]| DVector::from_vec(statement.noise.whiten(c));
        let columns: Vec<DVector<f64>> = statement
            .nuisances
            .iter()
            .map(|n| white(&n.column))
            .collect();
        // scaled to unit length, so that the products are well conditioned
        let lengths: Vec<f64> = columns.iter().map(|c| c.norm().max(1e-300)).collect();
        let each = columns.iter().zip(&lengths);
        let scaled: Vec<DVector<f64>> = each.map(|(c, length)| c / *length).collect();
        let matrix = match scaled.is_empty() {
            true => DMatrix::zeros(rows, 0),
            false => DMatrix::from_columns(&scaled),
        };
        let mut inner = gram(&matrix);
        let mut flat = 0;
        let allowed = allowed(&statement.nuisances);
        let mut most = Vec::new();
        for (k, nuisance) in statement.nuisances.iter().enumerate() {
            let spread = nuisance.spread * lengths[k];
            flat += usize::from(spread.is_infinite());
            most.push(allowed * spread);
            // a column of zeros is of no length, and says nothing
            inner[(k, k)] += (spread * spread).recip().clamp(1e-12, 1e12);
        }
        Self {
            root: inner.clone().cholesky(),
            inner,
            columns: matrix,
            lengths,
            most,
            flat,
            allowed,
        }
    }

    /// Half of ln det(I + NPNᵀ), but for what has no prior: what evidence pays for how much these may explain.
    pub fn room(&self) -> f64 {
        let Some(root) = &self.root else { return 0.0 };
        let own: f64 = root.l_dirty().diagonal().iter().map(|l| l.ln()).sum();
        let known = self
            .most
            .iter()
            .filter(|most| most.is_finite() && **most > 0.0);
        own + known.map(|most| (most / self.allowed).ln()).sum::<f64>()
    }

    /// U of columns, nuisances × columns.
    pub fn seen(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let mut cross = tr_mul(&self.columns, columns);
        if let Some(root) = &self.root {
            root.l_dirty().solve_lower_triangular_mut(&mut cross);
        }
        cross
    }

    /// Products of the nuisances, their priors in it, beside those of other columns: `seen` is U of these,
    /// `own` their products with one another once the nuisances are integrated out.
    pub fn beside(&self, seen: &DMatrix<f64>, own: &DMatrix<f64>) -> DMatrix<f64> {
        let (k, p) = (self.most.len(), own.ncols());
        let cross = self.crossed(seen);
        let mut all = DMatrix::zeros(k + p, k + p);
        all.view_mut((0, 0), (k, k)).copy_from(&self.inner);
        all.view_mut((0, k), (k, p)).copy_from(&cross);
        all.view_mut((k, 0), (p, k)).copy_from(&cross.transpose());
        all.view_mut((k, k), (p, p))
            .copy_from(&(own + seen.tr_mul(seen)));
        all
    }

    /// Products of the nuisances with columns of which U is known.
    pub fn crossed(&self, seen: &DMatrix<f64>) -> DMatrix<f64> {
        match &self.root {
            Some(root) => root.l() * seen,
            None => seen.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::unblamed;
    use crate::findings::engine::{Aspects, Nuisance, Statement, White};

    /// A column of zeros is uncertain to no effect, however little is known of it.
    #[test]
    fn what_adds_nothing_takes_nothing() {
        let column = |value: f64| Nuisance {
            column: vec![value; 9],
            spread: 1.0,
        };
        let left = |nuisances: Vec<Nuisance>| unblamed(&nine(nuisances)).0;
        let (with, without) = (
            left(vec![column(1.0), column(0.0)]),
            left(vec![column(1.0)]),
        );
        let mut pairs = with.iter().zip(&without);
        assert!(pairs.all(|(a, b)| (a - b).abs() < 1e-9), "{with:?}");
    }

    /// Nine equal readings of 3.
    fn nine(nuisances: Vec<Nuisance>) -> Statement {
        Statement {
            reading: vec![3.0; 9],
            noise: Box::new(White {
                spread: vec![1.0; 9],
                rows: 9.0,
            }),
            nuisances,
            suspects: Vec::new(),
            span: Vec::new(),
            splits: Vec::new(),
            aspects: Aspects::default(),
        }
    }

    /// A number that is known to 1 and must be 3 is at 2.7 where nine equal readings say so to 1 each, and leaves the rest.
    #[test]
    fn what_is_uncertain_goes_as_far_as_it_is_believed() {
        let statement = nine(vec![Nuisance {
            column: vec![1.0; 9],
            spread: 1.0,
        }]);
        let (left, farthest) = unblamed(&statement);
        assert!((farthest - 2.7).abs() < 1e-9, "{farthest}");
        assert!(left.iter().all(|l| (l - 0.3).abs() < 1e-9));
    }
}
