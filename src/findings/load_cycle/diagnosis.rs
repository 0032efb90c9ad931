//! The diagnosis of one load-cycle file: from the screen to the verdict.

use super::adequacy::{self, Adequacy};
use super::ambiguity::{Posterior, temper};
use super::imposed::diagnose_imposed;
use super::refine::{Refined, refine, refine_from};
use super::scales::{self, ScaleFinding};
use super::search::search;
use super::structure;
use super::tints::Tints;
use super::unseen::{Split, gain, held_out};
use super::{lattice, next};
use crate::effects::{Composite, EFFECTS, Effect, Family, shapes};
use crate::experiments::load_cycle::{settle, settled_cycle};
use crate::findings::answer::{Answer, Candidate, Cause, Group, Verdict};
use crate::findings::gain::Gain;
use crate::fit::candidates::Candidates;
use crate::fit::imposed::is_imposed;
use crate::fit::least_squares::Problem;
use crate::fit::normal::{Found, Normal};
use crate::fit::observation::Observation;
use crate::fit::screen::{Screen, screen};
use crate::measurement::load_cycle::LoadCycle;
use crate::signal::colour::Colour;

/// What a diagnosis found: the answer, and the models and data behind it.
pub struct Diagnosis {
    /// The answer.
    pub answer: Answer,
    /// Is anything left?
    pub adequacy: Adequacy,
    /// The extended model.
    pub model: Composite,
    /// Its parameters, SI.
    pub p: Vec<f64>,
    /// Reduced data.
    pub data: Observation,
    /// Reading that the present simulation predicts.
    pub simulated: Vec<f64>,
    /// Reading that the extended model predicts.
    pub extended: Vec<f64>,
    /// Whether the displacement was imposed: `data` then holds it as the load, and predicts force.
    pub imposed: bool,
}

impl std::ops::Deref for Diagnosis {
    type Target = Answer;

    fn deref(&self) -> &Answer {
        &self.answer
    }
}

/// How to diagnose.
#[derive(Clone)]
pub struct Settings {
    /// Effects to consider.
    pub library: Vec<&'static dyn Effect>,
    /// Rows beyond which neighbours are averaged.
    pub rows: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            library: EFFECTS.to_vec(),
            rows: 2000,
        }
    }
}

/// A stand-in with at least this share of the winner's probability cannot be ruled out.
const AMBIGUOUS: f64 = 0.03;
/// Probability of a set against the same set less one cause, below which that cause is not named.
const NEEDED: f64 = 0.9;
/// Structure counts as left when a test is below this p-value ...
const SIGNIFICANT: f64 = 1e-6;
/// ... and the unexplained share exceeds this.
const MATTERS: f64 = 0.1;
/// With more than this share unexplained the causes found are not the story.
const NOT_THE_STORY: f64 = 0.2;
/// Steps of a lattice above this many times the noise at high frequency are coarse: their rounding,
/// step/√12, is then half of it or more.
const COARSE: f64 = 1.73;
/// Share of a coarse step that an effect must move the readings to be seen.
const HALF_STEP: f64 = 0.3;
/// Sets whose own curves widen the span of a second screen.
const WIDENED: usize = 3;
/// A second screen counts if it makes the readings quieter by this many nats each.
const QUIETER: f64 = 0.03;
/// Sets refined beyond the single causes.
const REFINED_PAIRS: usize = 14;

/// Everything that is known about a file before causes are named.
struct Case<'a> {
    file: &'a LoadCycle,
    data: Observation,
    screen: Screen,
    refined: Vec<Refined>,
    posterior: Posterior,
    base: f64,
    plain: Refined,
    /// Step of a coarse lattice of readings.
    step: Option<f64>,
}

/// Diagnoses one file.
pub fn diagnose(file: &LoadCycle, settings: &Settings) -> Diagnosis {
    if is_imposed(file) {
        return diagnose_imposed(file);
    }
    let case = compare(file, settings);
    let chosen = case.choose();
    let mut named = case.name(&chosen);
    let spring = chosen.optimum.p[0];
    let scales = case.scales(&chosen);
    named.extend(case.name_scales(&scales, &chosen));
    named.extend(case.name_lattice());
    case.conclude(chosen, named, !scales.is_empty(), spring)
}

fn compare<'a>(file: &'a LoadCycle, settings: &Settings) -> Case<'a> {
    let data = Observation::of(file, settings.rows);
    let candidates = Candidates::new(&shapes(&settings.library), &data);
    let mut comparison = Comparison::new(screen(&data, &candidates), &candidates, &data);
    // what the coarse span missed of the best sets was taken for noise: look again without it
    let curves = comparison.curves();
    let second = comparison.screen.widened(&curves, &candidates);
    if comparison.screen.noisier_than(&second) > QUIETER {
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
            .recoloured(comparison.suited(), &candidates),
        data,
        refined: comparison.refined,
        posterior: comparison.posterior,
        base: 0.0,
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

/// Sets of causes compared under one screen.
struct Comparison {
    screen: Screen,
    plain: Refined,
    refined: Vec<Refined>,
    posterior: Posterior,
}

impl Comparison {
    fn new(screen: Screen, candidates: &Candidates, data: &Observation) -> Self {
        let normal = Normal::new(candidates, &screen.colour);
        let start = [data.scene.load_scale / data.scene.deflection_scale];
        let spring = Composite::new(&[]);
        let plain = refine_from(spring, &start, data, &screen.colour, normal.base, 12);
        let tints = Tints::new(&screen.colour, &screen.tints, &plain.optimum);
        let temper = temper(0.5 * (normal.base - screen.saturated).max(0.0));
        let nothing = tints.evidence(&plain.optimum);
        let weighed = |found: &Found| {
            let mut set = refine(found, candidates, data, &screen.colour, normal.base, 12);
            set.nats = (tints.evidence(&set.optimum) - nothing) / temper;
            set
        };
        let found = search(candidates, &normal, REFINED_PAIRS);
        let refined: Vec<Refined> = found.iter().map(weighed).collect();
        let posterior = Posterior::new(&refined, data.rows(), temper);
        Self {
            screen,
            plain,
            refined,
            posterior,
        }
    }

    /// The colour that suits the best set.
    fn suited(&self) -> Colour {
        let best = self.posterior.sets.first().and_then(|set| set.2);
        let suited = best.map_or(&self.plain, |i| &self.refined[i]);
        Tints::new(&self.screen.colour, &self.screen.tints, &self.plain.optimum)
            .best(&suited.optimum)
            .clone()
    }

    /// The curves of the sets that leave least, and how they change with their shapes, in cosine
    /// coefficients.
    fn curves(&self) -> Vec<Vec<f64>> {
        let mut order: Vec<&Refined> = self.refined.iter().collect();
        order.sort_by(|a, b| a.optimum.chi2.total_cmp(&b.optimum.chi2));
        let columns = order.iter().take(WIDENED).flat_map(|set| {
            let jacobian = &set.optimum.jacobian;
            let sigma = &self.screen.colour.sigma;
            (1..jacobian.ncols()).map(move |j| {
                let column = jacobian.column(j);
                column.iter().zip(sigma).map(|(v, s)| v * s).collect()
            })
        });
        columns.collect()
    }
}

/// Causes and groups as they are named.
#[derive(Default)]
struct Named {
    causes: Vec<Cause>,
    groups: Vec<Group>,
}

impl Named {
    fn extend(&mut self, other: Named) {
        self.causes.extend(other.causes);
        self.groups.extend(other.groups);
    }
}

impl Case<'_> {
    /// The most probable set, less the causes that gain nothing on unseen data.
    fn choose(&self) -> Refined {
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

    /// A gain that chance and a coarse lattice of readings do not explain.
    fn is_real(&self, gain: &Gain) -> bool {
        let lifted = (gain.before * gain.before - gain.after * gain.after)
            .max(0.0)
            .sqrt();
        gain.is_real() && self.step.is_none_or(|step| lifted > HALF_STEP * step)
    }

    /// Gain of one cause, the set without it against the set: on unseen cycles, or, for what happened
    /// once, on unseen pieces of cycles.
    fn gain_of(&self, set: &Refined, cause: &str) -> Gain {
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
            gain(&before, &after, &self.data)
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

    fn name(&self, chosen: &Refined) -> Named {
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
    fn alternatives(
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
    fn site(&self, chosen: &Refined, cause: &str) -> String {
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

    fn parameters(&self, chosen: &Refined, cause: &str) -> Vec<(&'static str, f64, &'static str)> {
        let slots = chosen.model.slots();
        let own = slots
            .iter()
            .zip(&chosen.optimum.p)
            .filter(|(s, _)| s.effect.card().cause == cause);
        own.map(|(s, v)| {
            (
                s.parameter.name,
                *v,
                crate::fit::solution::unit_of(s.parameter.scale, self.file.port),
            )
        })
        .collect()
    }

    fn scales(&self, chosen: &Refined) -> Vec<ScaleFinding> {
        let (low, high) = self
            .data
            .scene
            .load
            .iter()
            .fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
        let (load, deflection) = settled_cycle(
            &chosen.model,
            &chosen.optimum.p,
            &self.data.scene,
            low,
            high,
        );
        let settled = settle(&load, &deflection);
        let excess = scales::nominal_excess(self.file, chosen.optimum.p[0], &settled);
        scales::judge(self.file, excess, self.relative_error(chosen)).findings
    }

    /// Relative standard error of the spring.
    fn relative_error(&self, chosen: &Refined) -> f64 {
        let normal = chosen.optimum.jacobian.tr_mul(&chosen.optimum.jacobian);
        let inverse = normal
            .try_inverse()
            .map_or(0.0, |m| m[(0, 0)].max(0.0).sqrt());
        (inverse * chosen.optimum.scale[0] / chosen.optimum.p[0])
            .abs()
            .min(0.5)
    }

    fn name_scales(&self, findings: &[ScaleFinding], chosen: &Refined) -> Named {
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
                    parameters: vec![("excess", finding.excess, "1")],
                    gain,
                });
            } else {
                named.groups.push(Group {
                    effects: finding.candidates.iter().map(|c| c.0).collect(),
                    sites: finding.candidates.iter().map(|c| c.1.clone()).collect(),
                    would_tell: self.scale_experiment(finding),
                    gain,
                });
            }
        }
        named
    }

    /// What separates scale errors, with the separation it would give.
    fn scale_experiment(&self, finding: &ScaleFinding) -> String {
        let lever = self.file.facts.lever_rel_std.unwrap_or(0.003);
        let sigma = finding.excess.abs() / (std::f64::consts::SQRT_2 * lever).max(1e-6);
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
            &self.screen.colour,
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

    fn name_lattice(&self) -> Named {
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

    fn conclude(self, chosen: Refined, mut named: Named, scaled: bool, spring: f64) -> Diagnosis {
        let adequacy = adequacy::judge(
            &self.residual(&chosen),
            chosen.dimension + 1,
            self.base,
            &self.screen,
            &self.data,
        );
        let left = adequacy.p_value < SIGNIFICANT
            && adequacy.unexplained > MATTERS
            && !self.within_step(&chosen);
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
        let extended = chosen.model.predict(&chosen.optimum.p, &self.data.scene);
        let stiffness = self.present_stiffness(scaled, spring);
        let simulated: Vec<f64> = self.data.scene.load.iter().map(|m| m / stiffness).collect();
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
            model: chosen.model,
            p: chosen.optimum.p,
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

    /// The stiffness that the present simulation uses: the nominal one where its stated spread does
    /// not cover the identified one; else the best straight spring within that spread.
    fn present_stiffness(&self, scaled: bool, _spring: f64) -> f64 {
        match self.file.facts.nominal_stiffness {
            Some(nominal) if scaled => nominal,
            _ => self.plain.optimum.p[0],
        }
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

/// What a cause is, one sentence.
pub fn summary(cause: &str) -> &'static str {
    crate::effects::named(cause).map_or("", |effect| effect.card().summary)
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

fn verdict(named: &Named, left: bool, adequacy: &Adequacy) -> Verdict {
    match (named.causes.is_empty() && named.groups.is_empty(), left) {
        (true, true) => Verdict::UnknownCause,
        (true, false) => Verdict::Sufficient,
        (false, true) if adequacy.unexplained > NOT_THE_STORY => Verdict::UnknownCause,
        (false, true) => Verdict::PartlyExplained,
        (false, false) if named.causes.is_empty() => Verdict::CannotTell,
        (false, false) => Verdict::Explained,
    }
}
