//! What an effect looks like, and which others look like it: computed, not remembered.

use crate::effects::{Composite, EFFECTS, Effect, contract::Role};
use crate::experiments::schedule::SCHEDULES;
use crate::fit::candidates::Candidates;
use crate::fit::observation::Observation;

/// An effect over three constant cycles, in relative units.
pub struct Picture {
    /// Load over the largest.
    pub load: Vec<f64>,
    /// Deflection over the elastic one.
    pub deflection: Vec<f64>,
    /// What a straight line through the origin leaves.
    pub misfit: Vec<f64>,
}

/// Another effect that imitates.
pub struct LookAlike {
    /// Its name.
    pub effect: &'static str,
    /// Share of the variance that its best curve leaves.
    pub left: f64,
}

/// Rows of the picture.
const ROWS: usize = 360;
/// Size of the effect in the picture, in units of its first grid value.
const SIZE: f64 = 1.5;

fn scene(effect: &'static dyn Effect) -> (Observation, Vec<f64>) {
    let (time, load) = SCHEDULES[0].history(3, 1.0, 0.05, 3.05 / ROWS as f64, 1.0);
    let elastic = load.clone();
    let plain = Observation::from_channels(time, load, elastic, 1);
    let model = Composite::new(&[effect]);
    let mut p = model.start(&plain.scene);
    if let Some(amplitude) = p.get_mut(1) {
        *amplitude *= SIZE;
    }
    let reading = model.predict(&p, &plain.scene);
    (plain, reading)
}

/// How an effect looks.
pub fn picture(effect: &'static dyn Effect) -> Picture {
    let (plain, deflection) = scene(effect);
    let load = plain.scene.load;
    let (ll, ly) = load
        .iter()
        .zip(&deflection)
        .fold((0.0, 0.0), |(a, b), (l, y)| (a + l * l, b + l * y));
    let misfit = load
        .iter()
        .zip(&deflection)
        .map(|(l, y)| y - ly / ll * l)
        .collect();
    Picture {
        load,
        deflection,
        misfit,
    }
}

/// The effects that imitate this one best, the best first.
pub fn look_alikes(effect: &'static dyn Effect) -> Vec<LookAlike> {
    let (plain, reading) = scene(effect);
    let data = Observation::from_channels(plain.scene.time, plain.scene.load, reading, 1);
    let library: Vec<_> = EFFECTS
        .iter()
        .copied()
        .filter(|e| e.role() == Role::Shape && e.card().cause != effect.card().cause)
        .collect();
    let candidates = Candidates::new(&library, &data);
    let colour = crate::signal::colour::Colour::white(data.rows(), 1.0);
    let normal = crate::fit::normal::Normal::new(&candidates, &colour);
    let mut found: Vec<LookAlike> = Vec::new();
    for atom in 0..candidates.atoms.len() {
        let Some(single) = normal.single(atom) else {
            continue;
        };
        if candidates.atoms[atom].one_signed && single.amplitudes[0] < 0.0 {
            continue;
        }
        let left = (1.0 - 2.0 * single.nats / normal.base.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let name = candidates.cause(atom);
        match found.iter_mut().find(|l| l.effect == name) {
            Some(known) => known.left = known.left.min(left),
            None => found.push(LookAlike { effect: name, left }),
        }
    }
    found.sort_by(|a, b| a.left.total_cmp(&b.left));
    found
}
