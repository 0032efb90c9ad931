//! What every amount does to the readings, in standard deviations: slopes, then levels. What is about one
//! point holds the rows of that point alone, so that memory goes with the points, not with their square.

use super::patterns::{Pattern, Slopes};
use crate::fit::weighing::Weighing;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// One amount.
pub enum Rows {
    /// Of everybody who acts at all points: slopes, and levels where the curve bends.
    Wide(DVector<f64>, Option<DVector<f64>>),
    /// Of the point: row and number, in order.
    Local(usize, Vec<(usize, f64)>),
}

/// The columns of all seats.
pub struct Columns {
    all: Vec<Rows>,
    slopes: usize,
    levels: usize,
}

impl Columns {
    /// Of patterns, with `levels` rows after the slopes.
    pub fn of<'a>(
        patterns: impl Iterator<Item = &'a Pattern>,
        weighing: &Weighing,
        levels: usize,
    ) -> Self {
        let rows = |pattern: &Pattern| match &pattern.slopes {
            Slopes::At(point, own) => Rows::Local(*point, weighing.whiten_at(*point, own)),
            Slopes::Everywhere(all) => {
                let bent = !pattern.left.is_empty();
                let tail = bent.then(|| DVector::from_column_slice(&pattern.left));
                Rows::Wide(weighing.whiten(|p, d| all[p][d]), tail)
            }
        };
        Self {
            all: patterns.map(rows).collect(),
            slopes: weighing.len(),
            levels,
        }
    }

    /// Of rows, with so many slopes and levels.
    #[cfg(test)]
    pub fn new(all: Vec<Rows>, [slopes, levels]: [usize; 2]) -> Self {
        Self {
            all,
            slopes,
            levels,
        }
    }

    /// Of slopes alone.
    pub fn wide(columns: Vec<DVector<f64>>) -> Self {
        Self {
            slopes: columns.first().map_or(0, DVector::len),
            levels: 0,
            all: columns.into_iter().map(|c| Rows::Wide(c, None)).collect(),
        }
    }

    /// One after the other.
    pub fn all(&self) -> &[Rows] {
        &self.all
    }

    /// Rows of slopes.
    pub fn slopes(&self) -> usize {
        self.slopes
    }

    /// A column over all rows.
    pub fn column(&self, at: usize) -> DVector<f64> {
        let mut full = DVector::zeros(self.slopes + self.levels);
        match &self.all[at] {
            Rows::Wide(slopes, tail) => {
                full.rows_mut(0, self.slopes).copy_from(slopes);
                if let Some(tail) = tail {
                    full.rows_mut(self.slopes, self.levels).copy_from(tail);
                }
            }
            Rows::Local(_, own) => own.iter().for_each(|(row, x)| full[*row] = *x),
        }
        full
    }

    /// Products with the readings.
    pub fn gradient(&self, readings: &DVector<f64>) -> DVector<f64> {
        let product = |rows: &Rows| match rows {
            Rows::Wide(slopes, tail) => {
                let bends = tail.as_ref();
                let bends = bends.map_or(0.0, |t| t.dot(&readings.rows(self.slopes, self.levels)));
                slopes.dot(&readings.rows(0, self.slopes)) + bends
            }
            Rows::Local(_, own) => own.iter().map(|(row, x)| x * readings[*row]).sum(),
        };
        DVector::from_iterator(self.all.len(), self.all.iter().map(product))
    }

    /// What the springs take of every column: L⁻¹Bᵀc, with LLᵀ their curvature and B their columns.
    pub fn taken(&self, springs: &DMatrix<f64>, root: &Cholesky<f64, Dyn>) -> DMatrix<f64> {
        let mut cross = DMatrix::zeros(springs.ncols(), self.all.len());
        let head = springs.rows(0, self.slopes);
        for (j, rows) in self.all.iter().enumerate() {
            match rows {
                Rows::Wide(slopes, _) => cross.set_column(j, &head.tr_mul(slopes)),
                Rows::Local(_, own) => own.iter().for_each(|(row, x)| {
                    cross
                        .column_mut(j)
                        .axpy(*x, &head.row(*row).transpose(), 1.0)
                }),
            }
        }
        root.l_dirty().solve_lower_triangular_mut(&mut cross);
        cross
    }
}
