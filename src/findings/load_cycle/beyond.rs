//! What these data say of the causes that the present simulation has already: the same, another value,
//! or gone.

use super::case::Case;
use super::naming::{Named, site, summary};
use super::present::{Present, less_spring, rms, without};
use super::refine::Refined;
use super::unseen::{Split, gain, held_out};
use crate::findings::answer::{Cause, LIMIT};
use crate::fit::parameter::Z95;
use crate::fit::solution::unit_of;
use crate::ground::stats::difference;
use nalgebra::{DMatrix, DVector};

/// A law whose curve moves by less than this share of its own size is the same law.
const SAME: f64 = 0.1;
/// Squared distance in standard errors beyond which a value has changed: per law, and per parameter.
const MOVED: (f64, f64) = (8.3, 2.6);
/// Scales within this share of each other are the same.
const SAME_SCALE: f64 = 0.05;

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
        let found = difference(&whole, &bare);
        let found = less_spring(found, &scene.load);
        let own = less_spring(present.beyond_spring(scene, Some(cause)), &scene.load);
        let moved = rms(found.iter().zip(&own).map(|(a, b)| a - b));
        let size = rms(found.iter().copied()).max(rms(own.iter().copied()));
        let after = held_out(model, p, &self.data, &self.colour, Split::Cycles);
        let errors = after.iter().zip(&found).zip(&own);
        let before: Vec<f64> = errors.map(|((e, new), old)| e + new - old).collect();
        let gain = gain(&before, &after, &self.data);
        let is_doubtful = self.found.doubted.iter().any(|b| b.effect == cause);
        if moved <= SAME * size
            || is_doubtful
            || !self.is_real(&gain)
            || !self.moved(present, chosen, cause)
        {
            return Said::Same;
        }
        let gone = place.is_none();
        let answer = &self.found.answer;
        let stated = answer.causes.iter().find(|c| c.effect == cause);
        let stated = stated.map_or(1.0, |c| c.probability);
        let probability = self.inclusion(cause).min(stated);
        Said::Changed(Cause {
            effect: cause,
            site: site(self.file, cause),
            probability: if gone { 1.0 - probability } else { probability },
            summary: match gone {
                true => "The present model has it, these data do not.",
                false => summary(cause),
            },
            alternatives: self.alternatives(cause),
            ci95: Vec::new(),
            parameters: self.values(present, chosen, cause),
            gain,
        })
    }

    /// The cause of the chosen set that stands for this one: itself, or one it cannot be told from.
    fn in_place(&self, chosen: &Refined, cause: &'static str) -> Option<&'static str> {
        let own = chosen.causes.iter().copied().find(|c| *c == cause);
        let groups = self.found.answer.groups.iter();
        let mut groups = groups.filter(|g| g.effects.contains(&cause));
        own.or_else(|| groups.next().and_then(|g| g.effects.first().copied()))
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
                let limit = self.limit(present, chosen, cause, present.p[j]);
                list.extend(limit.map(|limit| (LIMIT, limit, unit)));
            }
            list.push(("value_before", present.p[j], unit));
        }
        list
    }

    /// The largest amplitude (95 %) that the data leave to a law of the present model that is not in
    /// the chosen one, its shapes as they were; `before`: its amplitude there.
    fn limit(&self, present: &Present, chosen: &Refined, cause: &str, before: f64) -> Option<f64> {
        let mut curve = present.beyond_spring(&self.data.scene, Some(cause));
        self.data.cosine.transform(&mut curve);
        self.colour.whiten(&mut curve);
        let own = DVector::from_vec(curve);
        let (columns, residual) = (&chosen.optimum.jacobian, &chosen.optimum.residual);
        let factor = columns.tr_mul(columns).cholesky()?;
        let rest = &own - columns * factor.solve(&columns.tr_mul(&own));
        let size = rest.norm_squared();
        let share = (rest.dot(residual) / size).abs() + Z95 / size.sqrt();
        let limit = share * before.abs();
        (limit.is_finite() && limit > 0.0).then_some(limit)
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
    let difference = DVector::from_row_slice(differences);
    let solved = both.cholesky().map(|factor| factor.solve(&difference));
    solved.map_or(f64::INFINITY, |solved| difference.dot(&solved))
}
