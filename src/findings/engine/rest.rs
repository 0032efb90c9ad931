//! Whether structure is left that no named cause makes: generic columns beside the set, by evidence, and
//! only where what they find is material.

use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use super::statement::Statement;
use crate::inference::gaussian::{Size, update};
use crate::inference::stats::{quantile, rms};
use nalgebra::{DMatrix, DVector};

/// What is left beside a set.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rest {
    /// Evidence for structure beyond what laws miss anyway, nats.
    pub nats: f64,
    /// Its rms over that of the whole misfit.
    pub share: f64,
    /// Whether it counts.
    pub is_left: bool,
}

/// Structure that is always granted, noise deviations rms: digits and filters leave no less.
const GRANTED: f64 = 0.15;
/// How much more than granted is tried.
const TIMES: [f64; 9] = [1.5, 2.3, 3.5, 5.0, 8.0, 12.0, 20.0, 50.0, 150.0];

/// The generic columns of a statement, whitened, of one noise deviation rms together.
pub struct Span {
    columns: DMatrix<f64>,
}

impl Span {
    /// `None` where the kind states none.
    pub fn of(statement: &Statement) -> Option<Self> {
        let white = |c: &Vec<f64>| DVector::from_vec(statement.noise.whiten(c));
        let columns: Vec<DVector<f64>> = statement.span.iter().map(white).collect();
        let square: f64 = columns.iter().map(DVector::norm_squared).sum();
        if columns.is_empty() || square <= 0.0 {
            return None;
        }
        let rows = statement.reading.len() as f64;
        Some(Self {
            columns: DMatrix::from_columns(&columns) * (rows / square).sqrt(),
        })
    }

    /// Evidence of a set with so much generic structure beside it, and that structure, whitened.
    fn beside(&self, bank: &Bank, fit: &Fit, size: f64) -> Option<(f64, DVector<f64>)> {
        let products = bank.beside(&fit.members, &self.columns);
        let own = fit.members.iter().zip(&fit.posterior.sizes);
        let mut blocks: Vec<(usize, Size)> = own
            .map(|(m, size)| (bank.entries[*m].columns.len(), Size::Given(*size)))
            .collect();
        let before: usize = blocks.iter().map(|b| b.0).sum();
        blocks.push((self.columns.ncols(), Size::Given(size)));
        let found = update(&products, &bank.reading, &blocks)?;
        let amounts = found.mean.rows(before, self.columns.ncols());
        Some((found.ln_evidence, &self.columns * amounts))
    }

    /// Greatest evidence of structure alone, without any cause, less that of nothing.
    pub fn alone(&self, bank: &Bank, nothing: &Fit) -> f64 {
        let at = |times: &f64| self.beside(bank, nothing, GRANTED * times).map(|f| f.0);
        let best = TIMES
            .iter()
            .filter_map(at)
            .fold(f64::NEG_INFINITY, f64::max);
        best - nothing.posterior.ln_evidence - (TIMES.len() as f64).ln()
    }

    /// What is left beside a set.
    pub fn rest(&self, bank: &Bank, fit: &Fit, whole: f64, judgement: &Judgement) -> Rest {
        let noise = fit.posterior.noise_variance.sqrt();
        let granted = GRANTED.hypot(judgement.formula_error * explained(bank, fit) / noise);
        let Some((base, _)) = self.beside(bank, fit, granted) else {
            return Rest::default();
        };
        let mut best: Option<(f64, DVector<f64>)> = None;
        for times in TIMES {
            if let Some((evidence, left)) = self.beside(bank, fit, granted * times)
                && best.as_ref().is_none_or(|b| b.0 < evidence)
            {
                best = Some((evidence, left));
            }
        }
        let Some((evidence, left)) = best else {
            return Rest::default();
        };
        let peaks: Vec<f64> = left.iter().map(|v| v.abs() / noise).collect();
        let share = rms(left.as_slice()) / whole.max(f64::MIN_POSITIVE);
        let nats = (evidence - base).max(0.0);
        let is_left = nats > judgement.left_nats
            && quantile(&peaks, 0.98) > judgement.left_peak
            && share > judgement.left_share;
        Rest {
            nats,
            share,
            is_left,
        }
    }
}

/// Rms of what a set explains, whitened.
fn explained(bank: &Bank, fit: &Fit) -> f64 {
    let mut at = 0;
    let mut sum = DVector::zeros(bank.whitened().len());
    for member in &fit.members {
        let count = bank.entries[*member].columns.len();
        let own: Vec<f64> = fit.posterior.mean.rows(at, count).iter().copied().collect();
        sum += bank.part(*member, &own);
        at += count;
    }
    rms(sum.as_slice())
}
