//! The statement about causes that were found: every effect is looked at with all others in place, so that
//! what is not linear, and what a sensor makes of it, comes out right.

use super::experiment::ROUGH;
use super::patterns::PATTERNS;
use super::setting::PROCESS;
use super::{Case, EFFECTS, coefficients, cross_talk, force_gain, runout};
use crate::experiments::milling_force::RUNOUT;
use crate::findings::engine::{Blamed, Statement, Suspect};
use crate::findings::table::{self, Effect};
use crate::ground::spatial::{M3, add};

/// Rounds in which the angles of the teeth follow.
const ROUNDS: usize = 2;

/// The case with the found causes in place, and each mechanism's own: all but it in place.
struct Anew {
    /// All in place.
    all: Case,
    /// Effects that were found, with the case that lacks only them.
    without: Vec<(&'static str, Case)>,
    /// What the causes add that are neither of the process nor a map of forces.
    beside: Vec<f64>,
}

/// The statement about some causes.
pub(super) fn about(case: &Case, blamed: &[Blamed]) -> Statement {
    let anew = Anew::of(case, blamed);
    let mut reading = anew.all.reading();
    add_to(&mut reading, &anew.beside, 1.0);
    let forces = anew.all.forces();
    for (_, without) in &anew.without {
        add_to(&mut reading, &forces, 1.0);
        add_to(&mut reading, &without.forces(), -1.0);
    }
    let mut suspects: Vec<Suspect> = EFFECTS.iter().flat_map(|e| anew.suspects(e)).collect();
    suspects = table::rough(suspects, &ROUGH);
    suspects.extend(table::patterns(PATTERNS, &anew.all));
    Statement {
        reading,
        suspects,
        ..anew.all.statement()
    }
}

fn add_to(sum: &mut [f64], part: &[f64], factor: f64) {
    sum.iter_mut().zip(part).for_each(|(s, p)| *s += factor * p);
}

/// What a cause makes of forces, if that is all it does.
fn map(blamed: &Blamed) -> Option<M3> {
    [force_gain::map, cross_talk::map]
        .iter()
        .find_map(|of| of(blamed))
}

impl Anew {
    fn of(case: &Case, blamed: &[Blamed]) -> Self {
        let mut turned = vec![0.0; case.places().len()];
        let mut all = combined(case, &turned, blamed, "");
        for _ in 0..ROUNDS {
            let nothing = vec![0.0; case.column(|_, _, _| 0.0).len()];
            let uncertain = all.aim().uncertain(&all, 0.0, &nothing);
            let places = case.places();
            (0..places.cuts).for_each(|c| turned[places.phase(c)] += uncertain[places.phase(c)]);
            turn_runout(case, blamed, &uncertain, &mut turned);
            all = combined(case, &turned, blamed, "");
        }
        let mut names: Vec<&'static str> = blamed
            .iter()
            .filter(|b| b.shape[0] == PROCESS || map(b).is_some())
            .map(|b| b.effect)
            .collect();
        names.sort_unstable();
        names.dedup();
        let without = names
            .into_iter()
            .map(|name| (name, combined(case, &turned, blamed, name)))
            .collect();
        Self {
            beside: beside(case, blamed, ""),
            all,
            without,
        }
    }
}

/// Turns a runout that is stated by its size alone to where what is uncertain takes it.
fn turn_runout(case: &Case, blamed: &[Blamed], uncertain: &[f64], turned: &mut [f64]) {
    let found = blamed.iter().any(|b| b.effect == runout::EFFECT.name);
    let Some(size) = case.file().facts.runout_m.filter(|_| !found) else {
        return;
    };
    let before = case.runout();
    let [x, y] = [0, 1].map(|k| before[k] + turned[RUNOUT + k] + uncertain[RUNOUT + k]);
    let long = x.hypot(y).max(f64::MIN_POSITIVE);
    turned[RUNOUT] = x / long * size - before[0];
    turned[RUNOUT + 1] = y / long * size - before[1];
}

impl Anew {
    /// The sites of an effect: one that was found with all others in place, one that was not beside all that
    /// were, and in the place of its kin.
    fn suspects(&self, effect: &Effect<Case>) -> Vec<Suspect> {
        let of = |case: &Case| table::suspects(std::slice::from_ref(effect), case);
        if let Some((_, own)) = self.without.iter().find(|w| w.0 == effect.name) {
            return of(own);
        }
        let mut all = of(&self.all);
        let is_kin = |name: &str| {
            let other = EFFECTS.iter().find(|e| e.name == name);
            effect.mechanism == other.map_or("", |e| e.mechanism)
        };
        for (_, case) in self.without.iter().filter(|w| is_kin(w.0)) {
            for (suspect, more) in all.iter_mut().zip(of(case)) {
                suspect.members.extend(more.members);
            }
        }
        all
    }
}

/// The case with all causes in place but those of an effect.
fn combined(case: &Case, turned: &[f64], blamed: &[Blamed], but: &str) -> Case {
    let mut by = turned.to_vec();
    let mut seen = case.seen();
    for cause in blamed.iter().filter(|b| b.effect != but) {
        if cause.shape[0] == PROCESS {
            add_to(&mut by, &coefficients::moved(case, cause), 1.0);
        }
        if let Some(map) = map(cause) {
            (0..3).for_each(|k| seen[k] = add(seen[k], map[k]));
        }
    }
    // the speeds of the records are in the scenes already
    let places = case.places();
    (0..places.cuts).for_each(|c| by[places.speed(c)] = 0.0);
    case.moved(&by, seen, beside(case, blamed, but))
}

/// What causes add that are neither of the process nor a map of forces.
fn beside(case: &Case, blamed: &[Blamed], but: &str) -> Vec<f64> {
    let mut sum = case.column(|_, _, _| 0.0);
    for cause in blamed.iter().filter(|b| b.effect != but) {
        if cause.shape[0] != PROCESS && map(cause).is_none() {
            add_to(&mut sum, &cause.part, 1.0);
        }
    }
    sum
}
