//! From named causes to the verdict: what is left, and how far the present simulation is off.

use super::case::{Case, HIDES};
use super::diagnosis::Diagnosis;
use super::naming::Named;
use super::refine::Refined;
use super::structure;
use crate::effects::Composite;
use crate::findings::answer::{Answer, Verdict};
use crate::ground::stats::{difference, rms};

impl Case<'_> {
    /// The diagnosis. `shapes`: what changes the curve; `others`: scales and lattices.
    pub(super) fn conclude(
        self,
        chosen: Refined,
        (shapes, others): (Named, Named),
        scaled: bool,
    ) -> Diagnosis {
        let judged = self.found.answer.verdict;
        let left = (self.found.answer.is_open() || self.restless) && !self.within_step();
        let story = !(left && judged == Verdict::UnknownCause);
        let mut named = if story { shapes } else { Named::default() };
        named.extend(others);
        named.causes.sort_by(|a, b| {
            b.gain
                .reduction_percent
                .total_cmp(&a.gain.reduction_percent)
        });
        let (model, p) = self.extended(&chosen, &named);
        let extended = model.predict(&p, &self.data.scene);
        let simulated = self.simulated(scaled);
        let misses = |f: &[f64]| -> Vec<f64> { difference(&self.data.reading, f) };
        let missed = misses(&simulated);
        let noise = self.found.answer.discrepancy.noise_rms;
        let discrepancy = structure::discrepancy(&missed, &self.data, noise);
        let answer = Answer {
            verdict: Verdict::of(named.causes.len(), named.groups.len(), left),
            discrepancy,
            causes: named.causes,
            groups: named.groups,
            unstated: self.present.is_none() && self.file.facts.nominal_stiffness.is_none(),
            doubts: Vec::new(),
            ..self.found.answer.clone()
        };
        Diagnosis {
            answer,
            model,
            p,
            simulated,
            extended,
            imposed: false,
            judgement: Some(self.judgement),
            data: self.data,
        }
    }

    /// Whether all that is left is smaller than a coarse lattice makes it.
    fn within_step(&self) -> bool {
        self.step
            .is_some_and(|step| rms(&self.found.left) < HIDES * step)
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
}
