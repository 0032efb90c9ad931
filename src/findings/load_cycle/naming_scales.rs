//! Scale errors by their names: lever, inclined laser or stiffness.

use super::case::Case;
use super::naming::{Named, summary};
use super::refine::Refined;
use super::scales::{self, ScaleFinding};
use super::unseen::{Split, gain, held_out};
use crate::experiments::load_cycle::{settle, settled_cycle};
use crate::findings::answer::{Cause, Group};
use crate::findings::gain::Gain;
use crate::ground::stats::{difference, largest};

/// A law that misses the truth by this share of its own size still counts as right.
const FORMULA_ERROR: f64 = 0.07;

impl Case<'_> {
    /// Scale errors: the chosen model's own spring and the plain slope must both be off, to one side.
    pub(super) fn scales(&self, chosen: &Refined) -> Vec<ScaleFinding> {
        let excess = match (self.excess(chosen), self.excess(&self.plain)) {
            (Some(a), Some(b)) if a * b <= 0.0 => Some(0.0),
            (Some(a), Some(b)) if b.abs() < a.abs() => Some(b),
            (first, _) => first,
        };
        scales::judge(self.file, excess, self.relative_error(chosen)).findings
    }

    /// How far a set's stiffness is from the nominal one.
    fn excess(&self, chosen: &Refined) -> Option<f64> {
        let (low, high) = self.data.load_range();
        let (load, deflection) = settled_cycle(
            &chosen.model,
            &chosen.optimum.p,
            &self.data.scene,
            low,
            high,
        );
        let settled = settle(&load, &deflection);
        scales::nominal_excess(self.file, chosen.optimum.p[0], &settled)
    }

    /// Relative standard error of the spring, with what an error of the laws beside it may take over.
    fn relative_error(&self, chosen: &Refined) -> f64 {
        let spring = chosen.optimum.p[0];
        let elastic: Vec<f64> = self.data.scene.load.iter().map(|m| m / spring).collect();
        let whole = chosen.model.predict(&chosen.optimum.p, &self.data.scene);
        let beside: Vec<f64> = difference(&whole, &elastic);
        let taken = FORMULA_ERROR * largest(&beside) / largest(&elastic).max(f64::MIN_POSITIVE);
        self.spring_error(chosen).hypot(taken)
    }

    /// Relative standard error of the spring by the noise.
    fn spring_error(&self, chosen: &Refined) -> f64 {
        let normal = chosen.optimum.jacobian.tr_mul(&chosen.optimum.jacobian);
        let inverse = normal
            .try_inverse()
            .map_or(0.0, |m| m[(0, 0)].max(0.0).sqrt());
        (inverse * chosen.optimum.scale[0] / chosen.optimum.p[0])
            .abs()
            .min(0.5)
    }

    pub(super) fn name_scales(&self, findings: &[ScaleFinding], chosen: &Refined) -> Named {
        let mut named = Named::default();
        for finding in findings {
            let gain = self.scale_gain(finding.excess, chosen);
            let (effect, site, probability) = finding.candidates[0].clone();
            if finding.candidates.len() == 1 {
                named.causes.push(Cause {
                    effect,
                    site,
                    probability,
                    summary: summary(effect),
                    alternatives: Vec::new(),
                    ci95: Vec::new(),
                    parameters: vec![("excess", finding.excess, "1")],
                    gain,
                });
            } else {
                named.groups.push(Group {
                    effects: finding.candidates.iter().map(|c| c.0).collect(),
                    sites: finding.candidates.iter().map(|c| c.1.clone()).collect(),
                    would_tell: self.scale_experiment(finding),
                    gain,
                    probability,
                });
            }
        }
        named
    }

    /// What separates scale errors, with the separation it would give.
    fn scale_experiment(&self, finding: &ScaleFinding) -> String {
        let stated = self.file.facts.lever_rel_std;
        let lever = stated.unwrap_or(scales::LEVER_SPREAD);
        let sigma = finding.excess.abs() / (std::f64::consts::SQRT_2 * lever).max(1e-6);
        if finding.candidates.iter().any(|c| c.1 == "load") {
            return "measure the lever of the load and the direction in which it pulls, or hang it at a second lever: what is wrong of the lever changes with it, the joint does not".into();
        }
        match self.file.second.is_some() {
            true => format!(
                "repeat with the laser at another lever and set square to the motion: a wrong lever then reads differently by {sigma:.0} standard deviations, an inclined laser does not"
            ),
            false => format!(
                "repeat with a second lever length (or a second laser): a sensor's error would then show by {sigma:.0} standard deviations"
            ),
        }
    }

    /// Gain of putting the scale right: the chosen model with its deflection stretched back.
    fn scale_gain(&self, excess: f64, chosen: &Refined) -> Gain {
        let after = held_out(
            &chosen.model,
            &chosen.optimum.p,
            &self.data,
            &self.colour,
            Split::Cycles,
        );
        let wrong = excess / (1.0 + excess);
        let before: Vec<f64> = after
            .iter()
            .zip(&self.data.reading)
            .map(|(a, y)| a + wrong * (y - a))
            .collect();
        gain(&before, &after, &self.data)
    }
}
