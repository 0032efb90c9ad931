//! The tool runs out of centre.

use super::Case;
use super::aim::{Aim, Loose, is_wild};
use super::case::CutSamples;
use super::coefficients::moved;
use super::setting::PROCESS;
use crate::experiments::milling_force::RUNOUT;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;
use std::f64::consts::FRAC_PI_2 as QUARTER;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "runout",
    summary: "The tool turns about another axis than its own: its teeth take unequal chips.",
    mechanism: "teeth",
    law_error: 0.03,
    can_be: is_felt,
    places: |case| {
        if case.places().teeth < 2 {
            return Vec::new();
        }
        vec![Place::new("tool", vec![whole(case)])]
    },
    parameters: |case, blamed| {
        let sum = moved(case, blamed);
        let stated = case.cuts()[0].present.p;
        let [x, y] = [0, 1].map(|k| stated[RUNOUT + k] + sum[RUNOUT + k]);
        vec![
            ("runout", x.hypot(y), "m"),
            ("runout_angle", y.atan2(x), "rad"),
        ]
    },
    would_tell: "put a dial gauge on the shank, and look at the teeth",
};

/// Unit of the amounts, m.
pub(super) const UNIT: f64 = 1e-6;
/// No runout is larger, in that unit.
const MOST: f64 = 200.0;
/// A smaller one is none, in that unit.
const NOTHING: f64 = 1e-3;
/// A smaller one is nobody's fault, in that unit, nor is so small a difference from a stated one: spindle, holder and collet of the better
/// kind leave as much. A choice; no other value was tried.
pub(super) const EVERYBODYS: f64 = 0.5;
/// Rounds in which its direction and its size are improved.
const ROUNDS: usize = 8;
/// Change of either, as a share, at which it has arrived.
const ARRIVED: f64 = 3e-3;

/// Share of the feed per tooth from which it is sought along tooth 1, too, and its slope across taken where it stands: with larger
/// ones a tooth cuts air for a part of its way, and slopes lead astray. No other value was tried.
const STRAIGHT: f64 = 0.05;
/// Turn over which the slope across is taken there, rad. No other value was tried.
const TURNED: f64 = 0.05;

/// Share of a stated runout within which it is as stated, and what a dial gauge tells, m: it has lines of a micrometre. A choice; with the
/// share alone 5.2 µm where 6 were stated was a cause.
const SHARE: f64 = 0.15;
const DIAL: f64 = 1e-6;

/// How far from what is stated a runout is as stated, m: one standard deviation.
pub(super) fn spread(stated: f64) -> f64 {
    (SHARE * stated).hypot(DIAL)
}

/// The size from which slopes are taken, m: as a fit sees it where that is as stated, since teeth that cut air for a part of their way
/// follow no slope.
pub(super) fn as_stated(stated: f64, seen: f64) -> f64 {
    match (seen - stated).abs() < spread(stated) {
        true => seen,
        false => stated,
    }
}

/// Whether so much of a runout is more than every tool has.
fn is_felt(_shape: &[f64], amounts: &[f64]) -> bool {
    amounts.iter().fold(0.0, |sum: f64, a| sum.hypot(*a)) >= EVERYBODYS
}

/// A runout on its way: its angle, and the columns of the way there and of the slope across.
#[derive(Debug, Clone)]
struct Way {
    angle: f64,
    columns: Vec<Vec<f64>>,
}

/// The way to where a runout fits best, and its slope across.
fn whole(case: &Case) -> Member {
    let slopes = Way::slopes(case, 0.0);
    let aim = &aim(case);
    let amounts = aim.amounts(&slopes.columns);
    let mut ways = vec![slopes];
    if amounts[0].hypot(amounts[1]) > STRAIGHT * feed_per_tooth(case) / UNIT {
        ways.extend(
            [0.0, amounts[1].atan2(amounts[0])].map(|angle| Way::along((case, aim), angle)),
        );
    }
    let better = |a: (f64, Way), b: (f64, Way)| if b.0 > a.0 { b } else { a };
    let arrived = ways.into_iter().map(|way| way.arrived((case, aim)));
    let best = arrived.reduce(better).map(|best| best.1);
    let way = best.unwrap_or_else(|| Way::slopes(case, 0.0));
    let directions = [0.0, QUARTER].map(|by| towards(case, way.angle + by));
    Member {
        columns: way.columns,
        size: Size::Free,
        shape: std::iter::once(PROCESS)
            .chain(directions.into_iter().flatten())
            .collect(),
        ..Member::free(Vec::new())
    }
}

/// What it is compared with beside what is uncertain: where nobody states one, but for the runout that every tool has. The force is no
/// straight line over it, and what is not would tell the two apart.
pub(super) fn aim(case: &Case) -> Aim {
    let is_stated = case.file().facts.runout_m.is_some();
    let is_other = |loose: &Loose| is_stated || !is_its(loose);
    Aim::new(case, case.loose().into_iter().filter(is_other).collect())
}

/// Whether a runout that was found is all that there is: nobody states one, and no share of it is everybody's.
pub(super) fn is_all(case: &Case, found: &[Blamed]) -> bool {
    let is_stated = case.file().facts.runout_m.is_some();
    !is_stated && found.iter().any(|b| b.effect == EFFECT.name)
}

/// Whether a direction that is uncertain is its own.
pub(super) fn is_its(loose: &Loose) -> bool {
    let mut along = loose.along.iter();
    along.any(|(place, _)| (RUNOUT..RUNOUT + 2).contains(place))
}

/// One unit of runout at an angle ahead of tooth 1.
fn towards(case: &Case, angle: f64) -> Vec<f64> {
    let mut direction = vec![0.0; case.places().len()];
    (direction[RUNOUT], direction[RUNOUT + 1]) = (UNIT * angle.cos(), UNIT * angle.sin());
    direction
}

/// The largest of all cuts, m.
pub(super) fn feed_per_tooth(case: &Case) -> f64 {
    let own = |cut: &CutSamples| cut.present.scene.cut.feed_per_tooth(case.places().teeth);
    case.cuts().iter().map(own).fold(0.0, f64::max)
}

impl Way {
    fn slopes(case: &Case, angle: f64) -> Self {
        let columns = [0.0, QUARTER].map(|by| case.along(&towards(case, angle + by)));
        Self {
            angle,
            columns: columns.into(),
        }
    }

    /// The way to where it fits best along an angle, to either side.
    fn along((case, aim): (&Case, &Aim), angle: f64) -> Self {
        let way = aim.secant(case, &towards(case, angle), MOST, &[]);
        let size = aim.amounts(std::slice::from_ref(&way))[0].clamp(-MOST, MOST);
        let (angle, known) = match size < 0.0 {
            true => (angle + 2.0 * QUARTER, way.iter().map(|x| -x).collect()),
            false => (angle, way),
        };
        match size.abs() < NOTHING {
            true => Self::slopes(case, angle),
            false => Self::slopes(case, angle).reaching((case, aim), size.abs(), &known),
        }
    }

    /// The way to a size at this angle, and the slope across there; `known`: the way as known so far.
    fn reaching(&self, (case, aim): (&Case, &Aim), size: f64, known: &[f64]) -> Self {
        let reached =
            |angle: f64, known: &[f64]| aim.reached(case, &towards(case, angle), size, known);
        let way = reached(self.angle, known);
        let across = match size > STRAIGHT * feed_per_tooth(case) / UNIT {
            true => {
                let turned = reached(self.angle + TURNED, known);
                let each = turned.iter().zip(&way);
                each.map(|(there, here)| (there - here) / TURNED).collect()
            }
            false => self.columns[1].clone(),
        };
        Self {
            angle: self.angle,
            columns: vec![way, across],
        }
    }

    /// The best of the ways there, with what it lowers the misfit by, nats.
    fn arrived(mut self, (case, aim): (&Case, &Aim)) -> (f64, Self) {
        let mut best = None;
        let mut before = 0.0;
        for _ in 0..ROUNDS {
            let (amounts, gain) = aim.fitted(&self.columns);
            if best.as_ref().is_none_or(|(most, _)| gain > *most) {
                best = Some((gain, self.clone()));
            }
            let size = amounts[0].hypot(amounts[1]).min(MOST);
            let turn = amounts[1].atan2(amounts[0]);
            if size < NOTHING || (size / before - 1.0_f64).abs().max(turn.abs()) < ARRIVED {
                break;
            }
            before = size;
            let turned = |(a, b): (&f64, &f64)| a * turn.cos() + b * turn.sin();
            let known = self.columns[0].iter().zip(&self.columns[1]).map(turned);
            let known: Vec<f64> = known.collect();
            let slopes = Self::slopes(case, self.angle + turn);
            let way = slopes.reaching((case, aim), size, &known);
            if is_wild(&way.columns[0], &slopes.columns[0]) {
                break;
            }
            self = way;
        }
        best.unwrap_or((0.0, self))
    }
}

#[cfg(test)]
mod tests {
    use super::{as_stated, is_felt, spread};

    #[test]
    fn a_stated_runout_is_as_stated_within_what_a_gauge_tells() {
        assert!((spread(0.0) - 1e-6).abs() < 1e-12 && spread(20e-6) > 3e-6);
        assert_eq!(as_stated(6e-6, 5.2e-6), 5.2e-6);
        assert_eq!(as_stated(6e-6, 9e-6), 6e-6);
    }

    #[test]
    fn what_every_spindle_has_is_no_runout() {
        assert!(!is_felt(&[], &[0.3, -0.3]) && is_felt(&[], &[0.4, -0.4]));
    }
}
