//! From named causes to the verdict: what is left, and how far the present simulation is off.

use super::adequacy::{self, Adequacy, REPEATS};
use super::case::Case;
use super::diagnosis::Diagnosis;
use super::naming::Named;
use super::refine::Refined;
use super::structure;
use crate::effects::Composite;
use crate::findings::answer::{Answer, Candidate, Verdict};
use crate::fit::least_squares::Problem;

/// Structure counts as left when a test is below the first p-value and the unexplained share is above
/// the second number: what is seen beyond all doubt need be less to matter.
const LEFT: [(f64, f64); 2] = [(5e-5, 0.1), (1e-20, 0.05)];
/// Causes that leave so much of what they should explain need less proof that they are wrong.
const LITTLE_EXPLAINED: (f64, f64) = (5e-4, 0.25);
/// With more than this share unexplained the causes found are not the story.
const NOT_THE_STORY: f64 = 0.13;

impl Case<'_> {
    fn residual(&self, set: &Refined) -> Vec<f64> {
        let ignored = vec![false; self.data.rows()];
        let problem = Problem {
            model: &set.model,
            data: &self.data,
            colour: &self.screen.colour,
            ignored: &ignored,
        };
        problem.residual(&set.optimum.p)
    }

    pub(super) fn conclude(self, chosen: Refined, mut named: Named, scaled: bool) -> Diagnosis {
        let adequacy = adequacy::judge(
            &self.residual(&chosen),
            chosen.dimension + 1,
            self.base,
            &self.screen,
            &self.data,
        );
        let left = is_left(&adequacy, &chosen) && !self.within_step(&chosen);
        named.causes.sort_by(|a, b| {
            b.gain
                .reduction_percent
                .total_cmp(&a.gain.reduction_percent)
        });
        let verdict = verdict(&named, left, &adequacy);
        if verdict == Verdict::UnknownCause {
            // what the library could make of it is not the story: name nothing
            named = Named::default();
        }
        let (model, p) = self.extended(&chosen, &named);
        let extended = model.predict(&p, &self.data.scene);
        let simulated = self.simulated(scaled);
        let difference = |f: &[f64]| {
            self.data
                .reading
                .iter()
                .zip(f)
                .map(|(y, f)| y - f)
                .collect::<Vec<f64>>()
        };
        let noise = self.screen.colour.rms.min(rms(&difference(&extended)));
        let discrepancy = structure::discrepancy(&difference(&simulated), &self.data, noise);
        let before = discrepancy.rms * discrepancy.rms;
        let unexplained = structure::structure(
            &difference(&extended),
            &self.data,
            before,
            noise,
            adequacy.test,
        );
        let answer = Answer {
            verdict,
            discrepancy,
            causes: named.causes,
            groups: named.groups,
            unexplained,
            p_value: adequacy.p_value,
            candidates: self.table(),
            unit: self.file.port.deflection_unit(),
            noise: self.screen.colour.describe(),
        };
        Diagnosis {
            answer,
            adequacy,
            model,
            p,
            simulated,
            extended,
            imposed: false,
            data: self.data,
        }
    }

    /// Whether all that is left is smaller than a coarse lattice makes it.
    fn within_step(&self, chosen: &Refined) -> bool {
        let fitted = chosen.model.predict(&chosen.optimum.p, &self.data.scene);
        let square = |(y, f): (&f64, &f64)| (y - f) * (y - f);
        let left = self
            .data
            .reading
            .iter()
            .zip(&fitted)
            .map(square)
            .sum::<f64>()
            / fitted.len().max(1) as f64;
        self.step.is_some_and(|step| left.sqrt() < 0.5 * step)
    }

    /// The chosen model, with what the present one has and these data do not deny.
    fn extended(&self, chosen: &Refined, named: &Named) -> (Composite, Vec<f64>) {
        let Some(present) = &self.present else {
            return (chosen.model.clone(), chosen.optimum.p.clone());
        };
        let gone = named.causes.iter().map(|cause| cause.effect);
        let gone: Vec<&str> = gone.filter(|c| !chosen.causes.contains(c)).collect();
        present.extended(chosen, &gone)
    }

    /// What the present simulation predicts. Its stiffness is the nominal one where the stated
    /// spread does not cover the identified one; else the best within that spread.
    fn simulated(&self, scaled: bool) -> Vec<f64> {
        let scene = &self.data.scene;
        if let Some(present) = &self.present {
            return present.predict(scene, (!scaled).then_some(&self.data.reading[..]));
        }
        let stiffness = match self.file.facts.nominal_stiffness {
            Some(nominal) if scaled => nominal,
            _ => self.plain.optimum.p[0],
        };
        scene.load.iter().map(|m| m / stiffness).collect()
    }

    fn table(&self) -> Vec<Candidate> {
        let nats = |index: &Option<usize>| index.map_or(0.0, |i| self.refined[i].nats);
        self.posterior
            .sets
            .iter()
            .take(10)
            .map(|(c, p, i)| (c.iter().map(|c| c.to_string()).collect(), *p, nats(i)))
            .collect()
    }
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

fn is_left(adequacy: &Adequacy, chosen: &Refined) -> bool {
    let beyond = |(p, share): (f64, f64)| adequacy.p_value < p && adequacy.unexplained > share;
    LEFT.into_iter().any(beyond) || (!chosen.causes.is_empty() && beyond(LITTLE_EXPLAINED))
}

/// Whether the causes found are not the story: too much is left, or it repeats with the load as they
/// do, so that their law is not the joint's.
fn is_another_story(adequacy: &Adequacy) -> bool {
    adequacy.unexplained > NOT_THE_STORY || REPEATS.contains(&adequacy.test)
}

fn verdict(named: &Named, left: bool, adequacy: &Adequacy) -> Verdict {
    match (named.causes.is_empty() && named.groups.is_empty(), left) {
        (true, true) => Verdict::UnknownCause,
        (true, false) => Verdict::Sufficient,
        (false, true) if is_another_story(adequacy) => Verdict::UnknownCause,
        (false, true) => Verdict::PartlyExplained,
        (false, false) if named.causes.is_empty() => Verdict::CannotTell,
        (false, false) => Verdict::Explained,
    }
}
