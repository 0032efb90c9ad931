//! The accelerance of a linearised multibody model, with its derivatives by analysis.

use nalgebra::DMatrix;
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

/// Row, column and value of a matrix.
pub type Entry = (usize, usize, f64);

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

    /// Whether `other` stands on the same lines, so that the model is the same there.
    pub fn on_lines_of(&self, other: &Self) -> bool {
        self.rate == other.rate && self.frequency_hz == other.frequency_hz
    }

    /// How many lines carry the information of one: `x·coth x` with `x = σT`, the equivalent
    /// noise bandwidth of the squared window.
    pub fn lines_per_independent_one(&self) -> f64 {
        let x = self.rate * self.length_s;
        if x < 1e-6 { 1.0 } else { x / x.tanh() }
    }
}

/// `Z⁻¹Jᵀ` per line: one solution serves every pair on the same lines.
pub struct Responses(Vec<DMatrix<Complex64>>);

impl Pose {
    /// Accelerance of a measured pair at the values `theta`, (m/s²)/N, per line; none where the
    /// dynamic stiffness is singular.
    pub fn accelerance(
        &self,
        kinds: &[Kind],
        theta: &[f64],
        pair: &Measured,
    ) -> Option<Vec<Complex64>> {
        let responses = self.responses(kinds, theta, pair)?;
        Some(self.accelerance_of(&responses, pair))
    }

    /// Accelerance and its derivatives in every parameter: `∂H/∂θ = −s²·yₒᵀ·(sᵏG)·yᵢ`, `y = Z⁻¹Jᵀ`.
    pub fn sensitivities(
        &self,
        kinds: &[Kind],
        theta: &[f64],
        pair: &Measured,
    ) -> Option<(Vec<Complex64>, Vec<Vec<Complex64>>)> {
        let responses = self.responses(kinds, theta, pair)?;
        Some(self.sensitivities_of(&responses, kinds, &self.entries(), pair))
    }

    /// The responses of all coordinates to unit forces along the rows of the Jacobian, on the lines
    /// of `pair`; none where the dynamic stiffness is singular.
    pub fn responses(&self, kinds: &[Kind], theta: &[f64], pair: &Measured) -> Option<Responses> {
        let forces = self.jacobian.transpose().map(|v| Complex64::new(v, 0.0));
        let line = |k: usize| {
            self.dynamic_stiffness(kinds, theta, pair.s(k))
                .lu()
                .solve(&forces)
        };
        let lines = (0..pair.frequency_hz.len()).map(line);
        lines.collect::<Option<Vec<_>>>().map(Responses)
    }

    /// [`Pose::accelerance`] from responses.
    pub fn accelerance_of(&self, responses: &Responses, pair: &Measured) -> Vec<Complex64> {
        let line = |(k, y): (usize, &DMatrix<Complex64>)| {
            let (s, column) = (pair.s(k), y.column(pair.input));
            let row = self.jacobian.row(pair.output);
            let along: Complex64 = row.iter().zip(column.iter()).map(|(j, y)| y * *j).sum();
            s * s * along
        };
        responses.0.iter().enumerate().map(line).collect()
    }

    /// [`Pose::sensitivities`] from responses and the entries of the directions.
    pub fn sensitivities_of(
        &self,
        responses: &Responses,
        kinds: &[Kind],
        entries: &[Vec<Entry>],
        pair: &Measured,
    ) -> (Vec<Complex64>, Vec<Vec<Complex64>>) {
        let slope = |(kind, entries): (&Kind, &Vec<Entry>)| {
            let line = |(k, y): (usize, &DMatrix<Complex64>)| {
                let s = pair.s(k);
                let (output, input) = (y.column(pair.output), y.column(pair.input));
                let parts = entries
                    .iter()
                    .map(|(i, j, value)| output[*i] * input[*j] * *value);
                -s * s * kind.factor(s) * parts.sum::<Complex64>()
            };
            responses.0.iter().enumerate().map(line).collect()
        };
        let slopes = kinds.iter().zip(entries).map(slope).collect();
        (self.accelerance_of(responses, pair), slopes)
    }

    /// Where each direction is not zero.
    pub fn entries(&self) -> Vec<Vec<Entry>> {
        let filled = |direction: &DMatrix<f64>| {
            let n = direction.nrows();
            let all = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
            let entry = |(i, j): (usize, usize)| (i, j, direction[(i, j)]);
            all.map(entry)
                .filter(|(_, _, value)| *value != 0.0)
                .collect()
        };
        self.directions.iter().map(filled).collect()
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
}
