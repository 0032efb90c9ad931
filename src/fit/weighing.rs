//! How much each measured slope of a workspace test counts: scatter of the readings, and the
//! repeatability of the set-up as one factor that its displacements share.

use super::force_steps::{Setup, quantile};
use super::parameter::Z95;
use crate::experiments::workspace::{Response, Site};
use crate::ground::spatial::{M3, V3};
use nalgebra::{DMatrix, DVector};

/// The measured components of one set-up with the transform that whitens them.
#[derive(Debug, Clone)]
struct Block {
    point: usize,
    direction: usize,
    components: Vec<usize>,
    slopes: DVector<f64>,
    variances: Vec<f64>,
    /// Deviation that is put up with in every component, m/N.
    tolerance: f64,
    /// What the shared factor was last taken about.
    mean: DVector<f64>,
    whitener: DMatrix<f64>,
}

/// All set-ups of a test.
#[derive(Debug, Clone)]
pub struct Weighing {
    blocks: Vec<Block>,
    repeatability: f64,
}

impl Weighing {
    /// Of the lines of a test; the shared factor is first taken about the measured slopes.
    pub fn new(setups: &[Setup], repeatability: f64) -> Self {
        let blocks = setups.iter().map(|setup| {
            let lines = (0..3).filter_map(|k| Some((k, setup.lines[k]?)));
            let lines: Vec<_> = lines.collect();
            let variance = |stderr: f64, freedom| (stderr * quantile(freedom) / Z95).powi(2);
            Block {
                point: setup.point,
                direction: setup.direction,
                components: lines.iter().map(|(k, _)| *k).collect(),
                slopes: DVector::from_iterator(lines.len(), lines.iter().map(|(_, l)| l.slope)),
                variances: lines
                    .iter()
                    .map(|(_, l)| variance(l.stderr, l.freedom))
                    .collect(),
                tolerance: 0.0,
                mean: DVector::zeros(lines.len()),
                whitener: DMatrix::zeros(lines.len(), lines.len()),
            }
        });
        let mut weighing = Self {
            blocks: blocks
                .filter(|b: &Block| !b.components.is_empty())
                .collect(),
            repeatability,
        };
        let measured: Vec<DVector<f64>> =
            weighing.blocks.iter().map(|b| b.slopes.clone()).collect();
        weighing.about(&measured);
        weighing
    }

    /// Takes the shared factor about what a model predicts: the measured slopes carry the factor
    /// themselves and would favour set-ups that came out soft.
    pub fn about_model(&mut self, response: &Response, compliances: &[f64]) {
        self.about_slopes(|point, direction| response.slope(point, direction, compliances));
    }

    /// Takes the shared factor about these slopes, m/N by point and direction.
    pub fn about_slopes(&mut self, slope: impl Fn(usize, usize) -> V3) {
        let of = |b: &Block| b.pick(&slope(b.point, b.direction));
        let predicted: Vec<DVector<f64>> = self.blocks.iter().map(of).collect();
        self.about(&predicted);
    }

    /// Puts up with a deviation in every component, m/N by point and direction: no model is exact.
    /// It counts from the next time that the shared factor is taken about something.
    pub fn tolerate(&mut self, deviation: impl Fn(usize, usize) -> f64) {
        for block in &mut self.blocks {
            block.tolerance = deviation(block.point, block.direction);
        }
    }

    /// The same with so many times the deviation that is put up with.
    pub fn tolerating(&self, times: f64) -> Self {
        let mut other = self.clone();
        other.blocks.iter_mut().for_each(|b| b.tolerance *= times);
        let means: Vec<DVector<f64>> = self.blocks.iter().map(|b| b.mean.clone()).collect();
        other.about(&means);
        other
    }

    /// Logarithm of the density of a row of zeros that is whitened so, but for a constant.
    pub fn ln_density(&self) -> f64 {
        let own = |b: &Block| {
            b.whitener
                .diagonal()
                .iter()
                .map(|x| x.abs().ln())
                .sum::<f64>()
        };
        self.blocks.iter().map(own).sum()
    }

    /// Rows that `other` whitened, whitened by this.
    pub fn again(&self, other: &Self, rows: &[f64]) -> DVector<f64> {
        let raw = other.colour(rows);
        let mut first = 0;
        let all = self.blocks.iter().flat_map(|b| {
            let n = b.components.len();
            let own = DVector::from_column_slice(&raw[first..first + n]);
            first += n;
            (&b.whitener * own).data.as_vec().clone()
        });
        DVector::from_vec(all.collect())
    }

    fn about(&mut self, shared: &[DVector<f64>]) {
        for (block, mean) in self.blocks.iter_mut().zip(shared) {
            block.mean = mean.clone();
            let floor = 1e-12 * mean.norm_squared().max(block.slopes.norm_squared());
            let mut covariance = mean * mean.transpose() * self.repeatability.powi(2);
            for (k, variance) in block.variances.iter().enumerate() {
                covariance[(k, k)] += variance.max(floor) + block.tolerance.powi(2);
            }
            let n = block.variances.len();
            if let Some(root) = covariance.cholesky() {
                let unit = DMatrix::identity(n, n);
                block.whitener = root.l().solve_lower_triangular(&unit).unwrap_or(unit);
            }
        }
    }

    /// Number of measured slopes.
    pub fn len(&self) -> usize {
        self.blocks.iter().map(|b| b.components.len()).sum()
    }

    /// Whether nothing was measured.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Standard deviation of every slope about any model, m/N, by set-up and component; NaN where
    /// it was not measured.
    pub fn deviations(&self) -> Vec<[f64; 3]> {
        let of = |b: &Block| {
            let mut out = [f64::NAN; 3];
            let inverse = b.whitener.clone().try_inverse();
            for (i, k) in b.components.iter().enumerate() {
                out[*k] = inverse.as_ref().map_or(f64::NAN, |l| l.row(i).norm());
            }
            out
        };
        self.blocks.iter().map(of).collect()
    }

    /// The whitened slopes.
    pub fn measured(&self) -> DVector<f64> {
        let all = self.blocks.iter().map(|b| &b.whitener * &b.slopes);
        DVector::from_vec(
            all.flat_map(|v| v.iter().copied().collect::<Vec<_>>())
                .collect(),
        )
    }

    /// Slopes of every point and direction, m/N, whitened and in a row.
    pub fn whiten(&self, slope: impl Fn(usize, usize) -> V3) -> DVector<f64> {
        let own = |b: &Block| &b.whitener * b.pick(&slope(b.point, b.direction));
        let all = self
            .blocks
            .iter()
            .flat_map(|b| own(b).data.as_vec().clone());
        DVector::from_vec(all.collect())
    }

    /// The numbers of [`Self::whiten`] that the slopes of one point (m/N by direction) make, with their
    /// places.
    pub fn whiten_at(&self, point: usize, slopes: &M3) -> Vec<(usize, f64)> {
        let mut found = Vec::with_capacity(9);
        let mut first = 0;
        for block in &self.blocks {
            if block.point == point {
                let own = &block.whitener * block.pick(&slopes[block.direction]);
                found.extend(own.iter().enumerate().map(|(i, x)| (first + i, *x)));
            }
            first += block.components.len();
        }
        found
    }

    /// Slopes from whitened ones, m/N; NaN where one of the same set-up is.
    pub fn colour(&self, whitened: &[f64]) -> Vec<f64> {
        let mut found = Vec::with_capacity(whitened.len());
        for block in &self.blocks {
            let own = &whitened[found.len()..found.len() + block.components.len()];
            let root = block.whitener.clone().try_inverse();
            let coloured = root.map(|root| root * DVector::from_column_slice(own));
            match coloured {
                Some(coloured) => found.extend(coloured.iter()),
                None => found.extend(own.iter().map(|_| f64::NAN)),
            }
        }
        found
    }

    /// Point, direction and component of every whitened number: a number belongs to all components
    /// up to its own.
    pub fn places(&self) -> Vec<(usize, usize, usize)> {
        let own = |b: &Block| {
            let (point, direction) = (b.point, b.direction);
            let places = b.components.clone().into_iter();
            places.map(move |k| (point, direction, k))
        };
        self.blocks.iter().flat_map(own).collect()
    }

    /// Whitened slopes per relative compliance of each site.
    pub fn design(&self, response: &Response, sites: &[Site]) -> DMatrix<f64> {
        let column = |site: &Site| {
            self.whiten(|point, direction| {
                let unit = response.unit(point, direction, &site.axes);
                unit.map(|u| u * site.compliance)
            })
        };
        let columns: Vec<DVector<f64>> = sites.iter().map(column).collect();
        match columns.is_empty() {
            true => DMatrix::zeros(self.len(), 0),
            false => DMatrix::from_columns(&columns),
        }
    }
}

impl Block {
    /// The measured components of a slope.
    fn pick(&self, slope: &V3) -> DVector<f64> {
        let own = self.components.iter().map(|k| slope[*k]);
        DVector::from_iterator(self.components.len(), own)
    }
}
