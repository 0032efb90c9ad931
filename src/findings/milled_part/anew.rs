//! What is uncertain, told anew about what was found: a softer robot swings otherwise, and so does what may be off of it.

use super::Case;
use super::uncertain::{Known, missed, put};
use crate::findings::engine::{Blamed, Nuisance};
use crate::ground::stats::{difference, quantile, rms};
use crate::process::setup::Support;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// About whom it was told.
pub(super) type Told = Mutex<Vec<(Blamed, Vec<Nuisance>)>>;

/// Deviations of a row, rms, from which a cause changes what others do. A choice for time, no measurement.
const LARGE: f64 = 4.0;
/// About how many causes it is told, each once, where it was first stated about: a choice for time, each takes some twenty runs.
const MOST: usize = 4;
/// Mean square, in standard deviations, of what is uncertain beyond which nobody believes the cause that needs it. A choice for
/// time: on two parts by a stranger it cost 8 to 30 nats beside true causes and 101 to 237 beside others; this is 1.25 for each number.
const FAR: f64 = 2.5;
/// Changes at which what is uncertain is tried, as far as it may be off.
const TRIED: [f64; 2] = [0.02, 0.2];

impl Case {
    /// What is uncertain beside causes, these amounts of it being needed.
    pub(super) fn uncertain_about(&self, about: &[Blamed], amounts: &[f64]) -> Vec<Nuisance> {
        let asked = |main| self.may_ask(amounts).then(|| self.told_anew(main))?;
        let main = self.main(about);
        let told = main.and_then(|main| self.told(main).or_else(|| asked(main)));
        told.unwrap_or_else(|| {
            self.stated()
                .uncertain
                .iter()
                .map(|u| u.1.clone())
                .collect()
        })
    }

    /// The same, what laws miss being a share of another simulated deviation.
    pub(super) fn with_laws_of(&self, mut all: Vec<Nuisance>, simulated: &[f64]) -> Vec<Nuisance> {
        let missed = missed(self, simulated);
        for (nuisance, (known, _)) in all.iter_mut().zip(&self.stated().uncertain) {
            if let Known::Law(k) = known {
                nuisance.column.clone_from(&missed[*k]);
            }
        }
        all
    }

    /// The largest of what was found that changes what others do.
    fn main<'a>(&self, about: &'a [Blamed]) -> Option<&'a Blamed> {
        let size = |blamed: &Blamed| rms(&blamed.part);
        let bent = about.iter().filter(|b| self.swings() && self.bends(b));
        let largest = bent.max_by(|a, b| size(a).total_cmp(&size(b)));
        largest.filter(|b| size(b) > LARGE * quantile(&self.spread, 0.5))
    }

    fn believes(&self, amounts: &[f64]) -> bool {
        let known = self.stated().uncertain.iter().zip(amounts);
        let known = known.filter(|((_, nuisance), _)| nuisance.spread.is_finite());
        let far: Vec<f64> = known.map(|((_, n), amount)| amount / n.spread).collect();
        rms(&far).powi(2) <= FAR
    }

    /// What was told about a cause of the same form.
    fn told(&self, main: &Blamed) -> Option<Vec<Nuisance>> {
        let all = self.anew.lock().unwrap_or_else(PoisonError::into_inner);
        let is_own = |told: &&(Blamed, Vec<Nuisance>)| {
            let own = &told.0;
            own.effect == main.effect && own.site == main.site && form(own) == form(main)
        };
        all.iter().find(is_own).map(|told| told.1.clone())
    }

    fn may_ask(&self, amounts: &[f64]) -> bool {
        let all = self.anew.lock().unwrap_or_else(PoisonError::into_inner);
        all.len() < MOST && self.believes(amounts)
    }

    fn told_anew(&self, main: &Blamed) -> Option<Vec<Nuisance>> {
        let mut setup = self.trial.clone();
        self.alter(main, &mut setup);
        let mill = |setup: &_| {
            let left = self.milled_again((setup, Support::Coupled), &[main], &[]);
            left.map(|left| self.seen(&left))
        };
        let base = mill(&setup)?;
        let column = |known: &Known, change: f64| {
            let mut other = self.trial.clone();
            put(known, change, &mut other).then_some(())?;
            self.alter(main, &mut other);
            let column = mill(&other)?;
            let more = difference(&column, &base).into_iter();
            Some(more.map(|x| x / change).collect())
        };
        let anew = |(known, own): &(Known, Nuisance)| {
            let change = own.spread.clamp(TRIED[0], TRIED[1]);
            let column = column(known, change);
            Nuisance {
                column: column.unwrap_or_else(|| own.column.clone()),
                spread: own.spread,
            }
        };
        let told: Vec<Nuisance> = self.stated().uncertain.par_iter().map(anew).collect();
        let mut all = self.anew.lock().unwrap_or_else(PoisonError::into_inner);
        all.push((main.clone(), told.clone()));
        Some(told)
    }
}

/// Of what form a cause is that ends its shape with a strength or a size.
fn form(blamed: &Blamed) -> &[f64] {
    blamed.shape.split_last().map_or(&[], |(_, form)| form)
}
