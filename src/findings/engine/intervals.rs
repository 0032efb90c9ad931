//! 95 % intervals of the parameters of a cause.
//!
//! Its amounts are drawn within their doubt, which holds what all that is uncertain and the other causes of the set may have lent
//! it, and within the share of them that its law may miss; its shape is drawn from those that it can have, each by its evidence.
//! What is a number of the shape alone (a time constant, a frequency) was looked for on a grid: it has no interval.

use super::arrival::Arrival;
use super::bank::{Bank, Fit};
use super::blamed::blamed;
use super::judgement::Judgement;
use super::posterior::Posterior;
use super::search::{Scored, price};
use super::statement::{Blamed, Experiment};
use crate::ground::random::Random;
use crate::ground::stats::{Z95, log_sum_exp, quantile};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Draws: beyond either end of an interval lie twenty-five of them.
const DRAWS: usize = 1000;
/// Fewest draws of what the cause can be that make an interval: five beyond either end. A choice, no measurement.
const FEWEST: usize = 200;
/// No cube root of χ² per degree of freedom is smaller: of five rows one draw of 40 000 is.
const SMALLEST_ROOT: f64 = 0.1;
/// Seed of the draws.
const SEED: u64 = 95;

/// Name, value, unit.
type Parameter = (&'static str, f64, &'static str);
type Parameters = Vec<Parameter>;

/// Whether amounts are possible.
type Asked<'a> = Box<dyn Fn(&[f64]) -> bool + 'a>;

/// A shape that a cause may have.
struct Form<'a> {
    /// The cause of that shape, with its most probable amounts.
    blamed: Blamed,
    /// Square root of the covariance of its amounts.
    root: DMatrix<f64>,
    /// Share of them by which its law may miss.
    law_error: f64,
    /// Rows that the noise is known by.
    rows: f64,
    /// Whether it can be of these amounts.
    can_be: Asked<'a>,
    /// How many draws it is worth.
    draws: usize,
}

/// Intervals of what the suspect at a place of a set is told to be, by name, SI.
pub(super) fn intervals(
    experiment: &dyn Experiment,
    bank: &Bank,
    posterior: &Posterior,
    (set, at): (&Scored, usize),
    judgement: &Judgement,
) -> Vec<(&'static str, [f64; 2])> {
    let own = blamed(bank, &set.fit).swap_remove(at);
    held(
        experiment,
        &own,
        forms(bank, posterior, (set, at), judgement),
    )
}

/// Intervals of a cause where it fits best: it has the shape that it was found in.
pub(super) fn of_arrival(
    experiment: &dyn Experiment,
    arrival: &Arrival,
) -> Vec<(&'static str, [f64; 2])> {
    let shape = &arrival.blamed.shape;
    let form = Form {
        law_error: arrival.law_error,
        rows: arrival.rows,
        can_be: Box::new(|amounts| (arrival.can_be)(shape, amounts)),
        ..Form::of(arrival.blamed.clone(), DRAWS)
    };
    held(experiment, &arrival.blamed, vec![form])
}

/// What nineteen of twenty draws of these forms lie within, by name.
fn held(
    experiment: &dyn Experiment,
    own: &Blamed,
    forms: Vec<Form>,
) -> Vec<(&'static str, [f64; 2])> {
    let mut random = Random::new(SEED);
    let told = experiment.parameters(own);
    let alike = |one: &Parameters| one.len() == told.len() && one.iter().zip(&told).all(same);
    let mut drawn = vec![Vec::new(); told.len()];
    let mut moves = vec![false; told.len()];
    for form in forms {
        for _ in 0..form.draws {
            let one = form.drawn(&mut random);
            let Some(one) = one.map(|one| experiment.parameters(&one)).filter(alike) else {
                continue;
            };
            for (k, (told, one)) in told.iter().zip(one).enumerate() {
                moves[k] |= form.blamed.shape == own.shape && one.1 != told.1;
                drawn[k].push(near(told, one.1));
            }
        }
    }
    let each = told.iter().zip(&drawn).zip(moves);
    each.filter(|(_, moves)| *moves)
        .filter_map(|((told_one, values), _)| {
            let is_alone = told.iter().filter(|other| other.0 == told_one.0).count() == 1;
            let ends = [0.025, 0.975].map(|q| quantile(values, q));
            let holds = (ends[0]..=ends[1]).contains(&told_one.1);
            let is_told = is_alone && holds && values.len() >= FEWEST;
            is_told.then_some((told_one.0, ends))
        })
        .collect()
}

/// A value as it is nearest to the one that is told: angles come again after a turn.
fn near(told: &Parameter, value: f64) -> f64 {
    match told.2 {
        "rad" => value - TAU * ((value - told.1) / TAU).round(),
        _ => value,
    }
}

/// Names of parameters that say which one it is: another is no other value of it.
const WHICH: [&str; 8] = [
    "axis",
    "from_axis",
    "to_axis",
    "cut",
    "test",
    "hits",
    "harmonic",
    "per_turn_of_the_link",
];

/// Whether both are the same parameter.
fn same((one, told): (&Parameter, &Parameter)) -> bool {
    let says_which = WHICH.contains(&told.0);
    (one.0, one.2) == (told.0, told.2) && (!says_which || one.1 == told.1)
}

/// The shapes that a suspect of a set may have beside the others as they are, by their odds.
fn forms<'a>(
    bank: &'a Bank,
    posterior: &Posterior,
    (set, at): (&Scored, usize),
    judgement: &Judgement,
) -> Vec<Form<'a>> {
    let score = |evidence: f64, members: &[usize]| evidence - price(bank, members, judgement);
    let chosen = score(set.fit.posterior.ln_evidence, &set.fit.members);
    let with = |member: usize| {
        let mut members = set.fit.members.clone();
        members[at] = member;
        let fit = bank.fit(&members)?;
        let more = score(fit.posterior.ln_evidence, &members) - chosen;
        Some((fit, more))
    };
    let all: Vec<_> = bank.members_of(set.suspects[at]).filter_map(with).collect();
    let total = log_sum_exp(all.iter().map(|(_, more)| posterior.tempered(*more)));
    let form = |(fit, more): (Fit, f64)| {
        let share = (posterior.tempered(more) - total).exp();
        let draws = (DRAWS as f64 * share).round() as usize;
        (draws > 0).then(|| {
            let (member, suspect) = (bank.member(fit.members[at]), bank.suspect(fit.members[at]));
            let shape = member.shape.clone();
            Form {
                law_error: suspect.law_error,
                rows: bank.noise_rows(),
                can_be: Box::new(move |amounts| {
                    member.has_sign(amounts) && (suspect.can_be)(&shape, amounts)
                }),
                ..Form::of(blamed(bank, &fit).swap_remove(at), draws)
            }
        })
    };
    all.into_iter().filter_map(form).collect()
}

impl Form<'_> {
    /// Of a cause whose law is right, and whose noise and amounts may be any.
    fn of(blamed: Blamed, draws: usize) -> Self {
        let root = blamed.covariance.clone().cholesky();
        let count = blamed.amounts.len();
        Self {
            root: root.map_or_else(|| DMatrix::zeros(count, count), |root| root.l()),
            blamed,
            law_error: 0.0,
            rows: f64::INFINITY,
            can_be: Box::new(|_| true),
            draws,
        }
    }

    /// The cause as it may be as well; none where the draw is of an amount that it cannot have.
    fn drawn(&self, random: &mut Random) -> Option<Blamed> {
        let mean = DVector::from_column_slice(&self.blamed.amounts);
        let normal = DVector::from_fn(mean.len(), |_, _| random.normal());
        let amounts = mean + &self.root * normal * noise_drawn(self.rows, random);
        let missed = self.law_error / Z95 * random.normal();
        let amounts = amounts * (1.0 + missed);
        let amounts = amounts.as_slice();
        (self.can_be)(amounts).then(|| Blamed {
            amounts: amounts.to_vec(),
            ..self.blamed.clone()
        })
    }
}

/// How large the noise may be for what it is said to be, where so many rows say it: amounts have Student's distribution then
/// (1908). By Wilson and Hilferty (1931), the cube root of χ² per degree of freedom is nearly normal.
fn noise_drawn(rows: f64, random: &mut Random) -> f64 {
    if rows.is_infinite() {
        return 1.0;
    }
    let spread = 2.0 / (9.0 * rows);
    let root = 1.0 - spread + random.normal() * spread.sqrt();
    root.max(SMALLEST_ROOT).powf(-1.5)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Toy, cycle, load, steps};
    use super::super::{Judgement, diagnose};

    /// How many of 200 intervals of an amount hold it, of how many, and the share of it that they span at most.
    fn held(toy: impl Fn(u64) -> Toy, effect: &str, amount: f64) -> (usize, usize, f64) {
        let interval = |seed: u64| {
            let found = diagnose(&toy(seed), &Judgement::default());
            let cause = found.answer.causes.into_iter().find(|c| c.effect == effect);
            cause.and_then(|cause| cause.interval("amount"))
        };
        let all: Vec<[f64; 2]> = (0..200).filter_map(interval).collect();
        let holds = |[low, high]: &&[f64; 2]| (*low..=*high).contains(&amount);
        let spans = all.iter().map(|[low, high]| (high - low) / amount);
        let span = spans.fold(0.0, f64::max);
        (all.iter().filter(holds).count(), all.len(), span)
    }

    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        let linear = |seed| Toy::new(seed, 90, steps, |i| 9.0 * (1.0 - i as f64 / 90.0));
        let (holds, all, span) = held(linear, "base", 0.45);
        assert!(
            all > 190 && (92 * all..=985 * all / 10).contains(&(100 * holds)),
            "{holds} of {all}"
        );
        assert!(span < 1.0, "{span}");
        // of a shape that lies between two of the grid
        let shaped = |seed| Toy::new(seed, 252, cycle, |i| 6.0 * (load(i) / 0.05).tanh());
        let (holds, all, span) = held(shaped, "backlash", 6.0);
        assert!(all > 190 && 92 * all <= 100 * holds, "{holds} of {all}");
        assert!(span < 1.0, "{span}");
    }

    #[test]
    fn the_draws_of_few_rows_are_those_of_student() {
        let mut random = super::Random::new(7);
        for (rows, end) in [(5.0, 2.571), (12.0, 2.179), (f64::INFINITY, 1.96)] {
            let mut draw = || random.normal() * super::noise_drawn(rows, &mut random);
            let draws: Vec<f64> = (0..40_000).map(|_| draw()).collect();
            let drawn = super::quantile(&draws, 0.975);
            assert!(
                (drawn / end - 1.0).abs() < 0.03,
                "{rows}: {drawn} for {end}"
            );
        }
    }

    #[test]
    fn another_axis_is_no_other_value_of_it() {
        let axis = |number: f64| ("to_axis", number, "1");
        assert!(super::same((&axis(2.0), &axis(2.0))));
        assert!(!super::same((&axis(1.0), &axis(2.0))));
        assert!(super::same((&("share", 0.2, "1"), &("share", 0.3, "1"))));
    }
}
