//! How much each measured slope of a workspace test counts: scatter of the readings, and the
//! repeatability of the set-up as one factor that its displacements share.

use super::force_steps::{Setup, quantile};
use super::parameter::Z95;
use crate::experiments::workspace::{Response, Site};
use nalgebra::{DMatrix, DVector};

/// The measured components of one set-up with the transform that whitens them.
#[derive(Debug, Clone)]
struct Block {
    point: usize,
    direction: usize,
    components: Vec<usize>,
    slopes: DVector<f64>,
    variances: Vec<f64>,
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
        let predicted: Vec<DVector<f64>> = self
            .blocks
            .iter()
            .map(|b| {
                let slope = response.slope(b.point, b.direction, compliances);
                DVector::from_iterator(b.components.len(), b.components.iter().map(|k| slope[*k]))
            })
            .collect();
        self.about(&predicted);
    }

    fn about(&mut self, shared: &[DVector<f64>]) {
        for (block, mean) in self.blocks.iter_mut().zip(shared) {
            let floor = 1e-12 * mean.norm_squared().max(block.slopes.norm_squared());
            let mut covariance = mean * mean.transpose() * self.repeatability.powi(2);
            for (k, variance) in block.variances.iter().enumerate() {
                covariance[(k, k)] += variance.max(floor);
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

    /// The whitened slopes.
    pub fn slopes(&self) -> DVector<f64> {
        let all = self.blocks.iter().map(|b| &b.whitener * &b.slopes);
        DVector::from_vec(
            all.flat_map(|v| v.iter().copied().collect::<Vec<_>>())
                .collect(),
        )
    }

    /// Whitened slopes per relative compliance of each site.
    pub fn design(&self, response: &Response, sites: &[Site]) -> DMatrix<f64> {
        let mut design = DMatrix::zeros(self.len(), sites.len());
        let mut row = 0;
        for block in &self.blocks {
            for (j, site) in sites.iter().enumerate() {
                let unit = response.unit(block.point, block.direction, &site.axes);
                let own = block.components.iter().map(|k| unit[*k] * site.compliance);
                let own = &block.whitener * DVector::from_iterator(block.components.len(), own);
                design.view_mut((row, j), (own.len(), 1)).copy_from(&own);
            }
            row += block.components.len();
        }
        design
    }
}
