//! Causes of the whole robot ([`crate::causes`]) as a kind of measurement sees them: each alters the robot,
//! and the readings show the difference. What they do not show adds nothing and is left out.

use super::bent::{self, Strength};
use crate::causes::contract::Cause;
use crate::causes::places::{EXCESS, LARGEST_START, LEAST_EXCESS, soften};
use crate::causes::{CAUSES, Sight};
use crate::effects::Family;
use crate::findings::engine::{Blamed, Member, Nuisance, Suspect};
use crate::ground::stats::length;
use crate::inference::gaussian::Size;
use crate::robot::{Robot, Spring};
use rayon::prelude::*;

/// A kind whose readings follow from a robot.
pub trait OnRobot: Sync {
    /// The robot as it is simulated.
    fn robot(&self) -> &Robot;
    /// What another robot would show more, reading by reading; empty where that cannot be told.
    fn change(&self, robot: &Robot) -> Vec<f64>;
    /// Standard deviation of a reading, in the unit of the readings.
    fn noise(&self) -> f64;
    /// Whether this kind shows a cause.
    fn shows(&self, cause: &str) -> bool;
    /// Whether what a cause adds grows in a straight line with its amounts.
    fn is_straight(&self) -> bool {
        true
    }
    /// Whether what is missed may hold something of this column: only then is it worth trials of other strengths.
    fn may_hold(&self, _column: &[f64]) -> bool {
        true
    }
    /// How ready one is to blame a cause at a site, against its other sites.
    fn readiness(&self, cause: &'static dyn Cause, site: &str) -> f64 {
        cause.readiness(self.robot(), site)
    }
    /// The robot that [`OnRobot::change`] is against, with a cause of some more amounts.
    fn with_cause(&self, cause: &'static dyn Cause, site: &str, amounts: &[f64]) -> Robot {
        let mut robot = self.robot().clone();
        cause.alter(&mut robot, site, amounts);
        robot
    }
    /// The same with a spring whose compliance is greater by a share.
    fn with_softer(&self, site: &str, excess: f64) -> Robot {
        let mut robot = self.robot().clone();
        soften(&mut robot, site, excess);
        robot
    }
}

/// Share of an ordinary strength at which a cause is tried: small, so that what it adds is linear.
const TRIED: f64 = 0.02;
/// Share of a form below which others are blamed: a bend at the very end of a link is the bearing there.
const LEAST: f64 = 0.1;
/// Noise deviations rms below which a cause of ordinary strength does not show.
const UNSEEN: f64 = 1e-3;

/// Everybody of the robot who may be to blame.
pub fn suspects(case: &dyn OnRobot) -> Vec<Suspect> {
    let physics = CAUSES.iter().filter(|cause| shows(case, **cause));
    physics.flat_map(|cause| of(case, *cause)).collect()
}

fn shows(case: &dyn OnRobot, cause: &dyn Cause) -> bool {
    let card = cause.card();
    card.family == Family::Physics
        && card
            .shows
            .iter()
            .any(|(sight, _)| *sight == Sight::Workspace)
        && case.shows(card.name)
}

fn of(case: &dyn OnRobot, cause: &'static dyn Cause) -> Vec<Suspect> {
    let sites = cause.sites(case.robot());
    let total: f64 = sites.iter().map(|site| case.readiness(cause, site)).sum();
    let suspect = |site: String| -> Option<Suspect> {
        let members = members(case, cause, &site);
        let share = (case.readiness(cause, &site) / total).ln();
        let card = cause.card();
        (!members.is_empty()).then_some(Suspect {
            effect: card.name,
            site,
            summary: card.summary,
            mechanism: card.name,
            share,
            members,
            named: true,
            law_error: 0.0,
            can_be: match card.amounts[0].name {
                EXCESS => is_no_rigid_spring,
                _ => |_, _| true,
            },
        })
    };
    sites.into_par_iter().filter_map(suspect).collect()
}

/// Whether a compliance that is off by an excess is one that a spring can have: none is rigid.
fn is_no_rigid_spring(_: &[f64], amounts: &[f64]) -> bool {
    amounts[0] * LARGEST_START > LEAST_EXCESS
}

/// One member per form and strength; columns are the difference at an ordinary strength, by what the strength of the member adds. What
/// two axes share of a compliance is none alone: such forms are left to tests that load every point in all directions.
pub fn members(case: &dyn OnRobot, cause: &'static dyn Cause, site: &str) -> Vec<Member> {
    let either_sign = cause.card().amounts.iter().all(|a| a.bounds[0] < 0.0);
    let column = |k: usize, strength: f64| changed(case, (cause, site), k, strength);
    let own = (0..cause.card().amounts.len()).filter(|k| !cause.is_shared(*k));
    let own: Vec<usize> = own.collect();
    let may_hold = |k: &usize, strength: f64| case.may_hold(&column(*k, strength));
    let is_asked = || {
        let mut each = bent::ASKED.iter();
        each.any(|strength| own.par_iter().any(|k| may_hold(k, *strength)))
    };
    let strengths = match case.is_straight() {
        true => vec![Strength::small(TRIED)],
        false if is_asked() => bent::strengths(either_sign),
        false => vec![Strength::small(bent::FIRST)],
    };
    let columns: Vec<Vec<Vec<f64>>> = (0..cause.card().amounts.len())
        .into_par_iter()
        .map(|k| match own.contains(&k) {
            true => bent::columns(&strengths, |strength| column(k, strength)),
            false => Vec::new(),
        })
        .collect();
    let of = |(i, strength): (usize, &Strength)| {
        of_strength(case, cause, strength, &|k| columns[k].get(i))
    };
    strengths.iter().enumerate().flat_map(of).collect()
}

fn of_strength<'a>(
    case: &dyn OnRobot,
    cause: &'static dyn Cause,
    strength: &Strength,
    column: &dyn Fn(usize) -> Option<&'a Vec<f64>>,
) -> Vec<Member> {
    let limit = |column: &Vec<f64>| UNSEEN * case.noise() * (column.len() as f64).sqrt();
    let seen = |k: &usize| column(*k).is_some_and(|c| length(c) > limit(c));
    let form = |(index, form): (usize, Vec<usize>)| {
        let positive = form
            .iter()
            .all(|k| cause.card().amounts[*k].bounds[0] >= 0.0);
        form.iter().all(&seen).then(|| Member {
            columns: form.iter().filter_map(|k| column(*k)).cloned().collect(),
            size: Size::Given(1.0),
            positive: positive.then(|| vec![1.0; form.len()]),
            within: strength.within,
            shape: strength.shape(index as f64),
            ..Member::free(Vec::new())
        })
    };
    let likely: Vec<bool> = cause.shares().iter().map(|s| *s >= LEAST).collect();
    let forms = cause.forms().into_iter().enumerate();
    let forms = forms.filter(|(i, _)| likely.get(*i).copied().unwrap_or(true));
    forms.filter_map(form).collect()
}

/// What a cause of a strength, in ordinary ones, adds to the readings by one of its amounts.
fn changed(
    case: &dyn OnRobot,
    (cause, site): (&'static dyn Cause, &str),
    k: usize,
    strength: f64,
) -> Vec<f64> {
    let scale = cause.scale(case.robot(), site);
    let mut amounts = vec![0.0; scale.len()];
    amounts[k] = strength * scale[k];
    case.change(&case.with_cause(cause, site, &amounts))
}

/// Relative standard deviation of a stiffness, or of a coefficient of the cut, that states none. A choice, no
/// measurement: an axis test with its levers knows 0.3 %, a data sheet hardly 5 %.
pub const USUAL: f64 = 0.02;
/// Relative compliance at which a spring is tried: small, so that what it adds is linear.
const SOFTER: f64 = 0.01;

/// The same of a spring that adds no straight line, at most.
const MUCH_SOFTER: f64 = 0.1;

/// Every spring within what is known of it, with its site; those that the readings hardly show are left out.
pub fn shown_springs(case: &dyn OnRobot) -> Vec<(String, Nuisance)> {
    let all: Vec<(String, &Spring)> = case.robot().springs().collect();
    let told = all.into_par_iter().map(|(site, own)| {
        let nuisance = spring(case, &site, own);
        (site, nuisance)
    });
    let shown = told.filter(|(_, nuisance)| is_shown(case, nuisance));
    shown.collect()
}

/// A spring within what is known of it.
pub fn spring(case: &dyn OnRobot, site: &str, spring: &Spring) -> Nuisance {
    let softer = match case.is_straight() {
        true => SOFTER,
        // as far as it may be off: it swings otherwise where it is much softer
        false => spring
            .relative_std()
            .unwrap_or(USUAL)
            .clamp(SOFTER, MUCH_SOFTER),
    };
    let robot = case.with_softer(site, softer);
    Nuisance {
        column: case.change(&robot).iter().map(|x| x / softer).collect(),
        spread: spring.relative_std().unwrap_or(USUAL),
    }
}

fn is_shown(case: &dyn OnRobot, nuisance: &Nuisance) -> bool {
    nuisance
        .column
        .iter()
        .any(|x| x.abs() > UNSEEN * case.noise())
}

/// Parameters of a named cause; none for those of other tables.
pub fn parameters(
    case: &dyn OnRobot,
    blamed: &Blamed,
) -> Option<Vec<(&'static str, f64, &'static str)>> {
    let (cause, amounts) = amounts(case, blamed)?;
    Some(cause.said(case.robot(), &blamed.site, &amounts))
}

/// The robot with a named cause; as it is for those of other tables.
pub fn alter(case: &dyn OnRobot, blamed: &Blamed, robot: &mut Robot) {
    if let Some((cause, amounts)) = amounts(case, blamed) {
        cause.alter(robot, &blamed.site, &amounts);
    }
}

/// The cause that was found, and its amounts as it takes them.
pub fn amounts(case: &dyn OnRobot, blamed: &Blamed) -> Option<(&'static dyn Cause, Vec<f64>)> {
    let cause = CAUSES
        .iter()
        .find(|cause| shows(case, **cause) && cause.card().name == blamed.effect)?;
    let known = cause.sites(case.robot()).contains(&blamed.site);
    let form = cause
        .forms()
        .into_iter()
        .nth(*blamed.shape.first().filter(|_| known)? as usize)?;
    let scale = cause.scale(case.robot(), &blamed.site);
    let mut amounts = vec![0.0; scale.len()];
    form.iter()
        .zip(&blamed.amounts)
        .for_each(|(k, amount)| amounts[*k] = amount * scale[*k]);
    Some((*cause, amounts))
}
