//! Causes by their names: the engine's answer with the parameters of the named laws, and the experiment
//! that would tell what it cannot.

use super::case::Case;
use super::lattice::beside_cutting;
use super::refine::Refined;
use super::{lattice, next};
use crate::effects::composite::Slot;
use crate::effects::{Composite, EFFECTS, Family};
use crate::findings::answer::{Cause, Group};
use crate::findings::gain::Gain;
use crate::fit::solution::unit_of;
use crate::measurement::load_cycle::LoadCycle;

/// Share of a coarse step by which an effect must move readings otherwise than digits that are cut off do, to be seen, rms: rounding has 0.29, another
/// one on each reading. A choice.
const OTHER: f64 = 0.2;
/// Rivals whose experiment is computed.
const RIVALS: usize = 2;

/// Causes and groups as they are named.
#[derive(Default)]
pub(super) struct Named {
    pub(super) causes: Vec<Cause>,
    pub(super) groups: Vec<Group>,
}

impl Named {
    pub(super) fn extend(&mut self, other: Named) {
        self.causes.extend(other.causes);
        self.groups.extend(other.groups);
    }
}

impl Case<'_> {
    /// What the engine named, less what a coarse lattice hides.
    pub(super) fn name(&self, chosen: &Refined) -> Named {
        let answer = &self.found.answer;
        let with_values = |cause: &Cause| Cause {
            parameters: self.parameters(chosen, cause.effect),
            ci95: self.intervals(chosen, cause.effect),
            ..cause.clone()
        };
        let told = |group: &Group| Group {
            would_tell: self.would_tell(chosen, &group.effects),
            ..group.clone()
        };
        let causes = answer.causes.iter();
        let causes = causes.filter(|c| self.is_seen(c.effect, &c.gain));
        let causes: Vec<Cause> = causes.map(with_values).collect();
        // where something is left, a size that may be nothing is what the law made of that
        let is_left = self.restless || answer.is_open();
        let may_be_nothing = |c: &Cause| c.ci95.iter().any(|(_, [low, _])| *low <= 0.0);
        let kept = causes
            .into_iter()
            .filter(|c| !(is_left && may_be_nothing(c)));
        let groups = answer.groups.iter();
        let groups = groups.filter(|g| self.is_seen(g.effects[0], &g.gain));
        Named {
            causes: kept.collect(),
            groups: groups.map(told).collect(),
        }
    }

    /// Whether an effect is seen through a coarse lattice of readings: it moves them by more than digits that are cut off, or is of another
    /// shape.
    fn is_seen(&self, effect: &str, gain: &Gain) -> bool {
        let Some(step) = self.step else { return true };
        let mut blamed = self.found.blamed.iter().filter(|b| b.effect == effect);
        let is_other = blamed.any(|b| beside_cutting(&b.part, &self.data.reading) > OTHER * step);
        self.is_real(gain) || gain.is_real() && is_other
    }

    /// The schedule under which the laws of a group would differ most, each fitted to these data.
    fn would_tell(&self, chosen: &Refined, effects: &[&'static str]) -> String {
        let swapped = |other: &&'static str| {
            let own = chosen.causes.iter().copied();
            let kept = own.filter(|c| *c != effects[0]);
            self.laws(&kept.chain([*other]).collect::<Vec<_>>())
        };
        let others: Vec<Refined> = effects[1..].iter().take(RIVALS).map(swapped).collect();
        let rivals: Vec<(&Composite, &[f64])> = others
            .iter()
            .map(|r| (&r.model, &r.optimum.p[..]))
            .collect();
        let winner = (&chosen.model, &chosen.optimum.p[..]);
        let proposal = next::propose(winner, &rivals, &self.data, self.colour.rms);
        format!(
            "{} (separates them by {:.0} nats)",
            proposal.about, proposal.separation
        )
    }

    /// Runners-up of a cause.
    pub(super) fn alternatives(&self, cause: &str) -> Vec<(&'static str, String, f64)> {
        let own = self.found.answer.causes.iter().find(|c| c.effect == cause);
        own.map_or_else(Vec::new, |c| c.alternatives.clone())
    }

    /// The parameters of the law of a cause; none where the law itself, fitted beside the others, has nothing of it: then only
    /// the shape that its family measured is known.
    pub(super) fn parameters(
        &self,
        chosen: &Refined,
        cause: &str,
    ) -> Vec<(&'static str, f64, &'static str)> {
        let slots = chosen.model.slots();
        let own = slots
            .iter()
            .zip(&chosen.optimum.p)
            .filter(|(s, _)| s.effect.card().cause == cause);
        let nothing = |(s, v): &(&Slot, &f64)| s.parameter.bounds.0 == 0.0 && **v <= f64::EPSILON;
        if own.clone().any(|one| nothing(&one)) {
            return Vec::new();
        }
        let told = own.map(|(s, v)| {
            let unit = unit_of(s.parameter.scale, self.file.port);
            (s.parameter.name, *v, unit)
        });
        // rows that are counted are no seconds
        told.filter(|p| !(self.file.counts_rows && p.2 == "s"))
            .collect()
    }

    pub(super) fn name_lattice(&self) -> Named {
        let causes = self.step.map(|step| {
            let rms = self.colour.rms.max(step / 12.0_f64.sqrt());
            let gain = lattice::gain(step, rms, self.colour.relative_error());
            Cause {
                effect: "quantization",
                site: "sensor".into(),
                probability: lattice::CERTAINTY,
                summary: summary("quantization"),
                alternatives: Vec::new(),
                ci95: Vec::new(),
                parameters: vec![("step", step, self.file.port.deflection_unit())],
                gain,
            }
        });
        Named {
            causes: causes.into_iter().collect(),
            groups: Vec::new(),
        }
    }
}

/// Measurement effects sit at the sensor, physics at the joint.
pub(super) fn site(file: &LoadCycle, cause: &str) -> String {
    let family = EFFECTS
        .iter()
        .find(|e| e.card().cause == cause)
        .map(|e| e.card().family);
    match family {
        Some(Family::Measurement) => "sensor".into(),
        _ => file.site(),
    }
}

/// What a cause is, one sentence.
pub fn summary(cause: &str) -> &'static str {
    crate::effects::named(cause).map_or("", |effect| effect.card().summary)
}
