//! Whether a response that bends depends on its drive: a law learnt on the other ramps foretells each ramp beyond chance.
//!
//! The law is any mix of curves over the drive and of what follows it at a distance. What chance does on one ramp says
//! nothing of the next, so that what is foretold of it has as often the wrong sign as the right one; the slopes of the
//! response over what was foretold are then tested as those over the drive are.

use super::agreement::of_slopes;
use super::relation::cells;
use crate::signal::play::play;
use nalgebra::{DMatrix, DVector};

/// Width of the bend of a gap, and of what follows at a distance, as shares of the largest drive.
const GAP: f64 = 0.08;
const PLAYS: [f64; 3] = [0.1, 0.3, 0.6];
/// Added to the squares of every curve, as a share of their mean: curves that are alike on few ramps.
const RIDGE: f64 = 1e-6;

/// One ramp: the curves and the response, each less its mean.
struct Piece {
    curves: DMatrix<f64>,
    response: DVector<f64>,
}

/// Probability that chance foretells the ramps so well.
pub fn p_value(ramps: &[(usize, usize)], drive: &[f64], response: &[f64]) -> f64 {
    let curves = curves(drive);
    let each = ramps.iter().map(|ramp| Piece::of(*ramp, &curves, response));
    let pieces: Vec<Piece> = each.filter(|p| p.response.len() > 1).collect();
    let own = pieces
        .iter()
        .map(|p| (p.curves.tr_mul(&p.curves), p.curves.tr_mul(&p.response)));
    let own: Vec<(DMatrix<f64>, DVector<f64>)> = own.collect();
    let size = curves.len();
    let none = (DMatrix::zeros(size, size), DVector::zeros(size));
    let all = own
        .iter()
        .fold(none, |sum, one| (sum.0 + &one.0, sum.1 + &one.1));
    let foretold = |(piece, own): (&Piece, &(DMatrix<f64>, DVector<f64>))| {
        let mut others = &all.0 - &own.0;
        let ridge = RIDGE * others.trace() / size as f64;
        (0..size).for_each(|i| others[(i, i)] += ridge);
        let law = others.cholesky()?.solve(&(&all.1 - &own.1));
        let told = &piece.curves * law;
        let weight = told.norm_squared();
        (weight > 0.0).then(|| (told.dot(&piece.response) / weight, weight))
    };
    let slopes: Vec<(f64, f64)> = pieces.iter().zip(&own).filter_map(foretold).collect();
    match of_slopes(&slopes) {
        // what goes against what was foretold is no law
        (mean, p) if mean > 0.0 => p,
        _ => 1.0,
    }
}

/// Curves over the drive, and of what follows it.
fn curves(drive: &[f64]) -> Vec<Vec<f64>> {
    let largest = drive.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let unit: Vec<f64> = drive
        .iter()
        .map(|d| d / largest.max(f64::MIN_POSITIVE))
        .collect();
    let over: [fn(f64) -> f64; 4] = [|u| u, f64::abs, |u| u * u.abs(), |u| (u / GAP).tanh()];
    let curves = over.iter().map(|f| unit.iter().map(|u| f(*u)).collect());
    let following = PLAYS.iter().map(|width| play(&unit, *width));
    curves.chain(following).collect()
}

impl Piece {
    fn of(ramp: (usize, usize), curves: &[Vec<f64>], response: &[f64]) -> Self {
        let cells = cells(&[ramp], response.len());
        let part = |v: &[f64]| {
            let of = |c: &(usize, usize)| v[c.0..c.1].iter().sum::<f64>() / (c.1 - c.0) as f64;
            let own = DVector::from_iterator(cells.len(), cells.iter().map(of));
            let mean = own.mean();
            own.add_scalar(-mean)
        };
        let columns: Vec<DVector<f64>> = curves.iter().map(|c| part(c)).collect();
        Self {
            curves: DMatrix::from_columns(&columns),
            response: part(response),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::suitability::relation::{Relation, ramps};
    use crate::ground::random::Random;

    /// Triangles from zero that grow from cycle to cycle.
    fn growing(rows: usize) -> Vec<f64> {
        let tips = [0.0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1.0, -1.0, 0.0];
        let at = |i: usize| {
            let x = i as f64 * (tips.len() - 1) as f64 / rows as f64;
            let k = (x as usize).min(tips.len() - 2);
            tips[k] + (tips[k + 1] - tips[k]) * (x - k as f64)
        };
        (0..rows).map(at).collect()
    }

    #[test]
    fn a_wide_gap_under_growing_loads_is_a_response() {
        let mut random = Random::new(2);
        let load = growing(720);
        let shapes: [fn(f64) -> f64; 2] = [
            |u| u + 1.2 * (u / 0.003).tanh(),
            |u| u + 1.2 * u.abs().powf(1.5),
        ];
        for shape in shapes {
            let read: Vec<f64> = load
                .iter()
                .map(|u| shape(*u) + 0.004 * random.normal())
                .collect();
            let found = Relation::of(&load, &read);
            assert!(found.is_real(), "{found:?}");
        }
    }

    #[test]
    fn walks_and_slow_noise_under_growing_loads_are_none() {
        let load = growing(720);
        let p = ramps(&load);
        let taken = (0..400).filter(|seed| {
            let mut random = Random::new(*seed);
            let memory = if seed % 2 == 0 { 1.0 } else { 0.97 };
            let mut at = 0.0;
            let mut step = || {
                at = memory * at + random.normal();
                at
            };
            let walk: Vec<f64> = (0..720).map(|_| step()).collect();
            2.0 * p_value(&p, &load, &walk) < 1e-3
        });
        let taken = taken.count();
        assert!(taken <= 1, "{taken} of 400");
    }
}
