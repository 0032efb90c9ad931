//! Which set of causes is named: the most probable one whose causes are needed and help where they
//! were not fitted.

use super::case::Case;
use super::seats::Seat;
use super::set::Set;
use super::unseen::{Rows, fitted, gain, held_out};
use crate::findings::engine::posterior::without;
use crate::fit::force_shapes::Level;
use crate::ground::spatial::M3;
use std::collections::BTreeMap;

/// Sets looked through for one whose causes all gain.
const SETS: usize = 80;
/// A set with less than this share of the best one's probability is no explanation.
const UNLIKELY: f64 = 1e-3;

/// The cause that is a gap.
const GAP: &str = "backlash";

/// What is left out at a time.
#[derive(Clone, Copy)]
enum Parts {
    /// Whole points.
    Points,
    /// One direction of the force at one point.
    Setups,
    /// Every so many levels, where the curve bends.
    Levels,
}

/// Levels are left out in as many turns.
const PARTS: usize = 7;

impl Case<'_> {
    /// The most probable set whose causes all gain on unseen points; if there is none, the most
    /// probable one less those that gain nothing.
    pub(super) fn choose(&self) -> Set {
        let likely = self.posterior.sets.iter().take(SETS);
        let mut likely = likely.filter(|(_, p)| *p > UNLIKELY * self.posterior.sets[0].1);
        let real = |set: &Set| {
            let needed = set.seats.iter().all(|seat| self.is_needed(set, *seat));
            needed && set.seats.iter().all(|s| self.stands(set, *s))
        };
        if let Some((set, _)) = likely.find(|(set, _)| !set.seats.is_empty() && real(set)) {
            return set.clone();
        }
        let mut set = self.posterior.sets[0].0.clone();
        while let Some(seat) = set.seats.iter().copied().find(|s| !self.is_real(&set, *s)) {
            set = self.without(&set, seat);
        }
        set
    }

    fn is_real(&self, set: &Set, seat: usize) -> bool {
        self.is_needed(set, seat) && self.stands(set, seat)
    }

    /// Whether a seat helps, and is no echo of another.
    fn stands(&self, set: &Set, seat: usize) -> bool {
        self.helps(set, seat) && !self.is_echo(set, seat)
    }

    /// Whether a seat is a gap that does not plainly cut the error beside one that cuts it more: what the law of that one misses
    /// looks like another gap.
    fn is_echo(&self, set: &Set, seat: usize) -> bool {
        let others = set.seats.iter().copied();
        let others: Vec<usize> = others.filter(|s| *s != seat && self.is_gap(*s)).collect();
        if !self.is_gap(seat) || others.is_empty() {
            return false;
        }
        let own = self.told_gain(set, seat);
        let more = |s: &usize| self.told_gain(set, *s).reduction_percent > own.reduction_percent;
        let plain = own.ci95_percent[0] >= self.judgement.companion_gain_beside_kin;
        !plain && others.iter().any(more)
    }

    /// The set less one seat; one that was not compared has its other seats in the same forms.
    pub(super) fn without(&self, set: &Set, seat: usize) -> Set {
        if let Some(known) = self.posterior.set(&without(&set.seats, seat)) {
            return known.clone();
        }
        let each = set.forms.iter().copied();
        let forms: Vec<usize> = each.filter(|f| self.seats.forms[*f].seat != seat).collect();
        Set::of(&self.seats, &self.field, &forms)
    }

    /// Whether it, or any other in its stead, is probable enough against none.
    fn is_needed(&self, set: &Set, seat: usize) -> bool {
        let others = self.posterior.stand_ins(set, seat);
        let with = 1.0 + others.iter().map(|other| other.1).sum::<f64>();
        let without = self.posterior.odds(&self.without(set, seat), set);
        with > self.judgement.companion_needed * (with + without)
    }

    /// Whether a seat helps: the set without it against the set, on data left out. What shows at one point
    /// or in one set-up alone cannot be predicted from the others: then less is left out at a time.
    fn helps(&self, set: &Set, seat: usize) -> bool {
        let (before, after) = self.left_without_and_with(set, seat);
        let real = gain(&before, &after, self.unit()).is_real();
        let told = self.told(&before, &after).ci95_percent;
        let sure =
            self.is_gap(seat) || self.posterior.inclusion_of_place(set, seat) > self.judgement.sure;
        real && told[usize::from(sure)] > 0.0
    }

    fn is_gap(&self, seat: usize) -> bool {
        self.seats.seats[seat].cause.card().name == GAP
    }

    /// What is left of rows that were not fitted (NaN: fitted), in standard deviations, without a seat and
    /// with it.
    pub(super) fn left_without_and_with(&self, set: &Set, seat: usize) -> (Vec<f64>, Vec<f64>) {
        let own = &self.seats.seats[seat];
        let without = self.without(set, seat);
        if let Some(point) = self.point_of(own) {
            return (self.seen_at(point, &without), self.seen_at(point, set));
        }
        let springs = self.springs.columns.ncols();
        let mut first = None;
        for parts in [Parts::Points, Parts::Setups, Parts::Levels] {
            let folds = self.folds(set, own, parts);
            if folds.iter().all(Option::is_none) {
                continue;
            }
            let of = |set: &Set| held_out(&self.rows(set, folds.len()), &folds, springs);
            let (before, after) = (of(&without), of(set));
            let real = |pair: &(Vec<f64>, Vec<f64>)| gain(&pair.0, &pair.1, self.unit()).is_real();
            let carried = (before.carried, after.carried);
            if real(&carried) {
                return carried;
            }
            let refitted = (before.refitted, after.refitted);
            if real(&refitted) {
                return refitted;
            }
            first.get_or_insert(refitted);
        }
        first.unwrap_or_default()
    }

    /// The point that a seat is about, if it is about one.
    fn point_of(&self, seat: &Seat) -> Option<usize> {
        let number: usize = seat.site.strip_prefix("point")?.parse().ok()?;
        number.checked_sub(1)
    }

    /// What is left at one point for the cycles of a set-up that follow the one fitted: the slopes
    /// of cycles differ by the noise of readings only, which is small beside that of a set-up.
    fn seen_at(&self, point: usize, set: &Set) -> Vec<f64> {
        let left = fitted(&self.rows(set, self.readings.len()));
        let places = self.weighing.places();
        let scatter = self.scatter();
        let own = |(i, left): (usize, f64)| match places.get(i) {
            Some(place) if place.0 == point => left.hypot(scatter[i]),
            _ => f64::NAN,
        };
        left.into_iter().enumerate().map(own).collect()
    }

    /// How far the slope of one cycle lies from that of the others by the noise of readings, in standard
    /// deviations of a slope; all of one where no cycle repeats another. By row.
    fn scatter(&self) -> Vec<f64> {
        let places = self.weighing.places();
        let mut setups: Vec<(usize, usize)> = places.iter().map(|p| (p.0, p.1)).collect();
        setups.dedup();
        let deviations: BTreeMap<_, _> =
            setups.into_iter().zip(self.weighing.deviations()).collect();
        let of = |(point, direction, k): (usize, usize, usize)| {
            let at = self.shapes.setup(point, direction)?;
            let setup = &self.shapes.setups[at];
            let cycles = setup.cycles as f64;
            let alone = cycles / (cycles - 1.0).sqrt();
            let own = setup.lines[k]?.stderr * alone / deviations[&(point, direction)][k];
            (own < 1.0).then_some(own)
        };
        let own = places.into_iter().map(|place| of(place).unwrap_or(1.0));
        own.collect()
    }

    /// Which rows are left out together. Beyond the slopes the levels are rows where the set bends the
    /// curve, and left out where the seat does. A point that is blamed itself is no witness.
    fn folds(&self, set: &Set, seat: &Seat, parts: Parts) -> Vec<Option<usize>> {
        let bends = |column: usize| !self.seats.columns[column].pattern.left.is_empty();
        let bent = bends(seat.first);
        let blamed = set.seats.iter();
        let blamed: Vec<usize> = blamed
            .filter_map(|s| self.point_of(&self.seats.seats[*s]))
            .collect();
        let fold = |point: usize, direction: usize, row: usize| match parts {
            _ if blamed.contains(&point) => None,
            Parts::Points => Some(point),
            Parts::Setups => Some(3 * point + direction),
            Parts::Levels => bent.then_some(row % PARTS),
        };
        let slope = |place: &(usize, usize, usize)| match parts {
            Parts::Levels => None,
            _ => fold(place.0, place.1, 0),
        };
        let places = self.weighing.places();
        let slopes = places.iter().map(slope);
        let levels = match self.columns_of(set).into_iter().any(bends) {
            true => self.shapes.levels(),
            false => Vec::new(),
        };
        let level = |(row, l): (usize, &Level)| match bent {
            true => fold(l.point, l.direction, row),
            false => None,
        };
        slopes.chain(levels.iter().enumerate().map(level)).collect()
    }

    /// The first `count` rows with what the springs and a set explain of them.
    fn rows(&self, set: &Set, count: usize) -> Rows {
        let own = self.columns_of(set);
        let springs = &self.springs.columns;
        let k = springs.ncols();
        let mut columns = springs
            .rows(0, count)
            .resize_horizontally(k + own.len(), 0.0);
        for (j, column) in own.iter().enumerate() {
            let column = self.columns.column(*column);
            columns.set_column(k + j, &column.rows(0, count));
        }
        let spread = std::iter::repeat_n(self.springs.spread, k);
        let prior = own.iter().map(|c| 10.0 * self.field.prior(*c));
        Rows {
            readings: self.readings.rows(0, count).into_owned(),
            columns,
            prior: spread.chain(prior).collect(),
        }
    }

    /// Rms force of the steps, N.
    pub(super) fn force(&self) -> f64 {
        let squares: f64 = self.test.steps.iter().map(|s| s.force * s.force).sum();
        (squares / self.test.steps.len().max(1) as f64).sqrt()
    }

    /// Standard deviation of an ordinary displacement about any model, m.
    pub(super) fn unit(&self) -> f64 {
        let deviations = self.weighing.deviations();
        let all: Vec<f64> = deviations
            .iter()
            .flatten()
            .copied()
            .filter(|d| d.is_finite())
            .collect();
        let squares: f64 = all.iter().map(|d| d * d).sum();
        self.force() * (squares / all.len().max(1) as f64).sqrt()
    }

    /// Slopes at every point, m/N, with the amounts of the causes fitted to the other points alone.
    pub(super) fn unseen(&self, set: &Set) -> Vec<M3> {
        let places = self.weighing.places();
        let points = places.iter().map(|place| Some(place.0));
        let levels = std::iter::repeat_n(None, self.levels);
        let folds: Vec<Option<usize>> = points.chain(levels).collect();
        let springs = self.springs.columns.ncols();
        let found = held_out(&self.rows(set, folds.len()), &folds, springs);
        let columns = self.columns_of(set);
        let mut slopes = self.scene.base.slopes.clone();
        for (point, slope) in slopes.iter_mut().enumerate() {
            let amounts = found.amounts.get(point);
            for (column, amount) in columns.iter().zip(amounts.into_iter().flatten()) {
                let own = &self.seats.columns[*column].pattern.slopes.at(point);
                for (s, o) in slope.iter_mut().flatten().zip(own.iter().flatten()) {
                    *s += amount * o;
                }
            }
        }
        slopes
    }
}
