//! First guesses: the curves of the dictionary that fit best together, one for every effect.

use super::candidates::Candidates;
use super::normal::{Found, Normal};
use super::observation::Observation;
use crate::effects::{Composite, Effect};
use crate::signal::colour::Colour;

/// Starting points for a composite: for every curve of its last effect with the most curves, the
/// best companions found by exchange. The best few are returned.
pub fn starts(model: &Composite, data: &Observation, most: usize) -> Vec<Vec<f64>> {
    let effects: Vec<&'static dyn Effect> = model.effects()[1..].to_vec();
    let candidates = Candidates::new(&effects, data);
    let colour = Colour::white(data.rows(), data.scene.deflection_scale * 1e-3);
    let normal = Normal::new(&candidates, &colour);
    let mut found: Vec<Found> = (0..candidates.atoms.len())
        .filter_map(|seed| exchange(seed, &candidates, &normal))
        .collect();
    found.sort_by(|a, b| b.nats.total_cmp(&a.nats));
    found.dedup_by(|a, b| a.atoms == b.atoms);
    let mut points: Vec<Vec<f64>> = found
        .iter()
        .take(most)
        .map(|f| start_of(model, f, &candidates, data))
        .collect();
    points.push(model.start(&data.scene));
    points
}

/// Grows a set around one curve: each further effect brings the curve that helps most.
fn exchange(seed: usize, candidates: &Candidates, normal: &Normal) -> Option<Found> {
    let mut set = normal.single(seed)?;
    for effect in 0..candidates.library.len() {
        if set
            .atoms
            .iter()
            .any(|i| candidates.atoms[*i].effect == effect)
            || set.atoms.len() == 3
        {
            continue;
        }
        let of_effect =
            (0..candidates.atoms.len()).filter(|i| candidates.atoms[*i].effect == effect);
        let grown = of_effect.filter_map(|i| {
            let mut atoms = set.atoms.clone();
            atoms.push(i);
            normal.solve(&atoms)
        });
        if let Some(best) = grown.max_by(|a, b| a.nats.total_cmp(&b.nats)) {
            set = best;
        }
    }
    Some(set)
}

/// Start of a refinement: the shapes of the curves, the amplitudes of the linear fit, and the
/// compliance that goes with them. Amplitudes of the wrong sign start small.
pub fn start_of(
    model: &Composite,
    found: &Found,
    candidates: &Candidates,
    data: &Observation,
) -> Vec<f64> {
    let mut p = vec![candidates.stiffness];
    for effect in &model.effects()[1..] {
        let name = effect.card().name;
        let is_it = |i: &usize| candidates.library[candidates.atoms[*i].effect].card().name == name;
        match found.atoms.iter().position(is_it) {
            Some(k) => {
                let atom = &candidates.atoms[found.atoms[k]];
                let wrong = atom.one_signed && found.amplitudes[k] <= 0.0;
                let mut own = atom.p.clone();
                own[0] = if wrong {
                    1e-3 * atom.p[0]
                } else {
                    found.amplitudes[k]
                };
                p.extend(own);
            }
            None => p.extend(middle(*effect, data)),
        }
    }
    p[0] = stiffness_given(model, &p, data);
    p
}

fn middle(effect: &dyn Effect, data: &Observation) -> Vec<f64> {
    let middle = |parameter: &crate::effects::Parameter| {
        parameter.grid[parameter.grid.len() / 2] * parameter.scale.of(&data.scene)
    };
    effect.card().parameters.iter().map(middle).collect()
}

/// Stiffness that fits best when the other effects stay as they are.
fn stiffness_given(model: &Composite, p: &[f64], data: &Observation) -> f64 {
    let with = model.predict(p, &data.scene);
    let (mut mm, mut my) = (0.0, 0.0);
    for ((load, y), f) in data.scene.load.iter().zip(&data.reading).zip(&with) {
        mm += load * load;
        my += load * (y - f + load / p[0]);
    }
    let compliance = my / mm;
    if compliance.is_finite() && compliance > 0.0 {
        1.0 / compliance
    } else {
        p[0]
    }
}
