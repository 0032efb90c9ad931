//! Causes of the whole robot ([`crate::causes`]) as a kind of measurement sees them: each alters the robot,
//! and the readings show the difference. What they do not show adds nothing and is left out.

use crate::causes::contract::Cause;
use crate::causes::places::soften;
use crate::causes::{CAUSES, Sight};
use crate::effects::Family;
use crate::findings::engine::{Blamed, Member, Nuisance, Suspect};
use crate::ground::stats::length;
use crate::inference::gaussian::Size;
use crate::robot::{Robot, Spring};

/// A kind whose readings follow from a robot.
pub trait OnRobot {
    /// The robot as it is simulated.
    fn robot(&self) -> &Robot;
    /// What another robot would show more, reading by reading; empty where that cannot be told.
    fn change(&self, robot: &Robot) -> Vec<f64>;
    /// Standard deviation of a reading, in the unit of the readings.
    fn noise(&self) -> f64;
    /// Whether this kind shows a cause.
    fn shows(&self, cause: &str) -> bool;
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
    let suspect = |site: String| {
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
            can_be: |_, _| true,
        })
    };
    sites.into_iter().filter_map(suspect).collect()
}

/// One member per form; columns are the difference at an ordinary strength. What two axes share of a compliance is none
/// alone: such forms are left to tests that load every point in all directions.
pub fn members(case: &dyn OnRobot, cause: &'static dyn Cause, site: &str) -> Vec<Member> {
    let scale = cause.scale(case.robot(), site);
    let columns: Vec<Vec<f64>> = (0..scale.len())
        .map(|k| match cause.is_shared(k) {
            true => Vec::new(),
            false => column(case, cause, site, &scale, k),
        })
        .collect();
    let rows = columns.iter().map(Vec::len).max().unwrap_or(0) as f64;
    let limit = UNSEEN * case.noise() * rows.sqrt();
    let seen = |k: &usize| length(&columns[*k]) > limit;
    let form = |(index, form): (usize, Vec<usize>)| {
        let positive = form
            .iter()
            .all(|k| cause.card().amounts[*k].bounds[0] >= 0.0);
        form.iter().all(&seen).then(|| Member {
            columns: form.iter().map(|k| columns[*k].clone()).collect(),
            size: Size::Given(1.0),
            positive: positive.then(|| vec![1.0; form.len()]),
            shape: vec![index as f64],
        })
    };
    let likely: Vec<bool> = cause.shares().iter().map(|s| *s >= LEAST).collect();
    let forms = cause.forms().into_iter().enumerate();
    let forms = forms.filter(|(i, _)| likely.get(*i).copied().unwrap_or(true));
    forms.filter_map(form).collect()
}

fn column(
    case: &dyn OnRobot,
    cause: &'static dyn Cause,
    site: &str,
    scale: &[f64],
    k: usize,
) -> Vec<f64> {
    let mut amounts = vec![0.0; scale.len()];
    amounts[k] = TRIED * scale[k];
    let robot = case.with_cause(cause, site, &amounts);
    case.change(&robot).iter().map(|x| x / TRIED).collect()
}

/// Relative standard deviation of a stiffness, or of a coefficient of the cut, that states none. A choice, no
/// measurement: an axis test with its levers knows 0.3 %, a data sheet hardly 5 %.
pub const USUAL: f64 = 0.02;
/// Relative compliance at which a spring is tried: small, so that what it adds is linear.
const SOFTER: f64 = 0.01;

/// Every spring within what is known of it; those that the readings hardly show are left out.
pub fn springs(case: &dyn OnRobot) -> Vec<Nuisance> {
    let all = case
        .robot()
        .springs()
        .map(|(site, spring)| self::spring(case, &site, spring));
    all.filter(|n| is_shown(case, n)).collect()
}

/// Sites of the springs that the readings show.
pub fn shown_springs(case: &dyn OnRobot) -> Vec<String> {
    let shown =
        |(site, own): (String, &Spring)| is_shown(case, &spring(case, &site, own)).then_some(site);
    case.robot().springs().filter_map(shown).collect()
}

/// A spring within what is known of it.
pub fn spring(case: &dyn OnRobot, site: &str, spring: &Spring) -> Nuisance {
    let robot = case.with_softer(site, SOFTER);
    Nuisance {
        column: case.change(&robot).iter().map(|x| x / SOFTER).collect(),
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
