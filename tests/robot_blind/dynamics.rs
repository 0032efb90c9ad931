//! Elastic robot at a pose: M x'' + D x' + K x = J' f, and its response over frequency.

use super::poses::Angles;
use super::robot::{Robot, V3};
use nalgebra::{Complex, DMatrix, DVector, Matrix3};

pub type C3 = Matrix3<Complex<f64>>;

#[derive(Clone)]
pub struct Dynamics {
    pub mass: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    pub stiffness: DMatrix<f64>,
    pub jacobian: DMatrix<f64>,
    pub sites: Vec<String>,
}

impl Dynamics {
    pub fn of(robot: &Robot, pose: &Angles) -> Self {
        let chain = robot.at(pose);
        let diagonal = |value: &dyn Fn(&super::robot::Degree) -> f64| {
            let values: Vec<f64> = chain.degrees.iter().map(value).collect();
            DMatrix::from_diagonal(&DVector::from_vec(values))
        };
        Self {
            mass: chain.mass_matrix(),
            damping: diagonal(&|d| d.spring.damping),
            stiffness: diagonal(&|d| d.spring.stiffness),
            jacobian: chain.jacobian(),
            sites: chain.degrees.iter().map(|d| d.site.clone()).collect(),
        }
    }

    /// With a mass on a spring at the tool point that slides along `axis`.
    pub fn with_absorber(&self, axis: &V3, mass: f64, stiffness: f64, damping: f64) -> Self {
        let n = self.sites.len();
        let grown = |m: &DMatrix<f64>, corner: f64| {
            let mut out = m.clone().resize(n + 1, n + 1, 0.0);
            out[(n, n)] = corner;
            out
        };
        let carried = self.jacobian.transpose() * &self.jacobian * mass;
        let mut out = self.clone();
        out.mass = grown(&(&self.mass + carried), mass);
        let along = self.jacobian.transpose() * axis * mass;
        for i in 0..n {
            out.mass[(i, n)] = along[i];
            out.mass[(n, i)] = along[i];
        }
        out.stiffness = grown(&self.stiffness, stiffness);
        out.damping = grown(&self.damping, damping);
        out.jacobian = self.jacobian.clone().resize(3, n + 1, 0.0);
        out.sites.push("absorber".into());
        out
    }

    /// Acceleration of the tool point over force at s, both in base axes.
    pub fn accelerance(&self, s: Complex<f64>) -> C3 {
        let complex = |m: &DMatrix<f64>| m.map(|x| Complex::new(x, 0.0));
        let dynamic =
            complex(&self.mass) * (s * s) + complex(&self.damping) * s + complex(&self.stiffness);
        let jacobian = complex(&self.jacobian);
        let moved = dynamic.lu().solve(&jacobian.transpose()).unwrap();
        let out = jacobian * moved * (s * s);
        C3::from_iterator(out.iter().copied())
    }

    /// Angular frequencies of the undamped modes, rising, and shapes scaled to unit modal mass.
    pub fn modes(&self) -> (Vec<f64>, DMatrix<f64>) {
        // a foundation without mass that turns and slides moves as the bearing above it does: a millionth of every mass keeps them apart
        let size = self.mass.diagonal().map(|m| 1.0 / m.sqrt());
        let size = DMatrix::from_diagonal(&size);
        let apart = DMatrix::identity(size.nrows(), size.ncols()) * 1e-6;
        let mass = &size * &self.mass * &size + apart;
        let factor = mass.cholesky().unwrap().l();
        let inverse = factor.try_inverse().unwrap() * size;
        let balanced = &inverse * &self.stiffness * inverse.transpose();
        let eigen = ((&balanced + balanced.transpose()) * 0.5).symmetric_eigen();
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let omega = order.iter().map(|i| eigen.eigenvalues[*i].max(0.0).sqrt());
        let shapes = inverse.transpose() * &eigen.eigenvectors;
        (omega.collect(), shapes.select_columns(&order))
    }

    /// Angular frequency and damping ratio of the lowest mode.
    pub fn lowest(&self) -> (f64, f64) {
        let (omega, shapes) = self.modes();
        let shape = shapes.column(0);
        let damping = (shape.transpose() * &self.damping * shape)[(0, 0)];
        (omega[0], damping / (2.0 * omega[0]))
    }
}
