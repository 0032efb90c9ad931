//! The physical model fitted by weighted least squares, with what the orientations fix and what not.

use super::descents::{descend, start};
use super::poses::Pose;
use super::statics::{ANGLES, N, PARAMETERS, reading, sizes, slopes};
use crate::fit::parameter::{Identified, Status, Z95};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// The fit.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// Parameters in the order of [`PARAMETERS`], SI.
    pub p: [f64; N],
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// Standard deviation of the prior of each; infinite without one.
    pub prior: [f64; N],
    /// Which the orientations fix.
    pub known: [bool; N],
    /// Noise of a point's mean: forces, N, and moments, N·m.
    pub noise: [f64; 2],
    /// Whether noise is what the residuals say (else what the file states).
    pub estimated: bool,
    /// Residuals of every pose: measured less model, N and N·m.
    pub residual: Vec<[f64; 6]>,
    /// 97.5 % point that the intervals use.
    pub quantile: f64,
}

/// Angles without any hint, rad: no orientation is excluded.
const FREE: f64 = 1.0;
/// Turn and tilt that orientations do not fix count as zero to this, rad (half a degree: a careful mounting).
pub const MOUNTED: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// A parameter is known if its standard deviation is below this share of its natural size.
const KNOWN: f64 = 0.3;
/// Degrees of freedom from which residuals are taken for a noise that nobody states: a reading must be left over.
const OWN: f64 = 0.5;
/// Degrees of freedom from which residuals tell the noise.
const TELLING: f64 = 6.0;
/// Noise never counts as less than this share of the readings' size.
const ROUNDING: f64 = 1e-12;

impl Fitted {
    /// Fits `poses`; `stated`: noise of forces and moments as the file gives it.
    pub fn of(poses: &[Pose], stated: [Option<f64>; 2]) -> Self {
        let mut prior = [f64::INFINITY; N];
        prior[ANGLES..].fill(FREE);
        // an angle that the data leave open would take weight and offsets with it
        loop {
            let fitted = Self::with(poses, stated, prior);
            let loose = (ANGLES..N).filter(|j| !fitted.known[*j] && prior[*j] == FREE);
            let loose: Vec<usize> = loose.collect();
            if loose.is_empty() {
                return fitted.checked_upright(poses);
            }
            loose.into_iter().for_each(|j| prior[j] = MOUNTED);
        }
    }

    fn with(poses: &[Pose], stated: [Option<f64>; 2], prior: [f64; N]) -> Self {
        let size = poses
            .iter()
            .flat_map(|pose| pose.load)
            .map(f64::abs)
            .fold(1e-30, f64::max);
        let mut noise = [
            stated[0].unwrap_or(1e-2 * size),
            stated[1].unwrap_or(1e-3 * size),
        ];
        let (mut freedom, mut estimated) = ([0.0; 2], false);
        let mut p = start(poses, &prior, noise);
        for _ in 0..6 {
            p = descend(poses, &prior, noise, p).0;
            let system = System::new(poses, &prior, noise, &p);
            let told = system.noise(poses, &p);
            freedom = told.map(|(_, freedom)| freedom);
            estimated = freedom.iter().all(|f| *f >= TELLING);
            let next = [0, 1].map(|kind| match (told[kind], stated[kind]) {
                ((sigma, f), None) if f > OWN => sigma.max(ROUNDING * size),
                ((sigma, f), _) if f >= TELLING => sigma.max(ROUNDING * size),
                _ => noise[kind],
            });
            let settled = (0..2).all(|k| (next[k] / noise[k] - 1.0).abs() < 1e-6);
            noise = next;
            if settled {
                break;
            }
        }
        let covariance = System::new(poses, &prior, noise, &p).covariance();
        let sizes = sizes(p[0]);
        // a noise that nobody states is that of what is left, however little that tells
        let is_own = |kind: &usize| estimated || stated[*kind].is_none() && freedom[*kind] > OWN;
        let free = (0..2)
            .filter(is_own)
            .map(|kind| freedom[kind])
            .reduce(f64::min);
        let student =
            |free: f64| StudentsT::new(0.0, 1.0, free.max(1.0)).map(|t| t.inverse_cdf(0.975));
        Self {
            known: std::array::from_fn(|j| {
                covariance[(j, j)].sqrt() < KNOWN * sizes[j] && (prior[j] > MOUNTED)
            }),
            residual: poses.iter().map(|pose| less(pose, &p)).collect(),
            quantile: free.and_then(|free| student(free).ok()).unwrap_or(Z95),
            covariance,
            prior,
            noise,
            estimated,
            p,
        }
    }

    /// Weight, centre and offsets must follow from the orientations alone: where they would only follow from
    /// the way a tilt shows, they count as not known.
    fn checked_upright(mut self, poses: &[Pose]) -> Self {
        let mut upright = self.p;
        upright[ANGLES..].fill(0.0);
        let mut prior = [f64::INFINITY; N];
        prior[ANGLES..].fill(1e-9);
        let covariance = System::new(poses, &prior, self.noise, &upright).covariance();
        let sizes = sizes(self.p[0]);
        for j in 0..ANGLES {
            self.known[j] &= covariance[(j, j)].sqrt() < KNOWN * sizes[j];
        }
        if !self.known[0] {
            (1..4).chain(ANGLES..N).for_each(|j| self.known[j] = false);
        }
        self
    }

    /// Root mean square of the residuals: forces, N, and moments, N·m.
    pub fn rms(&self) -> [f64; 2] {
        rms(&self.residual)
    }

    /// The parameters with their intervals.
    pub fn parameters(&self) -> Vec<Identified> {
        (0..N).map(|j| self.parameter(j)).collect()
    }

    fn parameter(&self, j: usize) -> Identified {
        let (name, site, unit, meaning) = PARAMETERS[j];
        let std = self.covariance[(j, j)].sqrt();
        let mut found = Identified::new(name, site, self.p[j], unit, std, meaning);
        let half = self.quantile * std;
        found.ci95 = Some([self.p[j] - half, self.p[j] + half]);
        match self.known[j] {
            true => found,
            false => found.without_value(Status::NotIdentifiable),
        }
    }
}

/// Root mean squares of forces and moments.
pub fn rms(residual: &[[f64; 6]]) -> [f64; 2] {
    [0, 1].map(|kind| {
        let squares = residual
            .iter()
            .flat_map(|r| &r[3 * kind..3 * kind + 3])
            .map(|x| x * x);
        (squares.sum::<f64>() / (3 * residual.len().max(1)) as f64).sqrt()
    })
}

/// Measured less model, N and N·m.
pub(super) fn less(pose: &Pose, p: &[f64; N]) -> [f64; 6] {
    let model = reading(p, pose.quaternion);
    std::array::from_fn(|c| pose.load[c] - model[c])
}

/// Natural sizes of the parameters about `p`.
pub(super) fn size_at(p: &[f64; N]) -> [f64; N] {
    sizes(p[0].abs().max(1e-6))
}

/// The normal equations about a point, everything in natural sizes.
pub struct System {
    slopes: Vec<[[f64; N]; 6]>,
    noise: [f64; 2],
    size: [f64; N],
    pub(super) normal: DMatrix<f64>,
}

impl System {
    /// At the parameters `p`.
    pub fn new(poses: &[Pose], prior: &[f64; N], noise: [f64; 2], p: &[f64; N]) -> Self {
        let slopes: Vec<_> = poses
            .iter()
            .map(|pose| slopes(p, pose.quaternion))
            .collect();
        let size = size_at(p);
        let mut normal = DMatrix::zeros(N, N);
        for rows in &slopes {
            for (c, row) in rows.iter().enumerate() {
                let sigma = noise[c / 3];
                let row = DVector::from_fn(N, |j, _| row[j] * size[j] / sigma);
                normal.ger(1.0, &row, &row, 1.0);
            }
        }
        for j in 0..N {
            // no prior: a thousand natural sizes, so that nothing is singular
            normal[(j, j)] += (size[j] / prior[j]).powi(2).max(1e-6);
        }
        Self {
            slopes,
            noise,
            size,
            normal,
        }
    }

    /// Covariance of the parameters, SI.
    pub fn covariance(&self) -> DMatrix<f64> {
        let inverse = self.normal.clone().cholesky().map(|c| c.inverse());
        let inverse = inverse.unwrap_or_else(|| DMatrix::identity(N, N) * 1e6);
        DMatrix::from_fn(N, N, |i, j| inverse[(i, j)] * self.size[i] * self.size[j])
    }

    /// Noise that residuals of forces and moments tell, each with its degrees of freedom.
    fn noise(&self, poses: &[Pose], p: &[f64; N]) -> [(f64, f64); 2] {
        let covariance = self.covariance();
        let (mut squares, mut used) = ([0.0; 2], [0.0; 2]);
        for (pose, rows) in poses.iter().zip(&self.slopes) {
            let residual = less(pose, p);
            for (c, row) in rows.iter().enumerate() {
                let row = DVector::from_row_slice(row);
                squares[c / 3] += residual[c].powi(2);
                used[c / 3] +=
                    (row.transpose() * &covariance * &row)[0] / self.noise[c / 3].powi(2);
            }
        }
        [0, 1].map(|k| {
            let freedom = 3.0 * poses.len() as f64 - used[k];
            ((squares[k] / freedom.max(1e-3)).sqrt(), freedom)
        })
    }

    /// Gradient of half the whitened sum of squares with priors about zero, downhill, in natural sizes.
    pub(super) fn downhill(&self, poses: &[Pose], prior: &[f64; N], p: &[f64; N]) -> DVector<f64> {
        let mut gradient = DVector::from_fn(N, |j, _| -p[j] * self.size[j] / prior[j].powi(2));
        for (pose, rows) in poses.iter().zip(&self.slopes) {
            let residual = less(pose, p);
            for (c, row) in rows.iter().enumerate() {
                let weight = residual[c] / self.noise[c / 3].powi(2);
                (0..N).for_each(|j| gradient[j] += weight * row[j] * self.size[j]);
            }
        }
        gradient
    }
}
