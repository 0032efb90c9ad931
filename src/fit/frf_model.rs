//! The accelerance of a linearised multibody model, with its derivatives by analysis.

use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// What a parameter multiplies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A direction of the damping matrix.
    Damping,
    /// A direction of the stiffness matrix.
    Stiffness,
    /// A direction of the mass matrix.
    Mass,
}

impl Kind {
    /// The factor of the direction in `Z(s) = s²M + sD + K`.
    fn factor(self, s: Complex64) -> Complex64 {
        match self {
            Self::Damping => s,
            Self::Stiffness => Complex64::new(1.0, 0.0),
            Self::Mass => s * s,
        }
    }
}

/// The model at one pose, in n generalised coordinates: `Z = s²M + sD + K + Σ θₚ·sᵏ·Gₚ`.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    /// Mass matrix M (n × n) without the tuned part.
    pub mass: DMatrix<f64>,
    /// Damping matrix D (n × n) without the tuned part.
    pub damping: DMatrix<f64>,
    /// Stiffness matrix K (n × n) without the tuned part.
    pub stiffness: DMatrix<f64>,
    /// Translation of the tool per coordinate, m (3 × n, base axes): forces act and accelerations are
    /// taken along its rows.
    pub jacobian: DMatrix<f64>,
    /// `∂(matrix)/∂θ` of every parameter (n × n), in the order of the parameters.
    pub directions: Vec<DMatrix<f64>>,
    /// What was measured here.
    pub measured: Vec<Measured>,
}

/// One measured accelerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Row of the Jacobian along which the force acts.
    pub input: usize,
    /// Row along which the acceleration is taken.
    pub output: usize,
    /// Frequencies, Hz.
    pub frequency_hz: Vec<f64>,
    /// Rate σ of the exponential window, 1/s: the model is evaluated at `jω + σ`.
    pub rate: f64,
    /// Length of the records, s (the window correlates neighbouring lines).
    pub length_s: f64,
    /// Accelerance, (m/s²)/N.
    pub frf: Vec<Complex64>,
    /// Variance of each value, `var(Re) + var(Im)`, the square of its unit.
    pub variance: Vec<f64>,
}

impl Measured {
    /// `s = jω + σ` at line `k`.
    pub fn s(&self, k: usize) -> Complex64 {
        Complex64::new(self.rate, std::f64::consts::TAU * self.frequency_hz[k])
    }

    /// How many lines carry the information of one: `x·coth x` with `x = σT`, the equivalent
    /// noise bandwidth of the squared window.
    pub fn lines_per_independent_one(&self) -> f64 {
        let x = self.rate * self.length_s;
        if x < 1e-6 { 1.0 } else { x / x.tanh() }
    }
}

impl Pose {
    /// Accelerance of a measured pair at the values `theta`, (m/s²)/N, per line; none where the
    /// dynamic stiffness is singular.
    pub fn accelerance(
        &self,
        kinds: &[Kind],
        theta: &[f64],
        pair: &Measured,
    ) -> Option<Vec<Complex64>> {
        let lines = 0..pair.frequency_hz.len();
        lines
            .map(|k| {
                let s = pair.s(k);
                let z = self.dynamic_stiffness(kinds, theta, s);
                let response = z.lu().solve(&self.row(pair.input))?;
                Some(s * s * self.row(pair.output).dot(&response))
            })
            .collect()
    }

    /// Accelerance and its derivatives in every parameter: `∂H/∂θ = −s²·yₒᵀ·(sᵏG)·yᵢ`, `y = Z⁻¹Jᵀ`.
    pub fn sensitivities(
        &self,
        kinds: &[Kind],
        theta: &[f64],
        pair: &Measured,
    ) -> Option<(Vec<Complex64>, Vec<Vec<Complex64>>)> {
        let mut frf = Vec::with_capacity(pair.frequency_hz.len());
        let mut slopes = vec![Vec::with_capacity(pair.frequency_hz.len()); kinds.len()];
        for k in 0..pair.frequency_hz.len() {
            let s = pair.s(k);
            let lu = self.dynamic_stiffness(kinds, theta, s).lu();
            let input = lu.solve(&self.row(pair.input))?;
            let output = lu.solve(&self.row(pair.output))?;
            frf.push(s * s * self.row(pair.output).dot(&input));
            for ((slope, kind), direction) in slopes.iter_mut().zip(kinds).zip(&self.directions) {
                slope.push(-s * s * kind.factor(s) * bilinear(&output, direction, &input));
            }
        }
        Some((frf, slopes))
    }

    fn dynamic_stiffness(&self, kinds: &[Kind], theta: &[f64], s: Complex64) -> DMatrix<Complex64> {
        let fixed = |i: usize, j: usize| {
            s * s * self.mass[(i, j)] + s * self.damping[(i, j)] + self.stiffness[(i, j)]
        };
        let n = self.mass.nrows();
        let mut z = DMatrix::from_fn(n, n, fixed);
        for ((kind, value), direction) in kinds.iter().zip(theta).zip(&self.directions) {
            let factor = kind.factor(s) * *value;
            z.zip_apply(direction, |entry, d| *entry += factor * d);
        }
        z
    }

    fn row(&self, row: usize) -> DVector<Complex64> {
        let row = self.jacobian.row(row);
        DVector::from_iterator(row.len(), row.iter().map(|v| Complex64::new(*v, 0.0)))
    }
}

/// `aᵀ·G·b`; directions are sparse.
fn bilinear(a: &DVector<Complex64>, direction: &DMatrix<f64>, b: &DVector<Complex64>) -> Complex64 {
    let mut sum = Complex64::new(0.0, 0.0);
    for (j, column) in direction.column_iter().enumerate() {
        for (i, value) in column.iter().enumerate().filter(|(_, v)| **v != 0.0) {
            sum += a[i] * b[j] * *value;
        }
    }
    sum
}
