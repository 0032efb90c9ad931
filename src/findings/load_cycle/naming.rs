//! Causes by their names: what is certain as a cause, what has stand-ins as a group.

use super::case::Case;
use super::refine::Refined;
use super::{lattice, next};
use crate::effects::{Composite, EFFECTS, Family};
use crate::findings::answer::{Cause, Group};
use crate::findings::gain::Gain;
use crate::fit::solution::unit_of;

/// A stand-in with at least this share of the winner's probability cannot be ruled out.
pub(super) const AMBIGUOUS: f64 = 0.03;

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
    pub(super) fn name(&self, chosen: &Refined) -> Named {
        let mut named = Named::default();
        for cause in &chosen.causes {
            let stand_ins = self.posterior.stand_ins(&chosen.causes, cause, AMBIGUOUS);
            let gain = self.gain_of(chosen, cause);
            if stand_ins.is_empty() {
                named.causes.push(Cause {
                    effect: cause,
                    site: self.site(chosen, cause),
                    probability: self.posterior.inclusion(cause),
                    summary: summary(cause),
                    alternatives: self.alternatives(chosen, cause),
                    parameters: self.parameters(chosen, cause),
                    gain,
                });
            } else {
                named
                    .groups
                    .push(self.group(chosen, cause, &stand_ins, gain));
            }
        }
        named
    }

    /// Runners-up with their sites.
    pub(super) fn alternatives(
        &self,
        chosen: &Refined,
        cause: &'static str,
    ) -> Vec<(&'static str, String, f64)> {
        let others = self.posterior.stand_ins(&chosen.causes, cause, 1e-4);
        let placed = |(other, p): (&'static str, f64)| (other, self.site(chosen, other), p);
        others.into_iter().map(placed).collect()
    }

    fn group(
        &self,
        chosen: &Refined,
        cause: &'static str,
        stand_ins: &[(&'static str, f64)],
        gain: Gain,
    ) -> Group {
        let mut effects = vec![cause];
        effects.extend(stand_ins.iter().map(|s| s.0));
        let rivals: Vec<(&Composite, &[f64])> = stand_ins
            .iter()
            .filter_map(|(other, _)| {
                let mut set: Vec<_> = chosen
                    .causes
                    .iter()
                    .copied()
                    .filter(|c| *c != cause)
                    .chain([*other])
                    .collect();
                set.sort_unstable();
                let index = self.posterior.sets.iter().find(|s| s.0 == set)?.2?;
                Some((
                    &self.refined[index].model,
                    &self.refined[index].optimum.p[..],
                ))
            })
            .collect();
        let noise = self.screen.colour.rms;
        let proposal = next::propose(
            (&chosen.model, &chosen.optimum.p),
            &rivals,
            &self.data,
            noise,
        );
        let sites = effects.iter().map(|e| self.site(chosen, e)).collect();
        let would_tell = format!(
            "{} (separates them by {:.0} nats)",
            proposal.about, proposal.separation
        );
        Group {
            effects,
            sites,
            would_tell,
            gain,
        }
    }

    /// Measurement effects sit at the sensor, physics at the joint.
    pub(super) fn site(&self, chosen: &Refined, cause: &str) -> String {
        let known = chosen
            .model
            .effects()
            .iter()
            .copied()
            .chain(EFFECTS.iter().copied());
        let family = known
            .filter(|e| e.card().cause == cause)
            .map(|e| e.card().family)
            .next();
        match family {
            Some(Family::Measurement) => "sensor".into(),
            _ => self.file.site(),
        }
    }

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
        own.map(|(s, v)| {
            (
                s.parameter.name,
                *v,
                unit_of(s.parameter.scale, self.file.port),
            )
        })
        .collect()
    }

    pub(super) fn name_lattice(&self) -> Named {
        let causes = self.step.map(|step| {
            let rms = self.screen.colour.rms.max(step / 12.0_f64.sqrt());
            let gain = lattice::gain(step, rms, self.screen.colour.relative_error());
            Cause {
                effect: "quantization",
                site: "sensor".into(),
                probability: lattice::CERTAINTY,
                summary: summary("quantization"),
                alternatives: Vec::new(),
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

/// What a cause is, one sentence.
pub fn summary(cause: &str) -> &'static str {
    crate::effects::named(cause).map_or("", |effect| effect.card().summary)
}
