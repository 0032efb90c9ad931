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
    /// Half the fall of the whitened sum of squares below the spring alone.
    pub nats: f64,
    /// Parameters beyond the spring.
    pub dimension: usize,
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
        optimum,
        model,
    }
}
