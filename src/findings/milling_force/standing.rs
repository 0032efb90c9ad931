//! Where all that is merely uncertain stands beside what was found: angles of the teeth, coefficients, widths and the bandwidth move to
//! where they fit best, step by step, and no step is taken that leaves more. Causes of the process of one amount move with them.

use super::aim::Aim;
use super::anew::combined;
use super::direction::Direction;
use super::loose::Loose;
use super::setting::PROCESS;
use super::{Case, EFFECTS, runout, sensor_resonance, spindle_speed};
use crate::experiments::milling_force::RUNOUT;
use crate::findings::engine::Blamed;

/// What was found in place, and what is uncertain where it fits best.
pub(super) struct Standing {
    /// The case there.
    pub case: Case,
    /// The causes there.
    pub blamed: Vec<Blamed>,
    /// All that moved, in the vector.
    pub turned: Vec<f64>,
    /// Of it the coefficients, widths and the bandwidth that stand elsewhere than stated.
    pub followed: Vec<f64>,
    /// What is uncertain and does not move: what its slopes say.
    rest: Vec<f64>,
    /// What is left, squared noise deviations, and how far what followed and rests is from what is known of it.
    left: f64,
}

/// Where what is uncertain goes: angles from here, all else from where it is stated.
struct Way {
    /// By how much the amount of every cause grows.
    grown: Vec<f64>,
    turned: Vec<f64>,
    followed: Vec<f64>,
    rest: Vec<f64>,
}

/// What all of it is beside.
struct Beside<'a> {
    case: &'a Case,
    /// Places and spreads of what follows.
    followers: Vec<(usize, f64)>,
}

/// Steps of the angles alone: they were found beside what is wrong, and a force that comes too late would make the slopes of all else
/// lie. No other number was tried.
const ALONE: usize = 2;
/// Most steps, and the share of what is left that one of all must gain for another: choices for time.
const STEPS: usize = 6;
const GAIN: f64 = 2e-3;
/// Shares of the way to where all fits best by its slopes, of which the first is taken that leaves less: far from what is stated a depth, a
/// filter and the coefficients bend each other's slopes, and whole steps went to and fro.
const SHARES: [f64; 3] = [1.0, 0.5, 0.2];
/// No further than so many of its standard deviations, or where nothing is known of a coefficient, than this share of it: short of
/// what a single cause may count on (`aim::FARTHEST`), since here the whole statement moves. No other values were tried.
const FARTHEST: f64 = 2.0;
const SHARE: f64 = 0.7;
/// Share of itself that a law may miss where coefficients follow what it leaves: a tremor, a resonance and a broken tooth
/// miss more (cases of seeds 461 to 464 of `tests/judge`, so these judge no number).
const MISSED: f64 = 0.07;

impl Standing {
    /// Beside causes that were found: angles alone, then all.
    pub fn of(case: &Case, blamed: &[Blamed]) -> Self {
        let beside = Beside::of(case, blamed);
        let none = || vec![0.0; case.places().len()];
        let mut turned = none();
        let angles = |b| sensor_resonance::angles(b).iter().enumerate();
        for (c, angle) in blamed.iter().flat_map(angles) {
            turned[case.places().phase(c)] = *angle;
        }
        let mut standing = beside.standing(blamed.to_vec(), turned, none(), none());
        for step in 0..STEPS {
            let next = match step < ALONE {
                true => Some(beside.at(&standing, standing.alone(), 1.0)),
                false => standing.lower(&beside),
            };
            let better = next.filter(|next| next.left < standing.left);
            let gain = better
                .as_ref()
                .map_or(0.0, |b| 1.0 - b.left / standing.left);
            standing = better.unwrap_or(standing);
            if gain < GAIN && step >= ALONE {
                break;
            }
        }
        standing
    }

    /// The first share of the way to the best that leaves less.
    fn lower(&self, beside: &Beside) -> Option<Self> {
        let told = self.case.along(&self.followed);
        let moving = self.blamed.iter().enumerate().filter(|(_, b)| moves(b));
        let moving: Vec<usize> = moving.map(|(i, _)| i).collect();
        let of = |i: &usize| Loose::along(&self.blamed[*i].shape[1..]);
        let loose = [self.case.loose(), moving.iter().map(of).collect()].concat();
        let aim = Aim::new(&self.case, loose);
        let (best, amounts) = aim.best(&self.case, -1.0, &told, moving.len());
        let mut grown = vec![0.0; self.blamed.len()];
        moving.iter().zip(amounts).for_each(|(i, a)| grown[*i] = a);
        let step = |share: &f64| beside.at(self, beside.way(&best, &grown), *share);
        let mut steps = SHARES.iter().map(step);
        steps.find(|next| next.left < self.left)
    }

    /// Angles of the teeth where they fit best and nothing else moves.
    fn alone(&self) -> Way {
        let (places, spread) = (self.case.places(), self.case.spread());
        let reading = self.case.reading();
        let mut turned = vec![0.0; places.len()];
        for c in 0..places.cuts {
            let slope = self.case.along(&places.unit(places.phase(c)));
            let rows = slope.iter().zip(&reading).zip(&spread);
            let sums = rows.fold([0.0; 2], |[cross, square], ((s, r), spread)| {
                let weight = s / (spread * spread);
                [cross + weight * r, square + weight * s]
            });
            turned[places.phase(c)] = sums[0] / sums[1].max(f64::MIN_POSITIVE);
        }
        Way {
            grown: vec![0.0; self.blamed.len()],
            turned,
            followed: self.followed.clone(),
            rest: self.rest.clone(),
        }
    }
}

impl<'a> Beside<'a> {
    fn of(case: &'a Case, blamed: &[Blamed]) -> Self {
        let followers = match blamed.iter().any(misses_much) {
            true => Vec::new(),
            false => followers(case),
        };
        Self { case, followers }
    }

    /// The way to what fits best, in the vector; followers go no further than they may. A runout that turns does so to where it
    /// fits, which no slope says.
    fn way(&self, best: &[f64], grown: &[f64]) -> Way {
        let (mut turned, mut followed) = (vec![0.0; best.len()], vec![0.0; best.len()]);
        let mut rest = best.to_vec();
        rest[RUNOUT..RUNOUT + 2].fill(0.0);
        for c in 0..self.case.places().cuts {
            let at = self.case.places().phase(c);
            turned[at] = std::mem::take(&mut rest[at]);
        }
        for (at, spread) in &self.followers {
            let most = match spread.is_finite() {
                true => FARTHEST * spread,
                false => SHARE * self.case.nominal()[*at].abs(),
            };
            followed[*at] = std::mem::take(&mut rest[*at]).clamp(-most, most);
        }
        Way {
            grown: grown.to_vec(),
            turned,
            followed,
            rest,
        }
    }

    /// A share of a way from somewhere.
    fn at(&self, from: &Standing, way: Way, share: f64) -> Standing {
        let towards = |from: &[f64], to: &[f64]| -> Vec<f64> {
            let each = from.iter().zip(to);
            each.map(|(f, t)| f + share * (t - f)).collect()
        };
        let followed = towards(&from.followed, &way.followed);
        let rest = towards(&from.rest, &way.rest);
        let places = self.case.places();
        let mut turned = from.turned.clone();
        for (at, now) in turned.iter_mut().enumerate() {
            *now += followed[at] - from.followed[at] + share * way.turned[at];
        }
        for c in 0..places.cuts {
            let most = FARTHEST * from.case.turn(c);
            turned[places.phase(c)] = turned[places.phase(c)].clamp(-most, most);
        }
        let mut blamed = from.blamed.clone();
        for (cause, more) in blamed.iter_mut().zip(&way.grown) {
            cause.amounts[0] += share * more;
        }
        turn_runout(self.case, &blamed, &mut turned);
        self.standing(blamed, turned, followed, rest)
    }

    fn standing(
        &self,
        blamed: Vec<Blamed>,
        turned: Vec<f64>,
        followed: Vec<f64>,
        rest: Vec<f64>,
    ) -> Standing {
        let case = combined(self.case, &turned, &blamed, "");
        let (reading, beside) = (case.reading(), case.along(&rest));
        let rows = reading.iter().zip(&beside).zip(case.spread());
        let left: f64 = rows
            .map(|((r, b), spread)| ((r - b) / spread).powi(2))
            .sum();
        let far = alone(&case).map(|(at, spread)| ((followed[at] + rest[at]) / spread).powi(2));
        Standing {
            left: left + far.sum::<f64>(),
            case,
            blamed,
            turned,
            followed,
            rest,
        }
    }
}

/// Whether a cause moves with what is uncertain: of the process and of one amount; the speed is in the scenes already.
fn moves(blamed: &Blamed) -> bool {
    let is_single = blamed.shape[0] == PROCESS && blamed.amounts.len() == 1;
    is_single && blamed.effect != spindle_speed::EFFECT.name
}

/// Places and spreads of what moves alone.
fn alone(case: &Case) -> impl Iterator<Item = (usize, f64)> {
    let single = |l: Loose| match l.along[..] {
        [(at, 1.0)] => Some((at, l.spread)),
        _ => None,
    };
    case.loose().into_iter().filter_map(single)
}

/// Of these what follows.
fn followers(case: &Case) -> Vec<(usize, f64)> {
    let places = case.places();
    let is_width = |at: usize| (0..places.cuts).any(|c| at == places.width(c));
    let follows = |at: usize| at < RUNOUT || is_width(at) || at == places.bandwidth();
    alone(case).filter(|(at, _)| follows(*at)).collect()
}

/// Whether a law misses so much of itself that coefficients would follow its error.
fn misses_much(blamed: &Blamed) -> bool {
    let mut own = EFFECTS.iter().filter(|e| e.name == blamed.effect);
    own.any(|e| e.law_error > MISSED)
}

/// Turns a runout that is stated by its size alone to where it fits best, beside all that were found but a
/// runout itself.
fn turn_runout(case: &Case, blamed: &[Blamed], turned: &mut [f64]) {
    let Some(size) = case
        .file()
        .facts
        .runout_m
        .filter(|_| case.places().teeth > 1)
    else {
        return;
    };
    let beside = combined(case, turned, blamed, runout::EFFECT.name);
    if let Some(direction) = Direction::seen(&beside) {
        let before = case.runout();
        let now = direction.of_size(size);
        (0..2).for_each(|k| turned[RUNOUT + k] = now[k] - before[k]);
    }
}
