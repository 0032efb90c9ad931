//! Several effects as one: the composite wears the face of its parts.

use super::contract::{Effect, MOST, Parameter, Tangent};
use super::scene::Scene;
use super::{EFFECTS, SPRING};
use crate::ground::dual::{Dual, Scalar};
use crate::ground::problem::{Outcome, Problem};

/// A spring with further effects, in the order of the table: physics, then the measurement chain.
#[derive(Clone)]
pub struct Composite {
    effects: Vec<&'static dyn Effect>,
}

/// Where a parameter of a composite comes from.
#[derive(Clone, Copy)]
pub struct Slot {
    /// The effect.
    pub effect: &'static dyn Effect,
    /// Its parameter.
    pub parameter: &'static Parameter,
    /// True for the first parameter of an effect.
    pub amplitude: bool,
}

impl Slot {
    /// An amplitude that cannot be negative, and at zero of which the effect is absent.
    pub fn may_vanish(&self) -> bool {
        self.amplitude && self.parameter.bounds.0 == 0.0
    }
}

impl Composite {
    /// The spring and these effects (the spring may be among them).
    pub fn new(effects: &[&'static dyn Effect]) -> Self {
        let chosen = |candidate: &&'static dyn Effect| {
            let name = candidate.card().name;
            name == SPRING.card().name || effects.iter().any(|e| e.card().name == name)
        };
        Self {
            effects: in_order(chosen, effects),
        }
    }

    /// The spring and the effects with these names.
    pub fn named(names: &[&str]) -> Outcome<Self> {
        let effects = names
            .iter()
            .map(|name| {
                super::named(name).ok_or_else(|| {
                    let known: Vec<_> = EFFECTS.iter().map(|e| e.card().name).collect();
                    Problem::new(
                        format!("no effect is called `{name}`"),
                        format!("choose among: {}", known.join(", ")),
                    )
                })
            })
            .collect::<Outcome<Vec<_>>>()?;
        let composite = Self::new(&effects);
        if composite.len() > MOST {
            return Err(Problem::new(
                format!(
                    "these effects have {} parameters, more than {MOST}",
                    composite.len()
                ),
                "choose fewer effects",
            ));
        }
        Ok(composite)
    }

    /// The parts.
    pub fn effects(&self) -> &[&'static dyn Effect] {
        &self.effects
    }

    /// The parameters in order, with their effects.
    pub fn slots(&self) -> Vec<Slot> {
        let mut slots = Vec::new();
        for effect in &self.effects {
            for (i, parameter) in effect.card().parameters.iter().enumerate() {
                slots.push(Slot {
                    effect: *effect,
                    parameter,
                    amplitude: i == 0,
                });
            }
        }
        slots
    }

    /// Number of parameters.
    pub fn len(&self) -> usize {
        self.effects.iter().map(|e| e.card().parameters.len()).sum()
    }

    /// Never: the spring is always there.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Predicted reading for parameters in SI.
    pub fn predict(&self, p: &[f64], scene: &Scene) -> Vec<f64> {
        let mut out = vec![0.0; scene.rows()];
        let elastic = self.elastic(p, scene);
        let mut rest = p;
        for effect in &self.effects {
            let (own, after) = rest.split_at(effect.card().parameters.len());
            effect.respond(own, scene, &elastic, &mut out);
            rest = after;
        }
        out
    }

    /// Prediction and its derivatives: one row of `MOST` per sample.
    pub fn differentiate(&self, p: &[f64], scene: &Scene) -> Vec<Tangent> {
        let variables: Vec<Tangent> = p
            .iter()
            .enumerate()
            .map(|(i, v)| Dual::variable(*v, i))
            .collect();
        let mut out = vec![Tangent::constant(0.0); scene.rows()];
        let elastic = self.elastic(&variables, scene);
        let mut rest = &variables[..];
        for effect in &self.effects {
            let (own, after) = rest.split_at(effect.card().parameters.len());
            effect.respond_tangent(own, scene, &elastic, &mut out);
            rest = after;
        }
        out
    }

    fn elastic<S: Scalar>(&self, p: &[S], scene: &Scene) -> Vec<S> {
        let compliance = S::constant(1.0) / p[0];
        scene.load.iter().map(|load| compliance * *load).collect()
    }

    /// Bounds of each parameter, SI.
    pub fn bounds(&self, scene: &Scene) -> Vec<(f64, f64)> {
        let slots = self.slots();
        let bound = |slot: &Slot| {
            let scale = slot.parameter.scale.of(scene);
            (
                slot.parameter.bounds.0 * scale,
                slot.parameter.bounds.1 * scale,
            )
        };
        slots.iter().map(bound).collect()
    }

    /// A middle start: every shape at the middle of its grid, every amplitude small.
    pub fn start(&self, scene: &Scene) -> Vec<f64> {
        let slots = self.slots();
        let middle = |slot: &Slot| {
            let grid = slot.parameter.grid;
            grid[grid.len() / 2] * slot.parameter.scale.of(scene)
        };
        slots.iter().map(middle).collect()
    }
}

fn in_order(
    chosen: impl Fn(&&'static dyn Effect) -> bool,
    extra: &[&'static dyn Effect],
) -> Vec<&'static dyn Effect> {
    let mut effects: Vec<_> = EFFECTS.iter().copied().filter(|e| chosen(e)).collect();
    // effects outside the table (a test's toy) come last, in the order given
    for effect in extra {
        if !effects.iter().any(|e| e.card().name == effect.card().name) {
            effects.push(*effect);
        }
    }
    effects
}
