//! How far a single cause would have to go: its amounts beside what is merely uncertain, by weighted least
//! squares. Causes that are not linear are taken as the way from nothing to where they fit best together with
//! what is uncertain (a secant): the angle of the tooth and the coefficients move along.

use super::Case;
use super::setting::Places;
use crate::ground::products::gram;
use crate::ground::spatial::{M3, V3, add, rotate, scale};
use crate::ground::stats::rms;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// A direction of the vector that is uncertain although nothing is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct Loose {
    /// Its places, with how far each goes.
    pub along: Vec<(usize, f64)>,
    /// Its standard deviation before the data; infinite: nothing is known.
    pub spread: f64,
}

/// The reading and the nuisances in noise deviations.
pub struct Aim {
    loose: Vec<Loose>,
    nuisances: DMatrix<f64>,
    root: Option<Cholesky<f64, Dyn>>,
    reading: DVector<f64>,
    spread: Vec<f64>,
}

type M2 = [[f64; 2]; 2];

/// Rounds in which a secant is improved.
const ROUNDS: usize = 5;
/// Change of an amount, as a share of it, at which its column has arrived.
const ARRIVED: f64 = 0.01;
/// What is uncertain goes no further than so many of its standard deviations.
const FARTHEST: f64 = 3.0;
/// An angle of the tooth goes no further, rad.
const TURN: f64 = 1.0;

/// No sensor is farther off, and what counts as none.
const MOST_MAP: f64 = 0.8;
const LEAST_MAP: f64 = 0.02;

impl Aim {
    /// Of a case.
    pub fn new(case: &Case, loose: Vec<Loose>) -> Self {
        let spread = case.spread();
        let places = case.places();
        let columns: Vec<DVector<f64>> = loose
            .iter()
            .map(|l| white(&case.along(&l.direction(places)), &spread))
            .collect();
        let nuisances = match columns.is_empty() {
            true => DMatrix::zeros(spread.len(), 0),
            false => DMatrix::from_columns(&columns),
        };
        let mut inner = gram(&nuisances);
        for (k, l) in loose.iter().enumerate() {
            inner[(k, k)] += (l.spread * l.spread).recip() + 1e-10 * inner[(k, k)];
        }
        Self {
            root: inner.cholesky(),
            nuisances,
            reading: white(&case.reading(), &spread),
            spread,
            loose,
        }
    }

    /// Most probable nuisances for a whitened column.
    fn seen(&self, column: &DVector<f64>) -> DVector<f64> {
        let seen = self.nuisances.tr_mul(column);
        match &self.root {
            Some(root) => root.solve(&seen),
            None => DVector::zeros(seen.len()),
        }
    }

    /// The last two nuisances, from number `first` on: most probable amounts and their covariance, in their own units.
    pub fn last_two(&self, first: usize) -> Option<([f64; 2], M2)> {
        let all = self.seen(&self.reading);
        let root = self.root.as_ref()?;
        let unit = |k: usize| {
            let mut unit = DVector::zeros(self.loose.len());
            unit[first + k] = 1.0;
            root.solve(&unit)
        };
        let columns = [0, 1].map(unit);
        let covariance = [0, 1].map(|i| [0, 1].map(|j| columns[j][first + i]));
        Some(([all[first], all[first + 1]], covariance))
    }

    /// What the nuisances leave of a whitened column.
    fn free(&self, column: &DVector<f64>) -> DVector<f64> {
        column - &self.nuisances * self.seen(column)
    }

    /// Amounts of some columns together, zeros where they show nothing, and by how much they lower the misfit, nats.
    pub fn fitted(&self, columns: &[Vec<f64>]) -> (Vec<f64>, f64) {
        let own: Vec<DVector<f64>> = columns.iter().map(|c| white(c, &self.spread)).collect();
        let free: Vec<DVector<f64>> = own.iter().map(|c| self.free(c)).collect();
        let free = DMatrix::from_columns(&free);
        let mut inner = DMatrix::from_columns(&own).tr_mul(&free);
        (0..own.len()).for_each(|i| inner[(i, i)] *= 1.0 + 1e-9);
        let pull = free.tr_mul(&self.reading);
        let solved = inner.cholesky().map(|root| root.solve(&pull));
        let amounts = solved.unwrap_or_else(|| DVector::zeros(own.len()));
        (amounts.as_slice().to_vec(), 0.5 * amounts.dot(&pull))
    }

    /// Their amounts alone.
    pub fn amounts(&self, columns: &[Vec<f64>]) -> Vec<f64> {
        self.fitted(columns).0
    }

    /// By how much one column lowers the misfit, nats.
    pub fn gain(&self, column: &[f64]) -> f64 {
        let own = white(column, &self.spread);
        let free = self.free(&own);
        let (pull, square) = (free.dot(&self.reading), free.dot(&own));
        match square > 1e-9 * own.norm_squared() {
            true => 0.5 * pull * pull / square,
            false => 0.0,
        }
    }

    /// The column of a direction of the vector as the way to where it fits best, at most `most` far. It begins
    /// at the slope, or at the best of some amounts: where the force jumps, no slope says where to go.
    pub fn secant(&self, case: &Case, direction: &[f64], most: f64, starts: &[f64]) -> Vec<f64> {
        let slope = case.along(direction);
        let tried = starts
            .iter()
            .map(|start| self.reached(case, direction, *start, &slope));
        let better = |a: (f64, Vec<f64>), b: (f64, Vec<f64>)| if b.0 > a.0 { b } else { a };
        let best = starts
            .iter()
            .zip(tried)
            .map(|(start, column)| (self.worth(&column, *start), column));
        let mut best = best.fold((0.0, slope.clone()), better);
        if best.1.iter().all(|x| *x == 0.0) {
            return best.1;
        }
        let slope = best.1.clone();
        let (mut column, mut before) = (best.1.clone(), 0.0);
        for _ in 0..ROUNDS {
            let amount = self.amounts(std::slice::from_ref(&column))[0].clamp(-most, most);
            if amount.abs() < 1e-3 * most || (amount - before).abs() < ARRIVED * amount.abs() {
                break;
            }
            before = amount;
            column = self.reached(case, direction, amount, &column);
            if is_wild(&column, &slope) {
                break;
            }
            best = better(best, (self.worth(&column, amount), column.clone()));
        }
        best.1
    }

    /// By how much an amount of a column lowers the misfit, nats.
    fn worth(&self, column: &[f64], amount: f64) -> f64 {
        let own = white(column, &self.spread);
        let free = self.free(&own);
        amount * free.dot(&self.reading) - 0.5 * amount * amount * free.dot(&own)
    }

    /// What an amount along a direction adds where what is uncertain stands as fits best beside it, less what
    /// that adds by itself, over the amount. `column`: the same, as known so far.
    pub fn reached(&self, case: &Case, direction: &[f64], amount: f64, column: &[f64]) -> Vec<f64> {
        let mut whole = self.beside(case, amount, column, |uncertain| {
            let each = uncertain.iter().zip(direction);
            case.step(&each.map(|(u, d)| u + d * amount).collect::<Vec<_>>())
        });
        whole.iter_mut().for_each(|x| *x /= amount);
        whole
    }

    /// What one unit of a map of forces adds, what is uncertain standing as fits best beside it.
    pub fn mapped(&self, case: &Case, map: &M3) -> Vec<f64> {
        let forces: Vec<V3> = case
            .forces()
            .chunks(3)
            .map(|f| [f[0], f[1], f[2]])
            .collect();
        let flat = |f: V3| f.into_iter();
        let mut column: Vec<f64> = forces.iter().flat_map(|f| flat(rotate(map, *f))).collect();
        let (mut best, mut before) = ((0.0, column.clone()), 0.0);
        for _ in 0..ROUNDS {
            let amount = self.amounts(std::slice::from_ref(&column))[0].clamp(-MOST_MAP, MOST_MAP);
            let worth = self.worth(&column, amount);
            if worth > best.0 {
                best = (worth, column.clone());
            }
            if amount.abs() < LEAST_MAP || (amount - before).abs() < ARRIVED * amount.abs() {
                break;
            }
            before = amount;
            column = self.beside(case, amount, &column, |to| {
                let step = case.step(to);
                let each = forces.iter().zip(step.chunks(3));
                let whole = |(f, s): (&V3, &[f64])| {
                    let step = [s[0], s[1], s[2]];
                    add(step, scale(amount, rotate(map, add(*f, step))))
                };
                each.flat_map(|pair| flat(whole(pair))).collect()
            });
            column.iter_mut().for_each(|x| *x /= amount);
        }
        best.1
    }

    /// What something adds where what is uncertain stands as fits best beside an amount of `column`, less what
    /// that adds by itself. `whole`: what both add together, over the vector of what is uncertain.
    pub fn beside(
        &self,
        case: &Case,
        amount: f64,
        column: &[f64],
        whole: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Vec<f64> {
        let left = &self.reading - white(column, &self.spread) * amount;
        let (to, alone) = self.placed(case, &self.seen(&left));
        let each = whole(&to).into_iter().zip(&alone);
        each.map(|(s, a)| s - a).collect()
    }

    /// Nuisances, no farther than they may go: as a vector of all places, and what they add by their slopes.
    fn placed(&self, case: &Case, uncertain: &DVector<f64>) -> (Vec<f64>, Vec<f64>) {
        let mut to = vec![0.0; case.places().len()];
        let mut alone = DVector::zeros(self.loose.len());
        for (k, loose) in self.loose.iter().enumerate() {
            let most = match loose.spread.is_finite() {
                true => FARTHEST * loose.spread,
                false => self.widest(loose, case),
            };
            alone[k] = uncertain[k].clamp(-most, most);
            loose.add_to(&mut to, alone[k]);
        }
        let alone = &self.nuisances * alone;
        let each = alone.iter().zip(&self.spread);
        (to, each.map(|(a, spread)| a * spread).collect())
    }

    /// What is uncertain beside an amount of a column, as a vector of all places.
    pub fn uncertain(&self, case: &Case, amount: f64, column: &[f64]) -> Vec<f64> {
        let left = &self.reading - white(column, &self.spread) * amount;
        let mut to = vec![0.0; case.places().len()];
        let seen = self.seen(&left);
        let each = self.loose.iter().zip(seen.iter());
        each.for_each(|(l, u)| l.add_to(&mut to, *u));
        to
    }

    /// How far something goes of which nothing is known: an angle, or a coefficient of its own size.
    fn widest(&self, loose: &Loose, case: &Case) -> f64 {
        let place = loose.along.first().map(|a| a.0);
        match place.and_then(|place| case.nominal().get(place)) {
            Some(value) => value.abs(),
            None => TURN,
        }
    }
}

impl Loose {
    /// One place.
    pub fn place(place: usize, spread: f64) -> Self {
        Self {
            along: vec![(place, 1.0)],
            spread,
        }
    }

    /// One unit of it.
    pub fn direction(&self, places: Places) -> Vec<f64> {
        let mut to = vec![0.0; places.len()];
        self.add_to(&mut to, 1.0);
        to
    }

    fn add_to(&self, to: &mut [f64], amount: f64) {
        let each = self.along.iter();
        each.for_each(|(place, factor)| to[*place] += factor * amount);
    }
}

/// Times the size of a slope above which a way is not the cause's own: what is uncertain went far beside a small
/// amount, and is not linear itself. Seen where 0.03 µm of runout took four tenths of a misfit (seed 403 of
/// `tests/judge`); no other value was tried.
const WILD: f64 = 3.0;

/// Whether a way is much larger than the slope at its start.
pub fn is_wild(way: &[f64], slope: &[f64]) -> bool {
    rms(way) > WILD * rms(slope)
}

fn white(column: &[f64], spread: &[f64]) -> DVector<f64> {
    let each = column.iter().zip(spread).map(|(c, s)| c / s);
    DVector::from_iterator(column.len(), each)
}
