//! Whether structure is left that no named cause makes: generic columns beside the set, by evidence, and
//! only where what they find is material.

use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use super::materiality::in_noise;
use super::statement::Statement;
use crate::ground::products::gram;
use crate::ground::stats::{quantile, rms};
use crate::inference::gaussian::{Products, evidence};
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
    /// Times the noise by which it scatters, where that alone makes it count.
    pub scatter: Option<f64>,
}

impl Rest {
    /// The same where patterns beside the causes have this share of the misfit.
    pub(super) fn with(self, share: f64, judgement: &Judgement) -> Self {
        match share > 0.0 {
            true => Self {
                // a pattern that was chosen paid its price
                nats: self.nats.max(judgement.left_nats),
                share: self.share.max(share),
                is_left: true,
                scatter: None,
            },
            false => self,
        }
    }

    /// The same where what is left scatters by so many times the stated noise.
    pub(super) fn scattering(self, noise: f64, judgement: &Judgement) -> Self {
        match noise > judgement.noise_beyond {
            true => Self {
                nats: self.nats.max(judgement.left_nats),
                is_left: true,
                scatter: (!self.is_left).then_some(noise),
                ..self
            },
            false => self,
        }
    }
}

/// Structure that is always granted, noise deviations rms: digits and filters leave no less.
const GRANTED: f64 = 0.15;
/// How much more than granted is tried.
const TIMES: [f64; 9] = [1.5, 2.3, 3.5, 5.0, 8.0, 12.0, 20.0, 50.0, 150.0];

/// The generic columns of a statement, of one noise deviation rms together.
pub struct Span<'a> {
    statement: &'a Statement,
    /// Whitened.
    columns: DMatrix<f64>,
    /// Their products with one another.
    gram: DMatrix<f64>,
    /// By which they were multiplied.
    scale: f64,
}

impl<'a> Span<'a> {
    /// `None` where the kind states none.
    pub fn of(statement: &'a Statement) -> Option<Self> {
        let white = |c: &Vec<f64>| DVector::from_vec(statement.noise.whiten(c));
        let columns: Vec<DVector<f64>> = statement.span.iter().map(white).collect();
        let square: f64 = columns.iter().map(DVector::norm_squared).sum();
        if columns.is_empty() || square <= 0.0 {
            return None;
        }
        let scale = (statement.reading.len() as f64 / square).sqrt();
        let columns = DMatrix::from_columns(&columns) * scale;
        Some(Self {
            gram: gram(&columns),
            columns,
            statement,
            scale,
        })
    }

    /// A set with generic structure of any size beside it.
    fn beside<'b>(&'b self, bank: &'b Bank, fit: &Fit) -> Beside<'b> {
        let own = fit.members.iter().zip(&fit.posterior.sizes);
        Beside {
            products: bank.beside(&fit.members, (&self.columns, &self.gram)),
            blocks: own
                .map(|(m, size)| (bank.entries[*m].columns.len(), *size))
                .collect(),
            bank,
            columns: &self.columns,
        }
    }

    /// Greatest ln E of a set with structure of some sizes (noise deviations rms) beside it.
    pub fn greatest(&self, bank: &Bank, fit: &Fit, sizes: &[f64]) -> f64 {
        let beside = self.beside(bank, fit);
        let each = sizes.iter().filter_map(|s| beside.evidence(*s));
        each.map(|e| e.0).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Greatest ln E of a set with structure of any size beside it.
    pub fn best(&self, bank: &Bank, fit: &Fit) -> f64 {
        self.greatest(bank, fit, &TIMES.map(|times| GRANTED * times))
    }

    /// What amounts of the columns, the set's before them, make of the readings, in noise deviations of one.
    fn structure(&self, amounts: &DVector<f64>) -> Vec<f64> {
        let count = self.columns.ncols();
        let own = amounts.rows(amounts.len() - count, count);
        let mut sum = vec![0.0; self.columns.nrows()];
        for (column, amount) in self.statement.span.iter().zip(own.iter()) {
            let each = sum.iter_mut().zip(column);
            each.for_each(|(s, c)| *s += self.scale * amount * c);
        }
        in_noise(self.statement, &sum)
    }

    /// What is left beside a set; `whole`: rms of the misfit, and of that beside levels, noise deviations.
    pub fn rest(
        &self,
        bank: &Bank,
        fit: &Fit,
        (whole, bent): (f64, f64),
        judgement: &Judgement,
    ) -> Rest {
        let beside = self.beside(bank, fit);
        // beside structure of any size: without it, what is left would pass for noise and be small beside it
        let noise = beside.noise();
        let granted = GRANTED.hypot(judgement.formula_error * explained(bank, fit) / noise);
        let Some((base, _)) = beside.evidence(granted) else {
            return Rest::default();
        };
        let each = TIMES.iter().filter_map(|t| beside.evidence(granted * t));
        let best = each.max_by(|a, b| a.0.total_cmp(&b.0));
        let best = best.map(|(evidence, amounts)| (evidence, self.structure(&amounts)));
        let Some((evidence, left)) = best else {
            return Rest::default();
        };
        let peaks: Vec<f64> = left.iter().map(|v| v.abs() / noise).collect();
        let share = |whole: f64| rms(&left) / whole.max(f64::MIN_POSITIVE);
        let nats = (evidence - base).max(0.0);
        let is_left = nats > judgement.left_nats
            && quantile(&peaks, 0.98) > judgement.left_peak
            && share(bent) > judgement.left_share;
        Rest {
            nats,
            share: share(whole),
            is_left,
            scatter: None,
        }
    }
}

/// A set and generic structure beside it.
struct Beside<'a> {
    products: Products,
    /// Columns and size of every member.
    blocks: Vec<(usize, f64)>,
    bank: &'a Bank<'a>,
    columns: &'a DMatrix<f64>,
}

impl Beside<'_> {
    /// ln E with structure of this size, and all amounts, those of the structure last.
    fn evidence(&self, size: f64) -> Option<(f64, DVector<f64>)> {
        let mut blocks = self.blocks.clone();
        blocks.push((self.columns.ncols(), size));
        let (mean, ln_evidence) = evidence(&self.products, &self.bank.reading, &blocks)?;
        Some((ln_evidence, mean))
    }

    /// Deviation of the noise, of that stated, where structure of any size may stand beside the set.
    fn noise(&self) -> f64 {
        let each = TIMES.iter().filter_map(|t| self.evidence(GRANTED * t));
        let best = each.max_by(|a, b| a.0.total_cmp(&b.0));
        let taken = best.map_or(0.0, |(_, mean)| self.products.right.dot(&mean));
        let reading = &self.bank.reading;
        reading.noise_variance(reading.square - taken).sqrt()
    }
}

/// Rms of what a set explains whose law may be wrong, whitened.
pub(super) fn explained(bank: &Bank, fit: &Fit) -> f64 {
    let mut at = 0;
    let mut sum = DVector::zeros(bank.whitened().len());
    for member in &fit.members {
        let count = bank.entries[*member].columns.len();
        let own: Vec<f64> = fit.posterior.mean.rows(at, count).iter().copied().collect();
        at += count;
        if !bank.suspect(*member).is_level() {
            sum += bank.part(*member, &own);
        }
    }
    rms(sum.as_slice())
}
