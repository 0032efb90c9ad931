//! Everything that is known about a file before causes are named, and which causes it takes.

use super::ambiguity::Posterior;
use super::comparison::Comparison;
use super::diagnosis::Settings;
use super::lattice;
use super::present::Present;
use super::refine::{Refined, refine_from};
use super::tints::Tints;
use super::unseen::{Split, gain, held_out};
use crate::effects::{Composite, shapes};
use crate::findings::gain::Gain;
use crate::fit::candidates::Candidates;
use crate::fit::observation::Observation;
use crate::fit::screen::{Screen, screen};
use crate::measurement::load_cycle::LoadCycle;

/// Probability of a set against the same set less one cause, below which that cause is not named.
const NEEDED: f64 = 0.9;

/// Steps of a lattice above this many times the noise at high frequency are coarse: their rounding,
/// step/√12, is then half of it or more.
const COARSE: f64 = 1.73;
/// Share of a coarse step that an effect must move the readings to be seen.
const HALF_STEP: f64 = 0.3;

/// A second screen counts if it makes the readings quieter by this many nats each.
const QUIETER: f64 = 0.03;

/// Everything that is known about a file before causes are named.
pub(super) struct Case<'a> {
    pub(super) file: &'a LoadCycle,
    pub(super) data: Observation,
    pub(super) screen: Screen,
    pub(super) refined: Vec<Refined>,
    pub(super) posterior: Posterior,
    pub(super) base: f64,
    pub(super) plain: Refined,
    /// The present simulation, where it is more than a straight spring.
    pub(super) present: Option<Present>,
    /// Step of a coarse lattice of readings.
    pub(super) step: Option<f64>,
}

pub(super) fn compare<'a>(file: &'a LoadCycle, settings: &Settings) -> Case<'a> {
    let mut data = Observation::of(file, settings.rows);
    let mut candidates = Candidates::new(&shapes(&settings.library), &data);
    let mut comparison = Comparison::new(screen(&data, &candidates), &candidates, &data);
    let wild = data.repair_about(&comparison.residual(&data));
    if wild {
        candidates.read_again(&data);
    }
    // what the coarse span missed of the best sets was taken for noise: look again without it
    let curves = comparison.curves();
    let second = comparison.screen.widened(&curves, &candidates);
    if wild || comparison.screen.noisier_than(&second) > QUIETER {
        comparison = Comparison::new(second, &candidates, &data);
    }
    let floor = comparison.screen.colour.floor();
    let step = lattice::step(&file.deflection).filter(|s| *s > COARSE * floor);
    let best = comparison.posterior.sets.first().and_then(|set| set.2);
    let mut case = Case {
        file,
        step,
        screen: comparison
            .screen
            .recoloured(comparison.suited(), &candidates.reading),
        data,
        refined: comparison.refined,
        posterior: comparison.posterior,
        base: 0.0,
        present: settings.present.clone(),
        plain: comparison.plain,
    };
    case.plain = case.again(&case.plain);
    case.base = case.plain.optimum.chi2;
    if let Some(i) = best {
        let nats = case.refined[i].nats;
        case.refined[i] = Refined {
            nats,
            ..case.again(&case.refined[i])
        };
    }
    case
}

impl Case<'_> {
    /// The most probable set, less the causes that gain nothing on unseen data.
    pub(super) fn choose(&self) -> Refined {
        let best = self.posterior.sets.first().and_then(|s| s.2);
        let mut set = match best {
            Some(index) => self.refined[index].clone(),
            None => return self.plain.clone(),
        };
        while !set.causes.is_empty() {
            let real = |cause: &&&'static str| {
                self.is_needed(&set, cause) && self.is_real(&self.gain_of(&set, cause))
            };
            let unreal = set.causes.iter().find(|cause| !real(cause)).copied();
            match unreal {
                None => return set,
                Some(cause) => set = self.reduced(&set, cause),
            }
        }
        self.plain.clone()
    }

    /// The chosen set under the colour of noise that suits it, which the rest of the case then takes
    /// too: the colour at hand suits the most probable set, and that may have lost causes since.
    pub(super) fn suited(&mut self, chosen: Refined) -> Refined {
        let (own, all) = (&self.screen.colour, &self.screen.tints);
        let colour = Tints::new(own, all, &self.plain.optimum)
            .best(&chosen.optimum)
            .clone();
        if colour == self.screen.colour {
            return chosen;
        }
        let mut reading = self.data.reading.clone();
        self.data.cosine.transform(&mut reading);
        self.screen = self.screen.recoloured(colour, &reading);
        self.plain = self.again(&self.plain);
        self.base = self.plain.optimum.chi2;
        self.again(&chosen)
    }

    /// A gain that chance and a coarse lattice of readings do not explain.
    pub(super) fn is_real(&self, gain: &Gain) -> bool {
        let lifted = (gain.before * gain.before - gain.after * gain.after)
            .max(0.0)
            .sqrt();
        gain.is_real() && self.step.is_none_or(|step| lifted > HALF_STEP * step)
    }

    /// Gain of one cause, the set without it against the set: on unseen cycles, or, for what happened
    /// once, on unseen pieces of cycles.
    pub(super) fn gain_of(&self, set: &Refined, cause: &str) -> Gain {
        let without = self.without(set, cause);
        let on = |split: Split| {
            let before = held_out(
                &without.0,
                &without.1,
                &self.data,
                &self.screen.colour,
                split,
            );
            let after = held_out(
                &set.model,
                &set.optimum.p,
                &self.data,
                &self.screen.colour,
                split,
            );
            gain(&before, &after, &self.data).reachable(self.screen.colour.rms)
        };
        let cycles = on(Split::Cycles);
        if self.is_real(&cycles) {
            return cycles;
        }
        let pieces = on(Split::Pieces);
        if self.is_real(&pieces) {
            pieces
        } else {
            cycles
        }
    }

    /// Whether the set is clearly more probable than the same set without this cause.
    fn is_needed(&self, set: &Refined, cause: &'static str) -> bool {
        let rest: Vec<&'static str> = set.causes.iter().copied().filter(|c| *c != cause).collect();
        let (with, without) = (self.posterior.of(&set.causes), self.posterior.of(&rest));
        with > NEEDED * (with + without)
    }

    /// A set refined once more, with the colour of the noise that suits the best set.
    fn again(&self, set: &Refined) -> Refined {
        let (model, p) = (set.model.clone(), &set.optimum.p);
        refine_from(model, p, &self.data, &self.screen.colour, self.base, 12)
    }

    /// The set less one cause, refined.
    fn reduced(&self, set: &Refined, cause: &str) -> Refined {
        let (model, p) = self.without(set, cause);
        refine_from(model, &p, &self.data, &self.screen.colour, self.base, 12)
    }

    /// The set less one cause: refined if it was compared, else as it stands.
    fn without(&self, set: &Refined, cause: &str) -> (Composite, Vec<f64>) {
        let rest: Vec<&'static str> = set.causes.iter().copied().filter(|c| *c != cause).collect();
        let index = self
            .posterior
            .sets
            .iter()
            .find(|s| s.0 == rest)
            .and_then(|s| s.2);
        if let Some(known) = index.map(|i| &self.refined[i]) {
            return (known.model.clone(), known.optimum.p.clone());
        }
        let mut p = Vec::new();
        let mut effects = Vec::new();
        let mut at = 0;
        for effect in set.model.effects() {
            let count = effect.card().parameters.len();
            if effect.card().cause != cause {
                effects.push(*effect);
                p.extend(&set.optimum.p[at..at + count]);
            }
            at += count;
        }
        (Composite::new(&effects), p)
    }
}
