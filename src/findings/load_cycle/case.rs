//! A record with what the engine found in it, and the named laws fitted to it.

use super::diagnosis::Settings;
use super::naming::site;
use super::noise::rough;
use super::patterns::JUMPS;
use super::present::Present;
use super::refine::{Refined, refine_from};
use super::statement::Record;
use crate::effects::{Composite, Effect, contract::MOST, contract::Role};
use crate::findings::engine::{Found, Judgement, diagnose};
use crate::findings::gain::Gain;
use crate::fit::observation::Observation;
use crate::fit::starts::starts;
use crate::ground::stats::rms;
use crate::measurement::load_cycle::LoadCycle;
use crate::signal::colour::Colour;
use crate::signal::lattice;

/// Steps of a lattice above this many times the noise at high frequency are coarse: their rounding,
/// step/√12, is then half of it or more.
const COARSE: f64 = 1.73;
/// Steps of a lattice above this many times the noise round nothing: rounding, step/√12, would be 2.5 times that noise. Readings lie on
/// such a lattice because the load does, in equal steps.
const SEEN: f64 = 8.7;
/// Share of a coarse step that an effect must move the readings to be seen, rms: a converter that cuts digits off instead of
/// rounding them is half a step wrong, and by which sign depends on the reading.
const HALF_STEP: f64 = 0.5;
/// Iterations of a law's fit, and points that it starts from.
const FIT: (usize, usize) = (14, 3);
/// Share of a step of a lattice below which what is left may be its rounding, rms.
pub(super) const HIDES: f64 = 0.5;

/// A record and what is known of it before causes are named.
pub(super) struct Case<'a> {
    pub(super) file: &'a LoadCycle,
    pub(super) data: Observation,
    /// What the engine found.
    pub(super) found: Found,
    /// Noise as the fits of laws take it.
    pub(super) colour: Colour,
    /// The spring alone.
    pub(super) plain: Refined,
    /// The present simulation, where it is more than a straight spring.
    pub(super) present: Option<Present>,
    /// Step of a coarse lattice of readings.
    pub(super) step: Option<f64>,
    /// Whether what is left does what no noise does.
    pub(super) restless: bool,
    /// The numbers that decided.
    pub(super) judgement: Judgement,
    library: Vec<&'static dyn Effect>,
}

impl<'a> Case<'a> {
    /// Judges a file.
    pub(super) fn of(file: &'a LoadCycle, settings: &Settings) -> Self {
        let data = Observation::of(file, settings.rows);
        let place = |cause: &'static str| site(file, cause);
        let unit = file.port.deflection_unit();
        let record = Record::new(&data, unit, &settings.library, &place);
        let judgement = asked(&record);
        let (mut found, restless) = judged(file, &data, (&record, &judgement));
        let shown = found.answer.discrepancy.noise_rms;
        let factor = shown / rms(&record.noise.spread);
        let colour = record.noise.colour(factor);
        let step = lattice::step(&file.deflection)
            .filter(|s| *s > COARSE * colour.floor() && *s < SEEN * shown)
            .or_else(|| lattice::plain_step(&file.deflection));
        let is_rounding = step.is_some_and(|step| rms(&found.left) < HIDES * step);
        let is_left = (restless.is_some() || found.answer.is_open()) && !is_rounding;
        if let Some(words) = restless.filter(|_| is_left && !found.answer.is_open()) {
            found.answer.unexplained.description = words.into();
        }
        let found = match is_left && found.answer.named() >= judgement.several {
            true => found.without_names(&record, &judgement),
            false => found,
        };
        drop(record);
        let start = [data.scene.load_scale / data.scene.deflection_scale];
        let plain = refine_from(Composite::new(&[]), &start, &data, &colour, FIT.0);
        Self {
            file,
            data,
            found,
            colour,
            plain,
            present: settings.present.clone(),
            step,
            restless: restless.is_some(),
            judgement,
            library: settings.library.clone(),
        }
    }

    /// The causes that the engine chose, one name for each group.
    pub(super) fn chosen(&self) -> Vec<&'static str> {
        self.found.blamed.iter().map(|b| b.effect).collect()
    }

    /// The laws of some causes, fitted together: of every cause the law that suits best.
    pub(super) fn laws(&self, causes: &[&'static str]) -> Refined {
        let mut sets: Vec<Vec<&'static dyn Effect>> = vec![Vec::new()];
        for cause in causes {
            let laws: Vec<&'static dyn Effect> = self.laws_of(cause);
            sets = sets
                .iter()
                .flat_map(|set| {
                    laws.iter().map(|law| {
                        let mut longer = set.clone();
                        longer.push(*law);
                        longer
                    })
                })
                .collect();
        }
        let fits = sets.iter().map(|set| self.fitted(set));
        let best = fits.min_by(|a, b| self.criterion(a).total_cmp(&self.criterion(b)));
        best.unwrap_or_else(|| self.plain.clone())
    }

    /// What laws are compared by: a parameter more must be worth its price (Schwarz 1978), beside what all of them miss.
    fn criterion(&self, fit: &Refined) -> f64 {
        let rows = self.data.rows() as f64;
        rows * fit.optimum.chi2.max(f64::MIN_POSITIVE).ln() + fit.model.len() as f64 * rows.ln()
    }

    pub(super) fn laws_of(&self, cause: &str) -> Vec<&'static dyn Effect> {
        let own = self.library.iter().copied();
        own.filter(|e| e.card().cause == cause && e.role() == Role::Shape)
            .collect()
    }

    /// The fit of a set of laws from several starts; the last ones go where there are too many.
    pub(super) fn fitted(&self, laws: &[&'static dyn Effect]) -> Refined {
        let mut kept = laws.to_vec();
        while Composite::new(&kept).len() > MOST {
            kept.pop();
        }
        if kept.is_empty() {
            return self.plain.clone();
        }
        let model = Composite::new(&kept);
        let from = starts(&model, &self.data, FIT.1);
        let fits = from
            .iter()
            .map(|p| refine_from(model.clone(), p, &self.data, &self.colour, FIT.0));
        let best = fits.min_by(|a, b| a.optimum.chi2.total_cmp(&b.optimum.chi2));
        best.unwrap_or_else(|| self.plain.clone())
    }

    /// A gain that chance and a coarse lattice of readings do not explain.
    pub(super) fn is_real(&self, gain: &Gain) -> bool {
        let lifted = gain.explained().max(0.0).sqrt();
        gain.is_real() && self.step.is_none_or(|step| lifted > HALF_STEP * step)
    }

    /// Probability of a cause among the sets that were compared.
    pub(super) fn inclusion(&self, cause: &str) -> f64 {
        let own = format!("{cause} ");
        let holding = self.found.answer.candidates.iter();
        let holding = holding.filter(|c| c.0.iter().any(|name| name.starts_with(&own)));
        holding.map(|c| c.1).sum::<f64>().min(1.0)
    }
}

/// The numbers that decide for a record. What is smaller than the noise of one reading shows in many, where it is worth so many nats: on 100 load
/// cycles by a stranger 28 of 38 single causes and 14 of 24 pairs were named (22 and 11 without), all 22 clean ones left alone; with 20 nats two more
/// files had a name that was not true. Where the load is read in coarse steps, what it is between two of them is not known to less than
/// a faint cause makes.
fn asked(record: &Record) -> Judgement {
    Judgement {
        faint_nats: match record.is_rounded || record.is_coarse() {
            true => f64::INFINITY,
            false => 25.0,
        },
        ..Judgement::default()
    }
}

/// What the engine finds, and what it leaves that no noise makes.
fn judged(
    file: &LoadCycle,
    data: &Observation,
    (record, judgement): (&Record, &Judgement),
) -> (Found, Option<&'static str>) {
    let mut found = diagnose(record, judgement);
    let seen = &mut found.answer.unexplained.description;
    if seen == JUMPS {
        *seen = record.jumps();
    }
    let restless = record.restless(&found.left, stated(file, data));
    (found, restless)
}

/// Deviation of a reading by the data sheet, with what the load's own scatter makes of it; none where no sheet is stated.
fn stated(file: &LoadCycle, data: &Observation) -> Option<f64> {
    let sheet = file.facts.sensor_noise? / file.facts.sensor_lever.unwrap_or(1.0);
    let scene = &data.scene;
    Some(sheet.hypot(rough(&scene.load) * scene.deflection_scale / scene.load_scale))
}
