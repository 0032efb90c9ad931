//! Bounded weighted nonlinear least squares of a composite of effects: whitened residuals in the cosine
//! domain, parameters scaled by their natural scale, derivatives by dual numbers.

use super::observation::Observation;
use crate::effects::Composite;
use crate::ground::products::gram;
use crate::inference::descent::{Landscape, Linear, Stop, descend};
use crate::signal::colour::Colour;
use nalgebra::{DMatrix, DVector};

/// Where a fit ended.
#[derive(Debug, Clone)]
pub struct Optimum {
    /// Parameters, SI.
    pub p: Vec<f64>,
    /// Whitened sum of squares.
    pub chi2: f64,
    /// Which parameters ended on a bound: −1 lower, +1 upper, 0 free.
    pub active: Vec<i8>,
    /// Jacobian of the whitened residual with respect to scaled parameters, rows × parameters.
    pub jacobian: DMatrix<f64>,
    /// Whitened residual, reading less model.
    pub residual: DVector<f64>,
    /// Scales of the parameters.
    pub scale: Vec<f64>,
}

/// The whitened problem: model, data and noise.
pub struct Problem<'a> {
    /// Model.
    pub model: &'a Composite,
    /// Data.
    pub data: &'a Observation,
    /// Noise.
    pub colour: &'a Colour,
    /// Rows whose readings do not count (held-out cycles, wild readings): replaced by the model.
    pub ignored: &'a [bool],
}

impl Problem<'_> {
    /// Natural sizes of the parameters, SI.
    pub fn scale(&self) -> Vec<f64> {
        let slots = self.model.slots();
        let each = slots.iter().map(|s| s.parameter.scale.of(&self.data.scene));
        each.collect()
    }

    fn weigh(&self, residual: &mut [f64]) {
        for (r, ignored) in residual.iter_mut().zip(self.ignored) {
            if *ignored {
                *r = 0.0;
            }
        }
        self.data.cosine.transform(residual);
        self.colour.whiten(residual);
    }

    /// Whitened residual (reading − model).
    pub fn residual(&self, p: &[f64]) -> Vec<f64> {
        let mut residual = self.model.predict(p, &self.data.scene);
        for (r, reading) in residual.iter_mut().zip(&self.data.reading) {
            *r = reading - *r;
        }
        self.weigh(&mut residual);
        residual
    }

    /// Whitened residual and its Jacobian by scaled parameters (of the model: −∂r/∂x).
    pub fn linearise(&self, p: &[f64], scale: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
        let n = self.data.rows();
        let tangents = self.model.differentiate(p, &self.data.scene);
        let mut columns: Vec<Vec<f64>> = (0..p.len())
            .map(|j| tangents.iter().map(|t| t.eps[j] * scale[j]).collect())
            .collect();
        let residual = tangents
            .iter()
            .zip(&self.data.reading)
            .map(|(t, y)| y - t.re);
        columns.push(residual.collect());
        columns.iter_mut().for_each(|c| self.weigh(c));
        let residual = DVector::from_vec(columns.pop().unwrap_or_default());
        (residual, DMatrix::from_fn(n, p.len(), |i, j| columns[j][i]))
    }
}

/// Minimises from `start`. Always returns the best point seen.
pub fn minimise(problem: &Problem, start: &[f64], stop: Stop) -> Optimum {
    let within = Within {
        problem,
        scale: problem.scale(),
        bounds: problem.model.bounds(&problem.data.scene),
    };
    let at = descend(&within, within.at(start), stop);
    let (residual, jacobian) = match at.known {
        Some(known) => known,
        None => problem.linearise(&at.p, &within.scale),
    };
    Optimum {
        active: (0..at.p.len()).map(|j| within.side(j, at.p[j])).collect(),
        chi2: residual.norm_squared(),
        p: at.p,
        jacobian,
        residual,
        scale: within.scale,
    }
}

/// A problem within its bounds, in scaled parameters.
struct Within<'a> {
    problem: &'a Problem<'a>,
    scale: Vec<f64>,
    bounds: Vec<(f64, f64)>,
}

struct At {
    p: Vec<f64>,
    chi2: f64,
    /// Residual and Jacobian, once asked for.
    known: Option<(DVector<f64>, DMatrix<f64>)>,
}

impl Within<'_> {
    fn at(&self, p: &[f64]) -> At {
        let ends = p.iter().zip(&self.bounds);
        let p: Vec<f64> = ends.map(|(v, (low, high))| v.clamp(*low, *high)).collect();
        At {
            chi2: self.problem.residual(&p).iter().map(|r| r * r).sum(),
            p,
            known: None,
        }
    }

    /// On which bound a value of parameter j stands.
    fn side(&self, j: usize, value: f64) -> i8 {
        let (low, high) = self.bounds[j];
        let near = 1e-9 * (high - low).abs();
        i8::from(value >= high - near) - i8::from(value <= low + near)
    }
}

impl Landscape for Within<'_> {
    type Place = At;

    fn height(&self, place: &At) -> f64 {
        place.chi2
    }

    fn linear(&self, place: &mut At) -> Option<Linear> {
        let (residual, jacobian) = self.problem.linearise(&place.p, &self.scale);
        let linear = Linear {
            normal: gram(&jacobian),
            slope: jacobian.tr_mul(&residual),
        };
        place.known = Some((residual, jacobian));
        Some(linear)
    }

    fn step(&self, from: &At, step: &DVector<f64>) -> Option<At> {
        let parts = from.p.iter().zip(step.iter()).zip(&self.scale);
        let moved: Vec<f64> = parts.map(|((v, d), s)| v + d * s).collect();
        Some(self.at(&moved))
    }

    fn held(&self, at: &At, j: usize, slope: f64) -> bool {
        f64::from(self.side(j, at.p[j])) * slope > 0.0
    }
}
