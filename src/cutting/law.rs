//! What a force law must bring, and the material that states its coefficients.

use crate::ground::dual::{Dual, Scalar};

/// Most coefficients of a law (the length of its dual numbers).
pub const MOST: usize = 8;

/// The dual number in which laws are differentiated by their coefficients and the chip.
pub type Tangent = Dual<MOST>;

/// One coefficient of a law.
#[derive(Debug, Clone, Copy)]
pub struct Coefficient {
    /// Its name, as in reports: `Ktc`.
    pub name: &'static str,
    /// Its key in `[material]`: `Ktc_N_mm2`.
    pub key: &'static str,
    /// Its unit as printed.
    pub unit: &'static str,
    /// SI value = factor · value in that unit.
    pub factor: f64,
    /// The sentence the user reads about it.
    pub meaning: &'static str,
}

/// Everything about a law that is not its equation.
#[derive(Debug, Clone, Copy)]
pub struct LawCard {
    /// Its name in files.
    pub name: &'static str,
    /// What it says, one sentence.
    pub summary: &'static str,
    /// Its equation, as text.
    pub equation: &'static str,
    /// Author, year, equation.
    pub source: &'static str,
    /// Its coefficients.
    pub coefficients: &'static [Coefficient],
}

/// A force law, written once over a scalar type.
pub trait Law: Sync {
    /// The card.
    const CARD: LawCard;

    /// Force per length of edge, N/m: tangential (against the motion of the tooth), radial (against the
    /// outward normal), axial (up the meridian), all on the tool. `p` in SI, `chip` > 0 in m; outside
    /// the cut there is no force, and nobody asks.
    fn per_length<S: Scalar>(p: &[S], chip: S) -> [S; 3];
}

/// The object-safe face of a [`Law`].
pub trait CuttingLaw: Sync {
    /// Its card.
    fn card(&self) -> &'static LawCard;
    /// Force per length of edge, N/m; see [`Law::per_length`].
    fn per_length(&self, p: &[f64], chip: f64) -> [f64; 3];
    /// The same with derivatives.
    fn per_length_tangent(&self, p: &[Tangent], chip: Tangent) -> [Tangent; 3];
}

impl<L: Law> CuttingLaw for L {
    fn card(&self) -> &'static LawCard {
        const { &L::CARD }
    }
    fn per_length(&self, p: &[f64], chip: f64) -> [f64; 3] {
        L::per_length(p, chip)
    }
    fn per_length_tangent(&self, p: &[Tangent], chip: Tangent) -> [Tangent; 3] {
        L::per_length(p, chip)
    }
}

/// A material: a law and its coefficients.
#[derive(Clone)]
pub struct Material {
    /// The law.
    pub law: &'static dyn CuttingLaw,
    /// Its coefficients, SI, in the order of its card.
    pub coefficients: Vec<f64>,
}

impl std::fmt::Debug for Material {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {:?}", self.law.card().name, self.coefficients)
    }
}

impl Material {
    /// A law by the name of its card, with its coefficients (SI, in the order of the card). The linear one where none has the
    /// name: what a file may state is known to be among [`super::LAWS`] (`tests/job_files.rs`).
    pub fn of(law: &str, coefficients: &[f64]) -> Self {
        let own = super::LAWS.iter().find(|l| l.card().name == law);
        Self {
            law: own.copied().unwrap_or(super::LINEAR_EDGE),
            coefficients: coefficients.to_vec(),
        }
    }

    /// The linear law with its edge (Altintas) from the six numbers Ktc, Krc, Kac in N/mm² and Kte, Kre,
    /// Kae in N/mm.
    pub fn linear_edge(coefficients: [f64; 6]) -> Self {
        let card = super::LINEAR_EDGE.card();
        let si = coefficients.iter().zip(card.coefficients);
        Self {
            law: super::LINEAR_EDGE,
            coefficients: si.map(|(value, c)| value * c.factor).collect(),
        }
    }

    /// The slopes of tangential, radial and axial force over the chip, N/m².
    pub fn slope(&self, chip: f64) -> [f64; 3] {
        let p: Vec<Tangent> = self
            .coefficients
            .iter()
            .map(|v| Tangent::constant(*v))
            .collect();
        let forces = self
            .law
            .per_length_tangent(&p, Tangent::variable(chip, MOST - 1));
        forces.map(|f| f.eps[MOST - 1])
    }
}

/// How an edge stands in the cut frame: tooth angle φ and angle κ of the surface normal to the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction<S: Scalar = f64> {
    /// sin φ, cos φ.
    pub tooth: [S; 2],
    /// sin κ, cos κ.
    pub normal: [f64; 2],
}

impl<S: Scalar> Direction<S> {
    /// The three directions in which tangential, radial and axial force act on the tool.
    pub fn axes(&self) -> [[S; 3]; 3] {
        let ([s, c], [sk, ck]) = (self.tooth, self.normal);
        let zero = S::constant(0.0);
        let tangential = [-c, s, zero];
        let radial = [-s * sk, -c * sk, S::constant(ck)];
        let axial = [s * ck, c * ck, S::constant(sk)];
        [tangential, radial, axial]
    }

    /// Tangential, radial and axial force as a vector of the cut frame.
    pub fn force(&self, [t, r, a]: [S; 3]) -> [S; 3] {
        let [et, er, ea] = self.axes();
        std::array::from_fn(|k| et[k] * t + er[k] * r + ea[k] * a)
    }
}
