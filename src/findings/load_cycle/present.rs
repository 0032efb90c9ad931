//! A present simulation that is more than a straight spring: an earlier fit, or the gap that a robot
//! file states. What it has already is named only where these data contradict it.

use super::refine::Refined;
use crate::effects::contract::MOST;
use crate::effects::{Composite, Effect, Scene};

/// The model that simulates at present.
#[derive(Clone)]
pub struct Present {
    /// Its effects, spring first.
    pub model: Composite,
    /// Their parameters, SI.
    pub p: Vec<f64>,
    /// Load and deflection against which its relative laws are defined; the record's own if unknown.
    pub scale: Option<(f64, f64)>,
    /// Whether the shapes of its laws are known, or only their amplitudes.
    pub shapes: bool,
}

/// One effect with its parameters.
type Part = (&'static dyn Effect, Vec<f64>);

fn parts(model: &Composite, p: &[f64]) -> Vec<Part> {
    let mut rest = p;
    let part = |effect: &&'static dyn Effect| {
        let (own, after) = rest.split_at(effect.card().parameters.len());
        rest = after;
        (*effect, own.to_vec())
    };
    model.effects().iter().map(part).collect()
}

fn assembled(parts: &[Part]) -> (Composite, Vec<f64>) {
    let effects: Vec<&'static dyn Effect> = parts.iter().map(|part| part.0).collect();
    let model = Composite::new(&effects);
    let own = |effect: &&'static dyn Effect| {
        let name = effect.card().name;
        let found = parts.iter().find(|part| part.0.card().name == name);
        found.map_or_else(Vec::new, |part| part.1.clone())
    };
    let p = model.effects().iter().flat_map(own).collect();
    (model, p)
}

pub(super) fn without(model: &Composite, p: &[f64], causes: &[&str]) -> (Composite, Vec<f64>) {
    let mut rest = parts(model, p);
    rest.retain(|part| !causes.contains(&part.0.card().cause));
    assembled(&rest)
}

pub(super) fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = values.fold((0.0, 0usize), |(sum, n), v| (sum + v * v, n + 1));
    (sum / n.max(1) as f64).sqrt()
}

/// A curve without what a spring of another stiffness would make of it.
pub(super) fn less_spring(mut curve: Vec<f64>, load: &[f64]) -> Vec<f64> {
    let own: f64 = load.iter().map(|m| m * m).sum();
    let cross: f64 = load.iter().zip(&curve).map(|(m, y)| m * y).sum();
    let share = cross / own.max(f64::MIN_POSITIVE);
    curve
        .iter_mut()
        .zip(load)
        .for_each(|(y, m)| *y -= share * m);
    curve
}

impl Present {
    /// The causes that it has, in the order of its effects.
    pub fn causes(&self) -> Vec<&'static str> {
        let effects = self.model.effects().iter().skip(1);
        effects.map(|effect| effect.card().cause).collect()
    }

    /// The record, with the scales that its laws were fitted against.
    fn scene(&self, scene: &Scene) -> Scene {
        let (load_scale, deflection_scale) = self
            .scale
            .unwrap_or((scene.load_scale, scene.deflection_scale));
        Scene {
            load_scale,
            deflection_scale,
            ..scene.clone()
        }
    }

    /// What it predicts beyond its spring; of one cause, if one is given.
    pub(super) fn beyond_spring(&self, scene: &Scene, cause: Option<&str>) -> Vec<f64> {
        let scene = self.scene(scene);
        let all = self.causes();
        let others: Vec<&str> = all
            .into_iter()
            .filter(|c| cause.is_some_and(|cause| cause != *c))
            .collect();
        let (model, p) = without(&self.model, &self.p, &others);
        let predicted = model.predict(&p, &scene);
        let spring = scene.load.iter().map(|load| load / self.p[0]);
        predicted.iter().zip(spring).map(|(f, s)| f - s).collect()
    }

    /// What it predicts: with its own spring, or with the spring that suits the readings best.
    pub(super) fn predict(&self, scene: &Scene, suited_to: Option<&[f64]>) -> Vec<f64> {
        let beyond = self.beyond_spring(scene, None);
        let compliance = suited_to.map_or(1.0 / self.p[0], |reading| {
            let rows = scene.load.iter().zip(reading).zip(&beyond);
            let (mut own, mut cross) = (0.0, 0.0);
            for ((load, reading), beyond) in rows {
                own += load * load;
                cross += load * (reading - beyond);
            }
            cross / own.max(f64::MIN_POSITIVE)
        });
        let rows = scene.load.iter().zip(&beyond);
        rows.map(|(load, beyond)| load * compliance + beyond)
            .collect()
    }

    /// The found model with everything of this one that was not sought out of it.
    pub(super) fn extended(&self, chosen: &Refined, gone: &[&str]) -> (Composite, Vec<f64>) {
        let mut all = parts(&chosen.model, &chosen.optimum.p);
        let kept = parts(&self.model, &self.p).into_iter().skip(1);
        let kept = kept.filter(|part| {
            let cause = part.0.card().cause;
            !chosen.causes.contains(&cause) && !gone.contains(&cause)
        });
        all.extend(kept);
        let (model, p) = assembled(&all);
        match model.len() <= MOST {
            true => (model, p),
            false => (chosen.model.clone(), chosen.optimum.p.clone()),
        }
    }
}
