//! A cause at a place of one robot, its amounts counted in spreads.

use super::diagnosis::TIE;
use super::leaning;
use super::seat::{Between, SHARES_BEHIND, STEPS, Seat};
use crate::causes::turns::{LOWER, SIX, squared};
use crate::causes::{self, Amount, Cause, Sight};
use crate::effects::Family;
use crate::findings::belief::Place;
use crate::ground::stats::largest;
use crate::robot::Robot;

/// Where an amount that cannot be negative starts to exist, in spreads.
const LEAST: f64 = 1e-3;

/// A cause at a place.
#[derive(Clone)]
pub struct Suspect {
    /// The cause.
    pub cause: &'static dyn Cause,
    /// Its site.
    pub site: String,
    /// Which of the places that its amounts are for: those of one place are [`Cause::heard`] together.
    pub place: usize,
    /// Whether it sits between that place and the next.
    pub between: Option<Between>,
    /// Which of `seat::SHARES_BEHIND` of the part's body lies behind it, where that is one of its amounts.
    pub behind: usize,
    /// How many of the amounts of its place act.
    pub heard: usize,
}

impl Suspect {
    /// Its name.
    pub fn name(&self) -> &'static str {
        self.cause.card().name
    }

    /// The amounts that a hammer test can tell.
    fn amounts(&self) -> &'static [Amount] {
        &self.cause.card().amounts[self.before()..][..self.heard]
    }

    /// Amounts of the cause before those that it uses.
    fn before(&self) -> usize {
        self.place * self.cause.heard()
    }

    /// First of the amounts of each place, and which share acts there.
    fn acting(&self) -> Vec<(usize, f64)> {
        let share = self.between.map_or(0.0, Between::share);
        let other = self.between.map(|b| (b.other * self.cause.heard(), share));
        std::iter::once((self.before(), 1.0 - share))
            .chain(other)
            .collect()
    }

    /// Whether it gives way about any axis. Its unknowns are then the lower roots of its matrices, six each: whatever
    /// they are, the matrix is nowhere negative, and one soft axis is no corner of what is allowed.
    fn is_whole(&self) -> bool {
        self.heard > self.cause.straight()
    }

    /// All amounts of the cause, SI, where its unknowns are `own`.
    pub fn whole(&self, own: &[f64]) -> Vec<f64> {
        let own: Vec<f64> = match self.is_whole() {
            true => own.chunks(SIX).flat_map(squared).collect(),
            false => own.to_vec(),
        };
        let own = own.iter().zip(self.spreads()).map(|(a, s)| a * s);
        let own: Vec<f64> = own.collect();
        let acting = self.acting();
        let last = acting.iter().map(|(first, _)| first + own.len()).max();
        let mut all = vec![0.0; last.unwrap_or(0)];
        for (first, share) in acting {
            let place = all[first..].iter_mut().zip(&own);
            place.for_each(|(amount, a)| *amount += share * a);
        }
        if let Some(at) = self.cause.behind() {
            all.resize(at + 1, 0.0);
            all[at] = SHARES_BEHIND[self.behind];
        }
        all
    }

    /// Logarithm of how many forms and places it was chosen among.
    pub fn choices(&self) -> f64 {
        let places = self.cause.card().amounts.len() / self.cause.heard().max(1);
        let forms = forms(self.cause, &self.site).len();
        let nearby = match self.cause.behind() {
            Some(_) => SHARES_BEHIND.len() * (1 + STEPS.len() * self.cause.next_to(0).len()),
            None => 1,
        };
        // what has no name must explain more than what the data cannot tell from it
        let outside = if self.is_named() { 1.0 } else { TIE };
        ((places * forms * nearby) as f64 / outside).ln()
    }

    /// The same cause at the other places that it may have at its site.
    pub fn elsewhere(&self) -> impl Iterator<Item = Self> {
        let places = self.cause.card().amounts.len() / self.cause.heard().max(1);
        let others = (0..places).filter(|place| *place != self.place);
        others.map(|place| Self {
            place,
            between: None,
            ..self.clone()
        })
    }

    /// The same cause between its place and the next to it, on this side of the middle, and with more or less of the part behind it.
    pub fn nearby(&self) -> impl Iterator<Item = Self> {
        let next = self.cause.next_to(self.place).into_iter();
        let ways = next.flat_map(|other| STEPS.map(|eighths| Between { other, eighths }));
        let beside = ways.map(|between| Self {
            between: Some(between),
            ..self.clone()
        });
        let shares =
            (0..SHARES_BEHIND.len()).filter(|k| self.cause.behind().is_some() && *k != self.behind);
        beside.chain(shares.map(|behind| Self {
            behind,
            ..self.clone()
        }))
    }

    /// The same cause at the same place, free to turn about any axis and then to shift along any too, from where its unknowns are `own`:
    /// per form the starts of `leaning`. None where it is so already.
    pub fn widened(&self, own: &[f64]) -> Vec<(Self, Vec<Vec<f64>>)> {
        if self.is_whole() {
            return Vec::new();
        }
        let wide = forms(self.cause, &self.site).into_iter().map(|form| Self {
            heard: form.heard,
            ..self.clone()
        });
        wide.filter(Self::is_whole)
            .map(|wide| (wide.clone(), leaning::roots(wide.heard, own)))
            .collect()
    }

    /// Spread of each amount: the prior's standard deviation, as far as its starts reach; one for a whole matrix.
    fn spreads(&self) -> Vec<f64> {
        let first = |k: usize| if self.is_whole() { k - k % SIX } else { k };
        let own = |k: usize| largest(self.amounts()[first(k)].starts);
        (0..self.heard).map(own).collect()
    }

    /// Bounds of each unknown.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        let each = self.amounts().iter().zip(self.spreads()).enumerate();
        let bounds = |(k, (a, spread)): (usize, (&Amount, f64))| {
            let [low, high] = a.bounds.map(|b| b / spread);
            match (self.is_whole(), k % SIX < 3) {
                (true, true) => [LEAST.sqrt(), high.sqrt()],
                (true, false) => [-high.sqrt(), high.sqrt()],
                (false, _) => [if low == 0.0 { LEAST } else { low }, high],
            }
        };
        each.map(bounds).collect()
    }

    /// Where to start: the first of every amount, the second of every amount, ...
    pub fn starts(&self) -> Vec<Vec<f64>> {
        let amounts = self.amounts();
        let count = amounts.iter().map(|a| a.starts.len()).max().unwrap_or(0);
        let at = |j: usize| {
            let each = amounts.iter().zip(self.spreads()).enumerate();
            let own = each.map(|(k, (a, spread))| match self.cause.is_shared(k) {
                true => 0.0,
                false => a.starts[j.min(a.starts.len() - 1)] / spread,
            });
            match self.is_whole() {
                true => own.map(f64::sqrt).collect(),
                false => own.collect(),
            }
        };
        (0..count).map(at).collect()
    }

    /// Unknowns that make so many times the amounts of these.
    pub fn times(&self, own: &[f64], times: f64) -> Vec<f64> {
        let times = match self.is_whole() {
            true => times.max(0.0).sqrt(),
            false => times,
        };
        let scaled = |(k, x)| if self.cause.is_size(k) { x * times } else { x };
        own.iter().copied().enumerate().map(scaled).collect()
    }

    /// Unknowns with one amount alone, and with two and what they share, of the size of its first start.
    pub fn tangents(&self) -> Vec<Vec<f64>> {
        let first = self.starts().into_iter().next().unwrap_or_default();
        let alone = |k: usize| {
            let own = first.iter().enumerate();
            own.map(|(i, s)| match i == k || !self.cause.is_size(i) {
                true => *s,
                false => 0.0,
            })
            .collect()
        };
        let both = |(k, side): (usize, f64)| {
            let (start, (_, column)) = (k - k % SIX, LOWER[k % SIX]);
            let half = first[start + column] * std::f64::consts::FRAC_1_SQRT_2;
            let mut own = vec![0.0; first.len()];
            (own[start + column], own[k]) = (half, side * half);
            own
        };
        let sizes = (0..first.len()).filter(|k| self.cause.is_size(*k));
        let (single, shared): (Vec<usize>, Vec<usize>) =
            sizes.partition(|k| !self.cause.is_shared(*k));
        let sides = shared.into_iter().flat_map(|k| [(k, 1.0), (k, -1.0)]);
        single
            .into_iter()
            .map(alone)
            .chain(sides.map(both))
            .collect()
    }

    /// Where it sits; none where that is the first of its places.
    pub fn seat(&self) -> Option<Seat> {
        let is_first = self.place == 0 && self.between.is_none();
        (!is_first).then(|| (self.site.clone(), self.place, self.between))
    }

    /// Cause and site.
    pub fn place(&self) -> Place {
        (self.name(), self.site.clone())
    }

    /// Whether it may be named.
    pub fn is_named(&self) -> bool {
        !self.cause.is_outside()
    }

    /// Whether it changes the robot.
    pub fn is_physical(&self) -> bool {
        self.cause.card().family == Family::Physics
    }
}

/// Every cause at every place of this robot that a hammer test with these outputs would show, and what nobody may name.
pub fn suspects(robot: &Robot, outputs: &[String]) -> Vec<Suspect> {
    let outside = causes::OUTSIDE.iter().copied();
    let all = causes::seen_by(Sight::Hammer).chain(outside);
    let all = all.filter(|c| !c.card().amounts.is_empty());
    let places = all.flat_map(|cause| {
        let sites = cause.sites(robot).into_iter();
        sites.flat_map(move |site| forms(cause, &site))
    });
    let measured = |s: &Suspect| match s.site.strip_prefix("sensor-") {
        Some(axis) => outputs.len() > 1 && outputs.iter().any(|o| o == axis),
        None => true,
    };
    places.filter(measured).collect()
}

/// Of matrices: their axes those of the frame; the first one; all of them.
fn forms(cause: &'static dyn Cause, site: &str) -> Vec<Suspect> {
    let form = |heard| Suspect {
        cause,
        site: site.to_string(),
        place: 0,
        between: None,
        behind: 0,
        heard,
    };
    let first = match cause.straight() < cause.heard() {
        true => SIX.min(cause.heard()),
        false => cause.heard(),
    };
    let mut heard = vec![cause.straight(), first, cause.heard()];
    heard.dedup();
    heard.into_iter().map(form).collect()
}

/// Whether two suspects are one.
pub fn same(a: &Suspect, b: &Suspect) -> bool {
    a.name() == b.name() && a.site == b.site
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::builtin;

    /// A part of the way from the middle to the next place is shared in proportion, and the share of the body stands last.
    #[test]
    fn a_cause_between_two_places_is_shared_by_both() {
        let robot = builtin::named("kr210").unwrap().unwrap();
        let outputs = ["x".to_string()];
        let all = suspects(&robot, &outputs);
        let bend = all.iter().find(|s| s.name() == "link_compliance").unwrap();
        let own = vec![1.0; bend.heard];
        let whole = bend.whole(&own);
        assert_eq!(*whole.last().unwrap(), SHARES_BEHIND[0]);
        let nearby: Vec<Suspect> = bend.nearby().collect();
        // two steps to either side, and every other share
        assert_eq!(nearby.len(), 2 * STEPS.len() + SHARES_BEHIND.len() - 1);
        let quarter = nearby[0].whole(&own);
        let sum = |amounts: &[f64]| amounts[..amounts.len() - 1].iter().sum::<f64>();
        assert!((sum(&quarter) / sum(&whole) - 1.0).abs() < 1e-12);
        assert!((quarter[0] / whole[0] - 0.75).abs() < 1e-12);
        assert_ne!(nearby[0].seat(), nearby[1].seat());
        assert!(
            all.iter()
                .filter(|s| s.cause.behind().is_none())
                .all(|s| s.nearby().count() == 0)
        );
    }
}
