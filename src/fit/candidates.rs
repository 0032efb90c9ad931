//! Every effect as a family of curves: its unit responses over the grid of its shapes.

use crate::effects::{Composite, Effect, Scene, contract::Role};
use crate::fit::observation::Observation;
use crate::signal::cosine::Cosine;

/// One curve of one effect: its response to a small amplitude, per unit of that amplitude.
pub struct Atom {
    /// Index of the effect in the library.
    pub effect: usize,
    /// Parameters of the effect, SI, at which it was made.
    pub p: Vec<f64>,
    /// Whether only one sign of the amplitude is possible.
    pub one_signed: bool,
    /// Cosine coefficients of the unit response.
    pub column: Vec<f64>,
}

/// Families of curves of a library for one observation.
pub struct Candidates {
    /// The effects that show by their shape.
    pub library: Vec<&'static dyn Effect>,
    /// All their curves.
    pub atoms: Vec<Atom>,
    /// Cosine coefficients of the load itself (the spring), per unit compliance.
    pub spring: Vec<f64>,
    /// Cosine coefficients of the readings.
    pub reading: Vec<f64>,
    /// Stiffness around which the curves were made.
    pub stiffness: f64,
}

impl Candidates {
    /// Makes all curves of the effects of `library` that enter by their shape.
    pub fn new(library: &[&'static dyn Effect], data: &Observation) -> Self {
        let library: Vec<_> = library
            .iter()
            .copied()
            .filter(|e| matches!(e.role(), Role::Shape | Role::Imposed))
            .collect();
        let stiffness = data.scene.load_scale / data.scene.deflection_scale;
        let mut atoms = Vec::new();
        for (index, effect) in library.iter().enumerate() {
            for p in grid(*effect, &data.scene) {
                atoms.extend(atom(index, *effect, p, stiffness, data));
            }
        }
        transform_all(&data.cosine, &mut atoms);
        let (mut spring, mut reading) = (data.scene.load.clone(), data.reading.clone());
        data.cosine.transform_pair(&mut spring, &mut reading);
        Self {
            library,
            atoms,
            spring,
            reading,
            stiffness,
        }
    }

    /// The cause that an atom speaks for.
    pub fn cause(&self, atom: usize) -> &'static str {
        self.library[self.atoms[atom].effect].card().cause
    }
}

/// All combinations of an effect's grid values, SI.
fn grid(effect: &dyn Effect, scene: &Scene) -> Vec<Vec<f64>> {
    let mut points: Vec<Vec<f64>> = vec![Vec::new()];
    for parameter in effect.card().parameters {
        let scale = parameter.scale.of(scene);
        points = points
            .into_iter()
            .flat_map(|point| {
                parameter.grid.iter().map(move |value| {
                    let mut longer = point.clone();
                    longer.push(value * scale);
                    longer
                })
            })
            .collect();
    }
    points
}

fn atom(
    index: usize,
    effect: &'static dyn Effect,
    p: Vec<f64>,
    stiffness: f64,
    data: &Observation,
) -> Option<Atom> {
    let model = Composite::new(&[effect]);
    let mut with = vec![stiffness];
    with.extend(&p);
    let mut column = model.predict(&with, &data.scene);
    for (c, load) in column.iter_mut().zip(&data.scene.load) {
        *c = (*c - load / stiffness) / p[0];
    }
    let size: f64 = column.iter().map(|c| c * c).sum();
    let one_signed = effect.card().parameters[0].bounds.0 >= 0.0;
    (size.is_finite() && size > 0.0).then_some(Atom {
        effect: index,
        p,
        one_signed,
        column,
    })
}

fn transform_all(cosine: &Cosine, atoms: &mut [Atom]) {
    for pair in atoms.chunks_mut(2) {
        match pair {
            [a, b] => cosine.transform_pair(&mut a.column, &mut b.column),
            [a] => cosine.transform(&mut a.column),
            _ => {}
        }
    }
}
