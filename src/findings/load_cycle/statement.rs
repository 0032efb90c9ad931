//! A record of load cycles as the engine takes it.

use super::evidence::evidence;
use super::families::{View, suspects};
use super::noise::{Coloured, TINTS, above_neighbours, rough};
use super::not_noise::no_noise;
use super::patterns::{patterns, told};
use super::read_load;
use super::span::{coarse_span, span};
use super::structure;
use super::unseen::{Split, folds};
use crate::effects::Effect;
use crate::findings::engine::bank::Bank;
use crate::findings::engine::search::{Scored, search};
use crate::findings::engine::{
    Aspects, Blamed, Experiment, Judgement, Member, Nuisance, Remaining, Statement, Suspect,
};
use crate::fit::observation::Observation;
use crate::ground::stats::{difference, rms};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// The linear statement of a record.
pub struct Record<'a> {
    data: &'a Observation,
    unit: &'static str,
    view: View,
    suspects: Vec<Suspect>,
    /// Its noise.
    pub noise: Coloured,
    span: Vec<Vec<f64>>,
    coarse: Vec<Vec<f64>>,
    /// What is uncertain beside the spring if the load is rounded.
    rounding: Vec<Nuisance>,
    /// Whether it is.
    pub is_rounded: bool,
}

/// What is left may be so many times the scatter of neighbours and is nothing else: half a deviation beside it.
const SCATTER: f64 = 1.12;
/// Deviations of a data sheet, and scatters of neighbours, beyond which what is left is no noise whatever its colour: sheets are right
/// within a factor of two, and coloured noise of sensors is about twice the scatter. Choices, no measurement.
const BEYOND: (f64, f64) = (5.0, 2.0);
/// Sets whose evidence chooses the noise.
const LEADING: usize = 4;
/// Nuisances that every statement has: the spring.
const SPRING: usize = 1;
/// Rounds in which noise and causes are sought in turn.
const ROUNDS: usize = 2;

impl<'a> Record<'a> {
    /// Of reduced data.
    pub fn new(
        data: &'a Observation,
        unit: &'static str,
        library: &[&'static dyn Effect],
        site: &dyn Fn(&'static str) -> String,
    ) -> Self {
        let view = View::of(data);
        let elastic = elastic(data);
        let left: Vec<f64> = difference(&data.reading, &elastic);
        let first = rough(&left);
        let digits = 1e-9 * data.scene.deflection_scale;
        let cosine = Arc::new(crate::signal::cosine::Cosine::new(data.rows()));
        let scale = data.scene.deflection_scale;
        let mut record = Self {
            rounding: read_load::rounding(&view, scale, first.max(digits)),
            is_rounded: false,
            suspects: suspects(library, (data, &view), site)
                .into_iter()
                .chain(patterns(&view, &data.reading))
                .collect(),
            span: span(&view),
            coarse: coarse_span(&view),
            noise: Coloured::white(cosine, first.max(digits), data.hums.len()),
            data,
            unit,
            view,
        };
        record.learn_noise();
        record
    }

    /// What a residual holds that no noise makes, in words; none of what is noise, and no larger than a data sheet says within [`BEYOND`].
    pub fn restless(&self, left: &[f64], sheet: Option<f64>) -> Option<&'static str> {
        let far = |sheet: f64| rms(left) > BEYOND.0 * sheet;
        let is_beyond =
            sheet.is_some_and(far) && above_neighbours(left, &self.noise.spread) > BEYOND.1;
        let beyond = is_beyond
            .then_some("more than the data sheet of the sensor lets expect, and no scatter");
        no_noise(left, &self.noise, &self.view).or(beyond)
    }

    /// Whether what the digits of a load that goes smoothly leave open is a good part of the noise.
    pub fn is_coarse(&self) -> bool {
        let open = read_load::open(&self.view, self.data.scene.deflection_scale);
        open.is_some_and(|open| open > read_load::GOOD_PART * rms(&self.noise.spread))
    }

    /// Its jumps in words.
    pub fn jumps(&self) -> String {
        told(&self.view, &self.data.scene.time, self.unit)
    }

    /// Noise and causes in turn: each is chosen beside the other.
    fn learn_noise(&mut self) {
        for _ in 0..ROUNDS {
            let before = (self.noise.tint(), self.is_rounded);
            let (leading, bases) = self.leading();
            let each = bases.iter().flat_map(|at| {
                let residual = self.residual(&leading[*at]);
                let plain = self.noise.with_deviations(&residual, &self.view);
                let mut waves = self.in_waves(&plain, &leading);
                let noises = TINTS
                    .iter()
                    .map(|tint| plain.tinted(*tint).with_lines(&residual, &self.view));
                noises
                    .flat_map(|n| self.weighed(&mut waves, n, &leading))
                    .collect::<Vec<_>>()
            });
            let best = each.max_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, noise, is_rounded)) = best {
                (self.noise, self.is_rounded) = (noise, is_rounded);
            }
            if (self.noise.tint(), self.is_rounded) == before {
                break;
            }
        }
    }

    /// A noise with its evidence as the load is, and as if it were rounded, which pays for what every stand may be off by.
    fn weighed(
        &self,
        waves: &mut Statement,
        noise: Coloured,
        leading: &[(Vec<Member>, f64)],
    ) -> Vec<(f64, Coloured, bool)> {
        let mut each = |kept: usize| evidence((waves, kept), &noise, leading);
        let (plain, room) = each(SPRING);
        let rounded = (!self.rounding.is_empty()).then(|| each(usize::MAX));
        let rounded = rounded.map(|(best, more)| (best - (more - room), noise.clone(), true));
        std::iter::once((plain, noise, false))
            .chain(rounded)
            .collect()
    }

    /// The members of the sets that lead under the present noise, with their price, the empty one last; and beside which of them
    /// the deviations are looked at: the best, and where that holds a pattern, which may have taken louder noise for its own, the
    /// best of causes alone.
    fn leading(&self) -> (Vec<(Vec<Member>, f64)>, Vec<usize>) {
        let statement = self.state(&[]);
        let mut bank = Bank::new(&statement);
        let nothing = bank.fit(&[]).map_or(0.0, |f| f.posterior.ln_evidence);
        let sets = search(&mut bank, &Judgement::default());
        let members = |s: &Scored| {
            let own = s.fit.members.iter().map(|m| bank.member(*m).clone());
            let price = s.fit.posterior.ln_evidence - nothing - s.score;
            (own.collect::<Vec<Member>>(), price)
        };
        let mut leading: Vec<(Vec<Member>, f64)> = sets.iter().take(LEADING).map(members).collect();
        let named = |s: &&Scored| s.suspects.iter().all(|s| bank.suspects[*s].named);
        let is_named = sets.first().as_ref().is_some_and(named);
        let mut bases = vec![0];
        if let Some(causes) = sets.iter().find(named).filter(|_| !is_named) {
            bases.push(leading.len());
            leading.push(members(causes));
        }
        leading.push((Vec::new(), 0.0));
        (leading, bases)
    }

    /// Some sets and coarse structure as cosine coefficients, each reading in its own deviation: they are the same under
    /// every colour.
    fn in_waves(&self, noise: &Coloured, sets: &[(Vec<Member>, f64)]) -> Statement {
        let members = sets.iter().flat_map(|set| &set.0);
        let mut all = self.stated(noise, members.map(anonymous).collect());
        all.nuisances.truncate(SPRING);
        all.nuisances.extend_from_slice(&self.rounding);
        all.span.clone_from(&self.coarse);
        let members = all.suspects.iter_mut().flat_map(|s| &mut s.members);
        let nuisances = all.nuisances.iter_mut().map(|n| &mut n.column);
        let columns = members.flat_map(|m| &mut m.columns).chain(nuisances);
        let columns = columns.chain(&mut all.span).chain([&mut all.reading]);
        columns.for_each(|c| *c = noise.waves(c));
        all
    }

    /// What the spring and a set leave of the readings.
    fn residual(&self, set: &(Vec<Member>, f64)) -> Vec<f64> {
        let columns = set.0.iter().flat_map(|m| m.columns.iter());
        let unit = |c: &Vec<f64>| DVector::from_column_slice(c) / rms(c).max(f64::MIN_POSITIVE);
        let all: Vec<DVector<f64>> = columns.chain([&self.view.u]).map(unit).collect();
        let matrix = DMatrix::from_columns(&all);
        let y = DVector::from_column_slice(&self.data.reading);
        let mut inner = matrix.tr_mul(&matrix);
        (0..all.len()).for_each(|i| inner[(i, i)] += 1e-6 * y.len() as f64);
        match inner.cholesky() {
            Some(root) => (&y - &matrix * root.solve(&matrix.tr_mul(&y)))
                .as_slice()
                .to_vec(),
            None => self.data.reading.clone(),
        }
    }

    fn stated(&self, noise: &Coloured, suspects: Vec<Suspect>) -> Statement {
        Statement {
            reading: self.data.reading.clone(),
            noise: Box::new(noise.clone()),
            nuisances: match self.is_rounded {
                true => [&[free(&self.view.u)], &self.rounding[..]].concat(),
                false => vec![free(&self.view.u)],
            },
            suspects,
            span: Vec::new(),
            splits: Vec::new(),
            aspects: Aspects::default(),
        }
    }
}

/// A column of which nothing is known.
fn free(column: &[f64]) -> Nuisance {
    Nuisance {
        column: column.to_vec(),
        spread: f64::INFINITY,
    }
}

/// A member as a suspect of its own.
fn anonymous(member: &Member) -> Suspect {
    Suspect {
        effect: "",
        site: String::new(),
        summary: "",
        mechanism: "",
        share: 0.0,
        members: vec![member.clone()],
        named: true,
        law_error: 0.0,
        can_be: |_, _| true,
    }
}

fn elastic(data: &Observation) -> Vec<f64> {
    let load = &data.scene.load;
    let own: f64 = load.iter().map(|m| m * m).sum();
    let cross: f64 = load.iter().zip(&data.reading).map(|(m, y)| m * y).sum();
    load.iter()
        .map(|m| m * cross / own.max(f64::MIN_POSITIVE))
        .collect()
}

impl Experiment for Record<'_> {
    fn unit(&self) -> &'static str {
        self.unit
    }

    fn state(&self, _about: &[Blamed]) -> Statement {
        Statement {
            span: self.span.clone(),
            splits: [Split::Cycles, Split::Pieces]
                .map(|s| folds(self.data, s))
                .to_vec(),
            ..self.stated(&self.noise, self.suspects.clone())
        }
    }

    /// Contacts, joints and creep follow nobody's formula.
    fn has_rough_laws(&self) -> bool {
        true
    }

    fn is_scatter(&self, left: &[f64]) -> bool {
        above_neighbours(left, &self.noise.spread) < SCATTER
    }

    /// Told by the named law, which is fitted after the choice.
    fn parameters(&self, _blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
        Vec::new()
    }

    /// Computed from the named laws, after the choice.
    fn would_tell(&self, _rivals: &[(&'static str, String)]) -> String {
        String::new()
    }

    fn place(&self, missed: &[f64]) -> String {
        structure::place(missed, self.data)
    }

    fn remaining(&self, left: &[f64]) -> Remaining {
        structure::remaining(left, self.data)
    }
}
