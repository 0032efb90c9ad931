//! Shapes set free before judging: grid error looks like a second cause.

use crate::effects::{Composite, Effect};
use crate::fit::candidates::Candidates;
use crate::fit::least_squares::{Optimum, Problem, Search, minimise};
use crate::fit::normal::Found;
use crate::fit::observation::Observation;
use crate::fit::starts::start_of;
use crate::signal::colour::Colour;

/// A set of effects with its parameters refined.
#[derive(Clone)]
pub struct Refined {
    /// The effects, in the order of the composite, spring first.
    pub model: Composite,
    /// Causes it names, sorted.
    pub causes: Vec<&'static str>,
    /// Parameters, SI.
    pub optimum: Optimum,
    /// Log likelihood above that of the spring alone, before tempering.
    pub nats: f64,
    /// Parameters beyond the spring.
    pub dimension: usize,
    /// Amplitudes among them.
    pub amplitudes: usize,
    /// Information on the shapes, in units of their prior spread: eigenvalues of the Schur
    /// complement of the normal matrix after spring and amplitudes.
    pub information: Vec<f64>,
    /// Nats by which the shapes are far from the middle of what was expected.
    pub surprise: f64,
}

/// Refines one set.
pub fn refine(
    found: &Found,
    candidates: &Candidates,
    data: &Observation,
    colour: &Colour,
    base: f64,
    iterations: usize,
) -> Refined {
    let effects: Vec<&'static dyn Effect> = found
        .atoms
        .iter()
        .map(|i| candidates.library[candidates.atoms[*i].effect])
        .collect();
    let model = Composite::new(&effects);
    let start = start_of(&model, found, candidates, data);
    refine_from(model, &start, data, colour, base, iterations)
}

/// Refines a model from given parameters.
pub fn refine_from(
    model: Composite,
    start: &[f64],
    data: &Observation,
    colour: &Colour,
    base: f64,
    iterations: usize,
) -> Refined {
    let ignored = vec![false; data.rows()];
    let problem = Problem {
        model: &model,
        data,
        colour,
        ignored: &ignored,
    };
    let search = Search {
        iterations,
        tolerance: 1e-5,
    };
    let optimum = minimise(&problem, start, search);
    let mut causes: Vec<&'static str> = model.effects()[1..]
        .iter()
        .map(|e| e.card().cause)
        .collect();
    causes.sort_unstable();
    Refined {
        causes,
        nats: 0.5 * (base - optimum.chi2),
        dimension: model.len() - 1,
        amplitudes: model.effects().len() - 1,
        information: information(&model, &optimum),
        surprise: surprise(&model, &optimum),
        optimum,
        model,
    }
}

/// How much the data say about the shapes, each in units of its prior spread.
fn information(model: &Composite, optimum: &Optimum) -> Vec<f64> {
    let slots = model.slots();
    let shapes: Vec<usize> = (0..slots.len()).filter(|j| !slots[*j].amplitude).collect();
    let linear: Vec<usize> = (0..slots.len()).filter(|j| slots[*j].amplitude).collect();
    if shapes.is_empty() {
        return Vec::new();
    }
    let mut columns = optimum.jacobian.select_columns(&shapes);
    for (k, j) in shapes.iter().enumerate() {
        let x = optimum.p[*j] / optimum.scale[*j];
        columns
            .column_mut(k)
            .scale_mut(prior_spread(slots[*j].parameter.bounds, x));
    }
    let rest = optimum.jacobian.select_columns(&linear);
    let normal = rest.tr_mul(&rest);
    let cross = rest.tr_mul(&columns);
    let schur = match normal.cholesky() {
        Some(factor) => columns.tr_mul(&columns) - cross.transpose() * factor.solve(&cross),
        None => columns.tr_mul(&columns),
    };
    schur
        .symmetric_eigenvalues()
        .iter()
        .map(|v| v.max(0.0))
        .collect()
}

/// Standard deviation of a shape before any data: even over its bounds, in the logarithm where the
/// bounds are positive.
fn prior_spread((low, high): (f64, f64), x: f64) -> f64 {
    let width = if low > 0.0 {
        x.abs() * (high / low).ln()
    } else {
        high - low
    };
    width / 12.0_f64.sqrt()
}

/// Prior nats of the shapes: Gaussian about the middle of their bounds.
fn surprise(model: &Composite, optimum: &Optimum) -> f64 {
    let slots = model.slots();
    let shapes = slots.iter().enumerate().filter(|(_, s)| !s.amplitude);
    shapes
        .map(|(j, slot)| {
            let ((low, high), x) = (slot.parameter.bounds, optimum.p[j] / optimum.scale[j]);
            let position = match low > 0.0 {
                true => (x / low).ln() / (high / low).ln(),
                false => (x - low) / (high - low),
            };
            6.0 * (position - 0.5).powi(2)
        })
        .sum()
}
