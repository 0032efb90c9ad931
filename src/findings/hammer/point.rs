//! A point of the search.

use super::suspect::{Suspect, same};
use crate::robot::Robot;

/// A set of causes, how much of each, and the nuisances.
#[derive(Clone)]
pub struct Point {
    /// The causes.
    pub set: Vec<Suspect>,
    /// All their unknowns, one after the other: amounts in spreads, or the roots of whole matrices of them
    /// ([`Suspect::whole`]).
    pub amounts: Vec<f64>,
    /// The nuisances in standard deviations.
    pub theta: Vec<f64>,
}

impl Point {
    /// No cause, everything as stated.
    pub fn nothing() -> Self {
        Self {
            set: Vec::new(),
            amounts: Vec::new(),
            theta: Vec::new(),
        }
    }

    /// With one more cause, its unknowns at `amounts`.
    #[must_use]
    pub fn and(&self, suspect: &Suspect, amounts: &[f64]) -> Self {
        let mut point = self.clone();
        point.set.push(suspect.clone());
        point.amounts.extend(amounts);
        point
    }

    /// Cause by cause: its unknowns.
    fn own(&self) -> Vec<(&Suspect, Vec<f64>)> {
        let mut rest = self.amounts.iter().copied();
        let own = |suspect: &Suspect| rest.by_ref().take(suspect.heard).collect::<Vec<f64>>();
        let amounts: Vec<Vec<f64>> = self.set.iter().map(own).collect();
        self.set.iter().zip(amounts).collect()
    }

    /// The cause whose unknown it is.
    pub fn owner(&self, index: usize) -> Option<&Suspect> {
        let mut first = 0;
        self.set.iter().find(|suspect| {
            first += suspect.heard;
            index < first
        })
    }

    /// Cause by cause: all its amounts, SI.
    pub fn each(&self) -> Vec<(&Suspect, Vec<f64>)> {
        let own = self.own().into_iter();
        own.map(|(suspect, own)| (suspect, suspect.whole(&own)))
            .collect()
    }

    /// Where it ended, with only some of its causes.
    pub fn with_only(&self, keep: impl Fn(&Suspect) -> bool) -> Self {
        let mut point = Self::nothing();
        point.theta.clone_from(&self.theta);
        for (own, amounts) in self.own().into_iter().filter(|(own, _)| keep(own)) {
            point = point.and(own, &amounts);
        }
        point
    }

    /// The same with one cause free to give way about any axis: per form all its starts.
    pub fn widened(&self) -> Vec<Vec<Self>> {
        let own = self.own();
        let wide = |(suspect, amounts): &(&Suspect, Vec<f64>)| {
            let others = self.with_only(|other| !same(other, suspect));
            let forms = suspect.widened(amounts).into_iter();
            let start = move |(wide, roots): (Suspect, Vec<Vec<f64>>)| -> Vec<Self> {
                roots.iter().map(|own| others.and(&wide, own)).collect()
            };
            forms.map(start)
        };
        own.iter().flat_map(wide).collect()
    }

    /// The same with one cause at its other places.
    pub fn moved(&self) -> Vec<Self> {
        self.with_one(|own| own.elsewhere().collect())
    }

    /// The same with one cause a little beside its place.
    pub fn nearby(&self) -> Vec<Self> {
        self.with_one(|own| own.nearby().collect())
    }

    /// The same with others in the place of one cause.
    fn with_one(&self, others: impl Fn(&Suspect) -> Vec<Suspect>) -> Vec<Self> {
        let each = self.set.iter().enumerate();
        let each = each.flat_map(|(i, own)| others(own).into_iter().map(move |o| (i, o)));
        let moved = |(i, other): (usize, Suspect)| {
            let mut point = self.clone();
            point.set[i] = other;
            point
        };
        each.map(moved).collect()
    }

    /// The same from where another point ended: what both share as it is there. None that shares nothing with it.
    pub fn following(&self, other: &Self) -> Option<Self> {
        let mut point = other.with_only(|theirs| self.set.iter().any(|own| same(own, theirs)));
        let shared = point.set.len();
        for (own, amounts) in self.own() {
            if !other.set.iter().any(|theirs| same(own, theirs)) {
                point = point.and(own, &amounts);
            }
        }
        (shared > 0).then_some(point)
    }

    /// Bounds of all unknowns.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.set.iter().flat_map(Suspect::bounds).collect()
    }

    /// The robot with the physical causes in it.
    pub fn robot(&self, robot: &Robot) -> Robot {
        let mut robot = robot.clone();
        // what hangs at the tool hangs at all that is named
        let (named, outside): (Vec<_>, Vec<_>) =
            self.each().into_iter().partition(|(own, _)| own.is_named());
        for (suspect, amounts) in named.into_iter().chain(outside) {
            suspect.cause.alter(&mut robot, &suspect.site, &amounts);
        }
        robot
    }

    /// Whether any of its causes changes the robot.
    pub fn is_physical(&self) -> bool {
        self.set.iter().any(Suspect::is_physical)
    }

    /// Rate of all undeclared windows, 1/s.
    pub fn rate(&self) -> f64 {
        let each = self.each();
        let rates = each.iter().map(|(s, a)| s.cause.undeclared_rate(a));
        rates.sum()
    }
}
