//! What amounts can be: none below its lowest value, and no compliance negative about any axis.

use crate::causes::turns::{PLACES, SIX, matrix};
use crate::ground::stats::above;
use nalgebra::SymmetricEigen;

/// What bounds an amount.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// Its lowest value.
    Low(f64),
    /// It is of the matrix whose first column this is, one of the six.
    Of(usize, usize),
}

impl Bound {
    /// Lowest value of the amount alone.
    pub fn low(self) -> f64 {
        match self {
            Self::Low(low) => low,
            Self::Of(_, 0..3) => 0.0,
            Self::Of(..) => f64::MIN,
        }
    }
}

/// Amounts with their deviations before and after the data.
pub struct Bounded<'a> {
    /// Their bounds.
    pub bounds: &'a [Bound],
    /// Means after the data.
    pub mean: &'a [f64],
    /// Deviations before.
    pub before: &'a [f64],
    /// Deviation after the data of a weighted sum of amounts.
    pub after: &'a dyn Fn(&[f64]) -> f64,
}

impl Bounded<'_> {
    /// Logarithm of how much more probable the bounds are after the data than before.
    pub fn ln_kept(&self) -> f64 {
        let mut sum = 0.0;
        let mut at = 0;
        while at < self.bounds.len() {
            let same = |b: &&Bound| matches!((b, self.bounds[at]), (Bound::Of(a, _), Bound::Of(b, _)) if *a == b);
            let count = self.bounds[at..].iter().take_while(same).count().max(1);
            let shared = |b: &Bound| matches!(b, Bound::Of(_, 3..));
            let own = at..at + count;
            sum += match self.bounds[own.clone()].iter().any(shared) {
                true => self.of_matrix(own),
                false => own.map(|i| self.of_one(i)).sum(),
            };
            at += count;
        }
        sum
    }

    fn of_one(&self, i: usize) -> f64 {
        let mut unit = vec![0.0; self.mean.len()];
        unit[i] = 1.0;
        let low = self.bounds[i].low();
        let after = above((low - self.mean[i]) / (self.after)(&unit));
        ln(after / above(low / self.before[i]))
    }

    /// Along the principal axes of the mean: what is not negative there is so everywhere.
    fn of_matrix(&self, own: std::ops::Range<usize>) -> f64 {
        let mut six = [0.0; SIX];
        let place = |i: usize| match self.bounds[i] {
            Bound::Of(_, place) => place,
            Bound::Low(_) => 0,
        };
        own.clone().for_each(|i| six[place(i)] = self.mean[i]);
        let principal = SymmetricEigen::new(matrix(&six));
        let along = |k: usize| {
            let axis = principal.eigenvectors.column(k);
            let mut weights = vec![0.0; self.mean.len()];
            for i in own.clone() {
                let (a, b) = PLACES[place(i)];
                weights[i] = axis[a] * axis[b] * if a == b { 1.0 } else { 2.0 };
            }
            let before = weights.iter().zip(self.before);
            let before: f64 = before.map(|(w, s)| (w * s).powi(2)).sum();
            match before > 0.0 {
                true => ln(2.0 * above(-principal.eigenvalues[k] / (self.after)(&weights))),
                false => 0.0,
            }
        };
        (0..3).map(along).sum()
    }
}

fn ln(x: f64) -> f64 {
    x.max(1e-300).ln()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::turns::sizes;

    /// Six amounts known to one deviation each of `after`, nothing of them shared with one another.
    fn kept(mean: [f64; SIX], after: f64) -> f64 {
        let before = sizes(1.0);
        let bounds: Vec<Bound> = (0..SIX).map(|k| Bound::Of(4, k)).collect();
        let deviation = |weights: &[f64]| {
            let own = weights.iter().zip(&before);
            after * own.map(|(w, s)| (w * s).powi(2)).sum::<f64>().sqrt()
        };
        let bounded = Bounded {
            bounds: &bounds,
            mean: &mean,
            before: &before,
            after: &deviation,
        };
        bounded.ln_kept()
    }

    #[test]
    fn a_compliance_is_as_likely_in_any_frame() {
        let along_x = kept([1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 0.1);
        let oblique = kept([0.36, 0.0, 0.64, 0.0, 0.48, 0.0], 0.1);
        assert!((along_x - oblique).abs() < 1e-9, "{along_x} {oblique}");
    }

    #[test]
    fn what_would_be_negative_somewhere_is_none() {
        let shared = kept([1.0, 0.0, 0.0, 0.0, 0.0, 1.0], 0.05);
        assert!(shared < -30.0, "{shared}");
    }
}
