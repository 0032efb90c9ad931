//! The accelerance of a linearised multibody model, with its derivatives by analysis.

use super::frf_data::Measured;
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
    /// What weight does: [`Weight`].
    Weight,
}

impl Kind {
    /// The factor of the direction in `Z(s) = s²M + sD + K`.
    fn factor(self, s: Complex64) -> Complex64 {
        match self {
            Self::Damping => s,
            Self::Stiffness => Complex64::new(1.0, 0.0),
            Self::Mass => s * s,
            Self::Weight => Complex64::new(0.0, 0.0),
        }
    }
}

/// What its weight does to a robot: it sags, which turns its bodies and the directions in which its
/// joints move the tool, and weight adds stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct Weight {
    /// Change of the mass matrix (n × n).
    pub mass: DMatrix<f64>,
    /// Stiffness that weight adds (n × n).
    pub stiffness: DMatrix<f64>,
    /// Change of the Jacobian (3 × n).
    pub jacobian: DMatrix<f64>,
}

impl Weight {
    /// `(s²ΔM + ΔK)·y`.
    fn times(&self, s: Complex64, y: &DMatrix<Complex64>) -> DMatrix<Complex64> {
        let z = self.mass.zip_map(&self.stiffness, |m, k| s * s * m + k);
        z * y
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
    /// `∂(matrix)/∂θ` of every parameter (n × n), in the order of the parameters; empty for weight.
    pub directions: Vec<DMatrix<f64>>,
    /// What a parameter of kind weight multiplies.
    pub weight: Option<Weight>,
    /// What was measured here.
    pub measured: Vec<Measured>,
}

/// Row, column and value of a matrix.
pub type Entry = (usize, usize, f64);

/// `y = Z⁻¹Jᵀ` per line: one solution serves every pair on the same lines.
pub struct Responses {
    lines: Vec<DMatrix<Complex64>>,
    jacobian: DMatrix<f64>,
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
        let weighed = self.weighed(&responses, pair);
        Some(self.sensitivities_of(&responses, &weighed, kinds, &self.entries(), pair))
    }

    /// The responses of all coordinates to unit forces along the rows of the Jacobian, on the lines
    /// of `pair`; none where the dynamic stiffness is singular.
    pub fn responses(&self, kinds: &[Kind], theta: &[f64], pair: &Measured) -> Option<Responses> {
        let jacobian = self.jacobian_at(kinds, theta);
        let forces = jacobian.transpose().map(|v| Complex64::new(v, 0.0));
        let matrices = self.matrices(kinds, theta);
        let line = |k: usize| dynamic_stiffness(&matrices, pair.s(k)).lu().solve(&forces);
        let lines = (0..pair.frequency_hz.len()).map(line);
        let lines = lines.collect::<Option<Vec<_>>>()?;
        Some(Responses { lines, jacobian })
    }

    /// The forces per line that weight adds where the responses are; empty without weight.
    pub fn weighed(&self, responses: &Responses, pair: &Measured) -> Vec<DMatrix<Complex64>> {
        let weight = self.weight.iter();
        let line = |(w, (k, y)): (&Weight, (usize, &DMatrix<Complex64>))| w.times(pair.s(k), y);
        weight
            .flat_map(|w| responses.lines.iter().enumerate().map(move |y| (w, y)))
            .map(line)
            .collect()
    }

    /// [`Pose::accelerance`] from responses.
    pub fn accelerance_of(&self, responses: &Responses, pair: &Measured) -> Vec<Complex64> {
        let line = |(k, y): (usize, &DMatrix<Complex64>)| {
            let (s, column) = (pair.s(k), y.column(pair.input));
            let row = responses.jacobian.row(pair.output);
            let along: Complex64 = row.iter().zip(column.iter()).map(|(j, y)| y * *j).sum();
            s * s * along
        };
        responses.lines.iter().enumerate().map(line).collect()
    }

    /// [`Pose::sensitivities`] from responses, what weight adds to them, and the entries of the
    /// directions.
    pub fn sensitivities_of(
        &self,
        responses: &Responses,
        weighed: &[DMatrix<Complex64>],
        kinds: &[Kind],
        entries: &[Vec<Entry>],
        pair: &Measured,
    ) -> (Vec<Complex64>, Vec<Vec<Complex64>>) {
        let slope = |(kind, entries): (&Kind, &Vec<Entry>)| {
            if *kind == Kind::Weight {
                return self.slope_of_weight(responses, weighed, pair);
            }
            let line = |(k, y): (usize, &DMatrix<Complex64>)| {
                let s = pair.s(k);
                let (output, input) = (y.column(pair.output), y.column(pair.input));
                let parts = entries
                    .iter()
                    .map(|(i, j, value)| output[*i] * input[*j] * *value);
                -s * s * kind.factor(s) * parts.sum::<Complex64>()
            };
            responses.lines.iter().enumerate().map(line).collect()
        };
        let slopes = kinds.iter().zip(entries).map(slope).collect();
        (self.accelerance_of(responses, pair), slopes)
    }

    /// `∂H/∂w = s²·(ΔJₒyᵢ + ΔJᵢyₒ) − s²·yₒᵀ(s²ΔM + ΔK)yᵢ`.
    fn slope_of_weight(
        &self,
        responses: &Responses,
        weighed: &[DMatrix<Complex64>],
        pair: &Measured,
    ) -> Vec<Complex64> {
        let Some(weight) = &self.weight else {
            return vec![Complex64::default(); responses.lines.len()];
        };
        let turned = |row: usize, y: &DMatrix<Complex64>, column: usize| -> Complex64 {
            let (row, column) = (weight.jacobian.row(row), y.column(column));
            row.iter().zip(column.iter()).map(|(j, y)| y * *j).sum()
        };
        let (o, i) = (pair.output, pair.input);
        let line = |(k, (y, z)): (usize, (&DMatrix<Complex64>, &DMatrix<Complex64>))| {
            let s = pair.s(k);
            let inner = y.column(o).dot(&z.column(i));
            s * s * (turned(o, y, i) + turned(i, y, o) - inner)
        };
        let lines = responses.lines.iter().zip(weighed).enumerate();
        lines.map(line).collect()
    }

    /// The Jacobian at the values `theta`.
    fn jacobian_at(&self, kinds: &[Kind], theta: &[f64]) -> DMatrix<f64> {
        let shares = kinds
            .iter()
            .zip(theta)
            .filter(|(kind, _)| **kind == Kind::Weight);
        let share: f64 = shares.map(|(_, value)| value).sum();
        match &self.weight {
            Some(weight) => &self.jacobian + &weight.jacobian * share,
            None => self.jacobian.clone(),
        }
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

    /// Mass, damping and stiffness matrix at the values `theta`.
    fn matrices(&self, kinds: &[Kind], theta: &[f64]) -> [DMatrix<f64>; 3] {
        let mut all = [&self.mass, &self.damping, &self.stiffness].map(DMatrix::clone);
        for ((kind, value), direction) in kinds.iter().zip(theta).zip(&self.directions) {
            let matrix = match kind {
                Kind::Mass => &mut all[0],
                Kind::Damping => &mut all[1],
                Kind::Stiffness => &mut all[2],
                Kind::Weight => {
                    if let Some(weight) = &self.weight {
                        all[0] += &weight.mass * *value;
                        all[2] += &weight.stiffness * *value;
                    }
                    continue;
                }
            };
            matrix.zip_apply(direction, |entry, d| *entry += value * d);
        }
        all
    }
}

/// `Z(s) = s²M + sD + K`.
fn dynamic_stiffness(
    [mass, damping, stiffness]: &[DMatrix<f64>; 3],
    s: Complex64,
) -> DMatrix<Complex64> {
    let of = |i: usize, j: usize| s * s * mass[(i, j)] + s * damping[(i, j)] + stiffness[(i, j)];
    DMatrix::from_fn(mass.nrows(), mass.ncols(), of)
}
