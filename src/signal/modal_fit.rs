//! A structure fitted to FRFs by weighted least squares; what lies outside the band is eliminated
//! (variable projection, Golub and Pereyra 1973).

use super::modal_kernel::{Columns, Lines};
use super::modal_model::{Channels, stacked};
use super::modal_structure::{Row, Structure};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, QR};
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// Powers of `s` with a real factor per channel beside the modes: rigid motion below the band, and
/// the series of the modes above it, even powers for their stiffness, odd ones for their damping.
const RESIDUALS: [i32; 4] = [0, 2, 3, 4];

/// FRFs made ready: weighted, without the part that the terms of `RESIDUALS` explain.
pub struct Task<'a> {
    /// The FRFs.
    pub channels: &'a Channels,
    lines: Lines,
    /// Weights per channel, for real and imaginary parts.
    weight: Vec<Vec<f64>>,
    /// Orthonormal columns of the residual terms per channel.
    outside: Vec<DMatrix<f64>>,
    /// The rest of the data per channel.
    pub target: Vec<DVector<f64>>,
}

/// A structure with what it leaves.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The structure.
    pub structure: Structure,
    /// Weighted sum of squares of what is left.
    pub cost: f64,
}

/// The normal equations at a structure.
pub struct Normal {
    /// `JᵀJ`.
    pub matrix: DMatrix<f64>,
    /// `Jᵀr`.
    pub slope: DVector<f64>,
}

impl<'a> Task<'a> {
    /// Prepares `channels`.
    pub fn new(channels: &'a Channels) -> Self {
        let count = channels.frf.len();
        let outside: Vec<_> = (0..count).map(|c| outside(channels, c)).collect();
        let mut task = Self {
            channels,
            lines: Lines::new(channels),
            weight: channels.weight.iter().map(|w| w.repeat(2)).collect(),
            outside,
            target: Vec::new(),
        };
        task.target = (0..count)
            .map(|c| task.weighted(c, &channels.frf[c]))
            .collect();
        task
    }

    /// The same task with what is left as data.
    pub fn of_rest(&self, rest: &[DVector<f64>]) -> Self {
        Self {
            channels: self.channels,
            lines: self.lines.clone(),
            weight: self.weight.clone(),
            outside: self.outside.clone(),
            target: rest.to_vec(),
        }
    }

    /// A complex column as channel `c` sees it.
    pub fn weighted(&self, c: usize, column: &[Complex64]) -> DVector<f64> {
        self.free(
            c,
            DVector::from_vec(stacked(column, &self.channels.weight[c])),
        )
    }

    /// A weighted column of channel `c` without the residual terms.
    fn free(&self, c: usize, column: DVector<f64>) -> DVector<f64> {
        let inside = self.outside[c].tr_mul(&column);
        column - &self.outside[c] * inside
    }

    /// The columns of all poles per input: `[input][mode]`.
    pub fn columns(&self, poles: &[Complex64]) -> Vec<Vec<Columns>> {
        let first = |pole: &Complex64| self.lines.columns(*pole, 0);
        let first: Vec<Columns> = poles.par_iter().map(first).collect();
        let of = |input: usize| {
            let one = |(pole, first): (&Complex64, &Columns)| match self.lines.sees_end(*pole) {
                true if input > 0 => self.lines.columns(*pole, input),
                _ => first.clone(),
            };
            poles.par_iter().zip(&first).map(one).collect()
        };
        (0..self.channels.shape.0).map(of).collect()
    }

    /// Weighted columns of residues, and of slopes if asked for, of the modes in channel `c`.
    fn raw(&self, c: usize, columns: &[Vec<Columns>], slopes: bool) -> DMatrix<f64> {
        let weight = &self.weight[c];
        let take = if slopes { 4 } else { 2 };
        let of = &columns[c / self.channels.shape.1];
        let mut matrix = DMatrix::zeros(weight.len(), take * of.len());
        let all = of.iter().flat_map(|columns| &columns[..take]);
        let places = matrix.as_mut_slice().chunks_exact_mut(weight.len());
        for (place, column) in places.zip(all) {
            for ((place, value), weight) in place.iter_mut().zip(column).zip(weight) {
                *place = value * weight;
            }
        }
        matrix
    }

    /// The same without the residual terms.
    pub fn basis(&self, c: usize, columns: &[Vec<Columns>], slopes: bool) -> DMatrix<f64> {
        let mut matrix = self.raw(c, columns, slopes);
        let inside = self.outside[c].tr_mul(&matrix);
        matrix.gemm(-1.0, &self.outside[c], &inside, 1.0);
        matrix
    }

    /// What `structure` leaves in every channel.
    pub fn rest(&self, structure: &Structure) -> Vec<DVector<f64>> {
        self.rest_of(structure, &self.columns(&structure.poles))
    }

    fn rest_of(&self, structure: &Structure, columns: &[Vec<Columns>]) -> Vec<DVector<f64>> {
        let rest = |c: usize| {
            let mut sum = DVector::zeros(self.weight[c].len());
            for (r, columns) in columns[c / self.channels.shape.1].iter().enumerate() {
                let a = structure.residue(r, c);
                let pairs = columns[0].iter().zip(&columns[1]);
                for (sum, (real, imaginary)) in sum.iter_mut().zip(pairs) {
                    *sum += real * a.re + imaginary * a.im;
                }
            }
            let weighted = sum.iter_mut().zip(&self.weight[c]);
            weighted.for_each(|(sum, weight)| *sum *= weight);
            &self.target[c] - self.free(c, sum)
        };
        (0..self.target.len()).map(rest).collect()
    }

    /// `structure` with what it leaves.
    pub fn fit(&self, structure: Structure) -> Fit {
        let rest = self.rest(&structure);
        Fit {
            structure,
            cost: rest.iter().map(|r| r.norm_squared()).sum(),
        }
    }

    /// The normal equations, with the slope of `rest`, which has no residual terms.
    pub fn normal(&self, structure: &Structure, rest: &[DVector<f64>]) -> Normal {
        self.normal_of(structure, &self.columns(&structure.poles), rest)
    }

    fn normal_of(
        &self,
        structure: &Structure,
        columns: &[Vec<Columns>],
        rest: &[DVector<f64>],
    ) -> Normal {
        let n = structure.parameters();
        let part = |c: usize| {
            let raw = self.raw(c, columns, true);
            let inside = self.outside[c].tr_mul(&raw);
            let mut gram = raw.transpose() * &raw;
            gram.gemm_tr(-1.0, &inside, &inside, 1.0);
            (gram, raw.tr_mul(&rest[c]))
        };
        let parts: Vec<_> = (0..rest.len()).into_par_iter().map(part).collect();
        let mut normal = Normal {
            matrix: DMatrix::zeros(n, n),
            slope: DVector::zeros(n),
        };
        for (c, (gram, slope)) in parts.iter().enumerate() {
            normal.add(structure, c, gram, slope);
        }
        normal
    }

    /// Levenberg-Marquardt from `start`, at most `steps`, until one gains less than the share `enough`.
    pub fn refine(&self, start: Structure, (steps, enough): (usize, f64)) -> Fit {
        let mut best = self.state(start);
        let mut brake = 1e-4;
        for _ in 0..steps {
            let normal = self.normal_of(&best.structure, &best.columns, &best.rest);
            let before = best.cost;
            while brake < 1e6 {
                let step = normal.solve(brake);
                let trial = step.and_then(|step| best.structure.stepped(step.as_slice()));
                match trial.map(|trial| self.state(trial)) {
                    Some(trial) if trial.cost < best.cost => {
                        best = trial;
                        brake = (brake * 0.1).max(1e-8);
                        break;
                    }
                    _ => brake *= 10.0,
                }
            }
            if before - best.cost <= enough * before {
                break;
            }
        }
        Fit {
            structure: best.structure,
            cost: best.cost,
        }
    }

    fn state(&self, structure: Structure) -> State {
        let columns = self.columns(&structure.poles);
        let rest = self.rest_of(&structure, &columns);
        State {
            cost: rest.iter().map(|r| r.norm_squared()).sum(),
            structure,
            columns,
            rest,
        }
    }
}

/// A structure on its way, with what the next step needs.
struct State {
    structure: Structure,
    cost: f64,
    columns: Vec<Vec<Columns>>,
    rest: Vec<DVector<f64>>,
}

impl Normal {
    fn add(&mut self, structure: &Structure, c: usize, gram: &DMatrix<f64>, slope: &DVector<f64>) {
        let rows = structure.rows(c);
        Self::add_slope(&mut self.slope, &rows, slope);
        for (a, left) in &rows {
            let mut across = DVector::zeros(gram.nrows());
            for (column, factor) in left {
                across.axpy(*factor, &gram.column(*column), 1.0);
            }
            for (b, right) in &rows {
                let sum: f64 = right.iter().map(|(k, factor)| factor * across[*k]).sum();
                self.matrix[(*a, *b)] += sum;
            }
        }
    }

    /// Adds what the basis of a channel says to the slope of the parameters.
    pub fn add_slope(sum: &mut DVector<f64>, rows: &[Row], slope: &DVector<f64>) {
        for (a, row) in rows {
            let parts = row.iter().map(|(column, factor)| factor * slope[*column]);
            sum[*a] += parts.sum::<f64>();
        }
    }

    /// The factors of the matrix with its diagonal raised by the share `brake`.
    pub fn factor(&self, brake: f64) -> Option<Cholesky<f64, Dyn>> {
        let mut damped = self.matrix.clone();
        for i in 0..damped.nrows() {
            damped[(i, i)] = damped[(i, i)].max(1e-300) * (1.0 + brake);
        }
        damped.cholesky()
    }

    /// The inverse; where scales may move between factors, or modes cannot be told apart, with as
    /// small a brake as it takes.
    pub fn inverse(&self) -> Option<DMatrix<f64>> {
        let mut factors = [1e-10, 1e-9, 1e-8, 1e-7]
            .into_iter()
            .map(|brake| self.factor(brake));
        factors.find_map(|factor| factor.map(|f| f.inverse()))
    }

    fn solve(&self, brake: f64) -> Option<DVector<f64>> {
        Some(self.factor(brake)?.solve(&self.slope))
    }
}

/// An orthonormal basis of the residual terms as channel `c` weighs them.
fn outside(channels: &Channels, c: usize) -> DMatrix<f64> {
    let top = channels.s(channels.lines() - 1).norm();
    let term = |power: &i32| -> Vec<Complex64> {
        (0..channels.lines())
            .map(|k| (channels.s(k) / top).powi(*power))
            .collect()
    };
    let columns: Vec<f64> = RESIDUALS
        .iter()
        .flat_map(|power| stacked(&term(power), &channels.weight[c]))
        .collect();
    let matrix = DMatrix::from_vec(2 * channels.lines(), RESIDUALS.len(), columns);
    QR::new(matrix).q()
}
