//! Whether structure is left that no named cause makes: generic columns beside the set, by evidence, and
//! only where what they find is material.

use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use super::statement::Statement;
use crate::inference::gaussian::{Products, Size, update};
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

    /// A set with generic structure beside it: products once, for any size of the structure.
    fn beside(&self, bank: &Bank, fit: &Fit) -> Beside {
        let own = fit.members.iter().zip(&fit.posterior.sizes);
        let blocks: Vec<(usize, Size)> = own
            .map(|(m, size)| (bank.entries[*m].columns.len(), Size::Given(*size)))
            .collect();
        Beside {
            products: bank.beside(&fit.members, &self.columns),
            before: blocks.iter().map(|b| b.0).sum(),
            blocks,
        }
    }

    /// Greatest evidence of a set with generic structure beside it.
    pub fn best(&self, bank: &Bank, fit: &Fit) -> f64 {
        let beside = self.beside(bank, fit);
        let at = |times: &f64| beside.at(bank, self, GRANTED * times).map(|f| f.0);
        TIMES
            .iter()
            .filter_map(at)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// What is left beside a set.
    pub fn rest(&self, bank: &Bank, fit: &Fit, whole: f64, judgement: &Judgement) -> Rest {
        let noise = fit.posterior.noise_variance.sqrt();
        let granted = GRANTED.hypot(judgement.formula_error * explained(bank, fit) / noise);
        let beside = self.beside(bank, fit);
        let Some((base, _)) = beside.at(bank, self, granted) else {
            return Rest::default();
        };
        let tried = TIMES
            .iter()
            .filter_map(|times| beside.at(bank, self, granted * times));
        let best = tried.reduce(|a, b| if b.0 > a.0 { b } else { a });
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

/// A set and the generic columns.
struct Beside {
    products: Products,
    blocks: Vec<(usize, Size)>,
    before: usize,
}

impl Beside {
    /// Evidence with so much structure, and that structure, whitened.
    fn at(&self, bank: &Bank, span: &Span, size: f64) -> Option<(f64, DVector<f64>)> {
        let mut blocks = self.blocks.clone();
        blocks.push((span.columns.ncols(), Size::Given(size)));
        let found = update(&self.products, &bank.reading, &blocks)?;
        let amounts = found.mean.rows(self.before, span.columns.ncols());
        Some((found.ln_evidence, &span.columns * amounts))
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
