//! A present simulation that is more than a straight spring: an earlier fit, or the gap that a robot
//! file states. What it has already is named only where these data contradict it.

use super::case::Case;
use super::naming::{Named, summary};
use super::refine::Refined;
use super::unseen::{Split, gain, held_out};
use crate::effects::contract::MOST;
use crate::effects::{Composite, Effect, Scene};
use crate::findings::answer::Cause;
use crate::fit::solution::unit_of;
use nalgebra::DMatrix;

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

/// A law whose curve moves by less than this share of its own size is the same law.
const SAME: f64 = 0.1;
/// Squared distance in standard errors beyond which a value has changed: per law, and per parameter.
const MOVED: (f64, f64) = (8.3, 2.6);
/// Scales within this share of each other are the same.
const SAME_SCALE: f64 = 0.05;

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

fn without(model: &Composite, p: &[f64], causes: &[&str]) -> (Composite, Vec<f64>) {
    let mut rest = parts(model, p);
    rest.retain(|part| !causes.contains(&part.0.card().cause));
    assembled(&rest)
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = values.fold((0.0, 0usize), |(sum, n), v| (sum + v * v, n + 1));
    (sum / n.max(1) as f64).sqrt()
}

/// A curve without what a spring of another stiffness would make of it.
fn less_spring(mut curve: Vec<f64>, load: &[f64]) -> Vec<f64> {
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
    fn beyond_spring(&self, scene: &Scene, cause: Option<&str>) -> Vec<f64> {
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

/// What these data say of a cause that the present model has.
enum Said {
    Same,
    Changed(Cause),
}

impl Case<'_> {
    /// The causes that the present model lacks, or has with another value; and those of it that
    /// are gone.
    pub(super) fn beyond(&self, present: &Present, chosen: &Refined, mut named: Named) -> Named {
        for cause in present.causes() {
            let said = self.said(present, chosen, cause);
            let found = named.causes.iter().position(|c| c.effect == cause);
            let group = named.groups.iter().position(|g| g.effects.contains(&cause));
            match (found, group, said) {
                (Some(i), _, Said::Changed(new)) => named.causes[i] = new,
                (Some(i), _, Said::Same) => {
                    named.causes.remove(i);
                }
                (None, Some(i), Said::Same) => {
                    named.groups.remove(i);
                }
                (None, None, Said::Changed(gone)) => named.causes.push(gone),
                (None, _, _) => {}
            }
        }
        named
    }

    /// Compares a cause of the present model with what stands in its place in the chosen one.
    fn said(&self, present: &Present, chosen: &Refined, cause: &'static str) -> Said {
        let scene = &self.data.scene;
        let place = self.in_place(chosen, cause);
        let (model, p) = (&chosen.model, &chosen.optimum.p);
        let whole = model.predict(p, scene);
        let (bare, q) = without(model, p, place.as_slice());
        let bare = bare.predict(&q, scene);
        let found = whole.iter().zip(&bare).map(|(a, b)| a - b).collect();
        let found = less_spring(found, &scene.load);
        let own = less_spring(present.beyond_spring(scene, Some(cause)), &scene.load);
        let moved = rms(found.iter().zip(&own).map(|(a, b)| a - b));
        let size = rms(found.iter().copied()).max(rms(own.iter().copied()));
        let after = held_out(model, p, &self.data, &self.screen.colour, Split::Cycles);
        let errors = after.iter().zip(&found).zip(&own);
        let before: Vec<f64> = errors.map(|((e, new), old)| e + new - old).collect();
        let gain = gain(&before, &after, &self.data);
        if moved <= SAME * size || !self.is_real(&gain) || !self.moved(present, chosen, cause) {
            return Said::Same;
        }
        let gone = place.is_none();
        let probability = self.posterior.inclusion(cause);
        Said::Changed(Cause {
            effect: cause,
            site: self.site(chosen, cause),
            probability: if gone { 1.0 - probability } else { probability },
            summary: match gone {
                true => "The present model has it, these data do not.",
                false => summary(cause),
            },
            alternatives: self.alternatives(chosen, cause),
            parameters: self.values(present, chosen, cause),
            gain,
        })
    }

    /// The cause of the chosen set that stands for this one: itself, or one it cannot be told from.
    fn in_place(&self, chosen: &Refined, cause: &'static str) -> Option<&'static str> {
        let own = chosen.causes.iter().copied().find(|c| *c == cause);
        own.or_else(|| {
            let rivals = |c: &&'static str| {
                let others = self
                    .posterior
                    .stand_ins(&chosen.causes, c, super::naming::AMBIGUOUS);
                others.iter().any(|other| other.0 == cause)
            };
            chosen.causes.iter().copied().find(|c| rivals(c))
        })
    }

    /// Amplitude found and amplitude before.
    fn values(
        &self,
        present: &Present,
        chosen: &Refined,
        cause: &str,
    ) -> Vec<(&'static str, f64, &'static str)> {
        let slots = present.model.slots();
        let before = slots
            .iter()
            .position(|s| s.amplitude && s.effect.card().cause == cause);
        let mut list = self.parameters(chosen, cause);
        if let Some(j) = before {
            let parameter = slots[j].parameter;
            let unit = unit_of(parameter.scale, self.file.port);
            if list.is_empty() {
                list.push((parameter.name, 0.0, unit));
            }
            list.push(("value_before", present.p[j], unit));
        }
        list
    }

    /// Whether a law's parameters differ by more than both fits' uncertainty. Laws that cannot be
    /// compared by parameters count as different.
    fn moved(&self, present: &Present, chosen: &Refined, cause: &str) -> bool {
        let scene = &self.data.scene;
        let alike = |a: f64, b: f64| (a / b - 1.0).abs() < SAME_SCALE;
        let comparable = present.scale.is_none_or(|(load, deflection)| {
            alike(load, scene.load_scale) && alike(deflection, scene.deflection_scale)
        });
        let mut differences = Vec::new();
        let mut places = Vec::new();
        let old = present.model.slots();
        for (j, slot) in chosen.model.slots().iter().enumerate() {
            let card = slot.effect.card();
            let same = old.iter().position(|other| {
                other.effect.card().name == card.name && other.parameter.name == slot.parameter.name
            });
            if let (true, Some(i)) = (card.cause == cause, same)
                && (slot.amplitude || present.shapes)
            {
                let scale = chosen.optimum.scale[j];
                differences.push((chosen.optimum.p[j] - present.p[i]) / scale);
                places.push(j);
            }
        }
        let normal = chosen.optimum.jacobian.tr_mul(&chosen.optimum.jacobian);
        match normal.try_inverse() {
            Some(covariance) if comparable && !places.is_empty() => {
                let (first, each) = MOVED;
                distance(&covariance, &places, &differences) > first + each * places.len() as f64
            }
            _ => true,
        }
    }
}

/// Squared distance in standard errors, the earlier fit being as uncertain as this one.
fn distance(covariance: &DMatrix<f64>, places: &[usize], differences: &[f64]) -> f64 {
    let k = places.len();
    let both = DMatrix::from_fn(k, k, |a, b| 2.0 * covariance[(places[a], places[b])]);
    let difference = nalgebra::DVector::from_row_slice(differences);
    let solved = both.cholesky().map(|factor| factor.solve(&difference));
    solved.map_or(f64::INFINITY, |solved| difference.dot(&solved))
}
