//! Shapes set free before judging: grid error looks like a second cause.

use crate::effects::Composite;
use crate::fit::least_squares::{Optimum, Problem, minimise};
use crate::fit::observation::Observation;
use crate::inference::descent::Stop;
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
}

/// Refines a model from given parameters.
pub fn refine_from(
    model: Composite,
    start: &[f64],
    data: &Observation,
    colour: &Colour,
    iterations: usize,
) -> Refined {
    let ignored = vec![false; data.rows()];
    let problem = Problem {
        model: &model,
        data,
        colour,
        ignored: &ignored,
    };
    let optimum = minimise(&problem, start, Stop::at_share(iterations, 1e-5));
    let mut causes: Vec<&'static str> = model.effects()[1..]
        .iter()
        .map(|e| e.card().cause)
        .collect();
    causes.sort_unstable();
    Refined {
        causes,
        optimum,
        model,
    }
}
