//! Shapes set free before judging: grid error looks like a second cause.

use crate::effects::{Composite, Effect};
use crate::fit::candidates::Candidates;
use crate::fit::least_squares::{Optimum, Problem, Search, minimise};
use crate::fit::normal::Found;
use crate::fit::observation::Observation;
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
    let start = start(&model, found, candidates, data);
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

/// Start of the refinement: the shapes of the curves, the amplitudes of the linear fit, and the
/// compliance that goes with them.
fn start(
    model: &Composite,
    found: &Found,
    candidates: &Candidates,
    data: &Observation,
) -> Vec<f64> {
    let mut p = vec![candidates.stiffness];
    for effect in &model.effects()[1..] {
        let name = effect.card().name;
        let k = found
            .atoms
            .iter()
            .position(|i| candidates.library[candidates.atoms[*i].effect].card().name == name);
        if let Some(k) = k {
            let mut own = candidates.atoms[found.atoms[k]].p.clone();
            own[0] = found.amplitudes[k];
            p.extend(own);
        }
    }
    p[0] = stiffness_given(model, &p, data);
    p
}

/// Stiffness that fits best when the other effects stay as they are.
fn stiffness_given(model: &Composite, p: &[f64], data: &Observation) -> f64 {
    let with = model.predict(p, &data.scene);
    let (mut mm, mut my) = (0.0, 0.0);
    for ((load, y), f) in data.scene.load.iter().zip(&data.reading).zip(&with) {
        let other = f - load / p[0];
        mm += load * load;
        my += load * (y - other);
    }
    let compliance = my / mm;
    if compliance.is_finite() && compliance > 0.0 {
        1.0 / compliance
    } else {
        p[0]
    }
}
