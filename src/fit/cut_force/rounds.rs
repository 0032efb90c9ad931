//! Rounds of descent: what the noise is, and which samples stand beside a jump, is told by the round before.

use super::CutData;
use super::descent::{Descent, Optimum};
use super::layout::Layout;
use super::repeated;
use super::start::{improve_teeth, start};
use super::steady::{Known, steady_samples};
use super::whitening::Whitening;
use crate::ground::spatial::{V3, add};
use nalgebra::DMatrix;
use rayon::prelude::*;

/// Lag of the edge along one disc in the last round, rad: at the face of the stock a chip ends within some hundredths. Discs of
/// 0.03 leave intervals that hold 90 % of the truth on cuts by a stranger, these 93 %.
const SLICED: f64 = 7.5e-3;
/// Rounds of noise and descent.
const ROUNDS: usize = 4;
/// Share of the squares that a step must be worth, while the noise is still being learned and in the end.
const ARRIVED: [f64; 2] = [1e-5, 1e-8];

/// Where the fit ends, and its covariance in SI; the samples that count are noted.
pub(super) fn descend(cuts: &mut [CutData], layout: &Layout) -> (Optimum, DMatrix<f64>) {
    let mut p = start(cuts, layout);
    let size = rms(cuts.iter().map(|cut| (cut, &cut.force)));
    let rough = 0.05 * size.iter().fold(0.0_f64, |m, v| m.max(*v)).max(1e-9);
    let mut whitening = Whitening::white(rough);
    let mut round = 0;
    loop {
        let descent = Descent {
            cuts,
            layout,
            whitening: &whitening,
        };
        round += 1;
        let found = descent.from(&p, ARRIVED[usize::from(round == ROUNDS)]);
        if round == ROUNDS {
            let covariance = repeated::widened(covariance(&found, layout), &descent, &found.p);
            return (found, covariance);
        }
        p = found.p;
        if round == 1 && improve_teeth(cuts, layout, &mut p) {
            continue;
        }
        leave_jumps(cuts, layout, &p);
        if round + 1 == ROUNDS {
            cuts.iter_mut().for_each(|c| c.scene.slice_rad = SLICED);
        }
        whitening = Whitening::of(cuts, &found.residuals);
    }
}

/// How well the angles of jumps are known while the rest is fitted, rad: a fit that was held by them stood up to a milliradian beside the
/// truth, and a degree is the step from which it starts. Of the runout, m: a tilt of the tool that no file states moves the tips by as much. Choices: no others were tried.
const HELD: Known = Known {
    turn_rad: 1e-2,
    runout_m: 2e-6,
    sloped: true,
};

/// Lets what stands beside a jump at `p` not count, but in a cut of which that would be most.
fn leave_jumps(cuts: &mut [CutData], layout: &Layout, p: &[f64]) {
    cuts.par_iter_mut().enumerate().for_each(|(i, cut)| {
        if cut.scene.is_direct() {
            let counts = steady_samples(&cut.scene, &layout.of_one(i, p), HELD);
            let few = counts.iter().filter(|c| **c).count() < counts.len() / 2;
            cut.counts = if few {
                vec![true; counts.len()]
            } else {
                counts
            };
        }
    });
}

/// Covariance in SI. A direction that the data leave open gets a spread beyond any bound.
fn covariance(fitted: &Optimum, layout: &Layout) -> DMatrix<f64> {
    let eigen = fitted.normal.clone().symmetric_eigen();
    let n = layout.len();
    let mut covariance = DMatrix::zeros(n, n);
    for (value, vector) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        let spread = 1.0 / value.max(1e-12);
        covariance += vector * vector.transpose() * spread;
    }
    let scale = |j: usize| layout.unknowns[j].scale;
    DMatrix::from_fn(n, n, |i, j| covariance[(i, j)] * scale(i) * scale(j))
}

/// Root mean square over the samples that count, by axis, of a wave per cut.
pub(super) fn rms<'a>(waves: impl Iterator<Item = (&'a CutData, &'a Vec<V3>)>) -> V3 {
    let counted = waves.flat_map(|(cut, wave)| cut.counted(wave));
    let (rows, squares) = counted.fold((0, [0.0; 3]), |(rows, sum), v| {
        (rows + 1, add(sum, v.map(|x| x * x)))
    });
    squares.map(|sum| (sum / f64::from(rows.max(1))).sqrt())
}
