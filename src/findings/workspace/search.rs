//! Which sets of causes are worth comparing: every single, every pair, longer ones grown from the
//! best, and what a sparse convex programme proposes.

use super::field::Field;
use super::seats::Seats;
use super::set::Set;
use crate::causes::Blame;
use crate::fit::convex::non_negative;
use crate::ground::stats::log_sum_exp;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, HashMap};

/// Forms that pairs are built from.
const LEADERS: usize = 60;
/// Forms that longer sets are built from at most: hundreds of points have thousands, since each may be blamed. Files of
/// nine and of a hundred points gave the same answer with and without this bound.
const KEPT: usize = 800;
/// Forms of one seat that longer sets are built from.
const FORMS: usize = 4;
/// Sets whose members are tried in all their forms.
const REFINED: usize = 16;
/// Forms that the convex programme chooses from.
const PROPOSED: usize = 200;
/// Sets of one length that grow by one.
const BEAM: usize = 8;
/// Longest set.
const LONGEST: usize = 9;

/// All sets compared, best first; the empty one among them.
pub fn search(seats: &Seats, field: &Field) -> Vec<Set> {
    let mut book = Book {
        seats,
        field,
        sets: BTreeMap::new(),
        tried: HashMap::new(),
        kept: Vec::new(),
    };
    book.sets.insert(Vec::new(), Set::default());
    let mut singles: Vec<(f64, usize)> = Vec::new();
    for f in 0..seats.forms.len() {
        singles.push((book.add(&[f]), f));
    }
    singles.sort_by(|a, b| b.0.total_cmp(&a.0));
    book.keep(&singles);
    let kept = book.kept.clone();
    for (at, f) in kept.iter().take(LEADERS).enumerate() {
        for g in &kept[at + 1..] {
            book.add(&[*f, *g]);
        }
    }
    book.grow();
    book.propose();
    book.refine();
    let mut sets: Vec<Set> = book.sets.into_values().collect();
    sets.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.seats.cmp(&b.seats)));
    sets
}

struct Book<'a> {
    seats: &'a Seats,
    field: &'a Field,
    sets: BTreeMap<Vec<usize>, Set>,
    /// Score of every choice of forms.
    tried: HashMap<Vec<usize>, f64>,
    /// The forms that longer sets are built from, best first.
    kept: Vec<usize>,
}

impl Book<'_> {
    /// Compares one choice of forms; its score, or nothing to be had if a seat stands in it twice.
    fn add(&mut self, forms: &[usize]) -> f64 {
        let mut forms = forms.to_vec();
        forms.sort_unstable();
        if let Some(score) = self.tried.get(&forms) {
            return *score;
        }
        let seat = |f: &usize| self.seats.forms[*f].seat;
        if forms
            .windows(2)
            .any(|pair| seat(&pair[0]) == seat(&pair[1]))
        {
            return f64::MIN;
        }
        let one = Set::of(self.seats, self.field, &forms);
        let score = one.score;
        self.tried.insert(forms, score);
        match self.sets.entry(one.seats.clone()) {
            Entry::Vacant(entry) => drop(entry.insert(one)),
            Entry::Occupied(mut entry) => {
                let all = log_sum_exp([entry.get().score, score].into_iter());
                if score > entry.get().best {
                    entry.insert(one);
                }
                entry.get_mut().score = all;
            }
        }
        score
    }

    /// The best forms of every seat, of those compared alone and best first.
    fn keep(&mut self, singles: &[(f64, usize)]) {
        let mut count = vec![0; self.seats.seats.len()];
        for (_, f) in singles {
            let own = &mut count[self.seats.forms[*f].seat];
            *own += 1;
            if *own <= FORMS && self.kept.len() < KEPT {
                self.kept.push(*f);
            }
        }
    }

    /// Tries every form of every member of the best sets.
    fn refine(&mut self) {
        for _ in 0..2 {
            let mut own: Vec<&Set> = self.sets.values().filter(|s| s.seats.len() > 1).collect();
            own.sort_by(|a, b| b.best.total_cmp(&a.best));
            let starts: Vec<Vec<usize>> =
                own.iter().take(REFINED).map(|s| s.forms.clone()).collect();
            for start in starts {
                for at in 0..start.len() {
                    let seat = self.seats.forms[start[at]].seat;
                    for f in 0..self.seats.forms.len() {
                        if self.seats.forms[f].seat == seat {
                            let mut other = start.clone();
                            other[at] = f;
                            self.add(&other);
                        }
                    }
                }
            }
        }
    }

    /// Grows the best sets by one seat while that gains.
    fn grow(&mut self) {
        for length in 2..LONGEST {
            let mut own: Vec<&Set> = self
                .sets
                .values()
                .filter(|s| s.seats.len() == length)
                .collect();
            own.sort_by(|a, b| b.best.total_cmp(&a.best));
            let before = own.first().map_or(f64::MIN, |s| s.best);
            let starts: Vec<Vec<usize>> = own.iter().take(BEAM).map(|s| s.forms.clone()).collect();
            let mut after = f64::MIN;
            for start in starts {
                let held: Vec<usize> = start.iter().map(|f| self.seats.forms[*f].seat).collect();
                for f in self.kept.clone() {
                    if !held.contains(&self.seats.forms[f].seat) {
                        after = after.max(self.add(&[start.clone(), vec![f]].concat()));
                    }
                }
            }
            if after < before {
                return;
            }
        }
    }

    /// Beside two causes all parts of a kind, which few pairs lead to: two bends stand in for five bearings. Beside more, sparse
    /// selection by convex programming: what stays above zero when every amount pays for its
    /// size (Tibshirani 1996), over a falling price; then the members that do not pay are left out.
    fn propose(&mut self) {
        let best = self
            .sets
            .values()
            .max_by(|a, b| a.score.total_cmp(&b.score));
        let longest = best.map_or(0, |set| set.seats.len());
        if longest > 1 {
            for of_one_kind in self.kinds() {
                self.prune(of_one_kind);
            }
        }
        if longest < 3 {
            return;
        }
        let narrow = self.narrow();
        let columns: Vec<usize> = narrow.iter().map(|n| n.1).collect();
        let (mut gram, gradient) = self.field.quadratic(&columns);
        let n = columns.len();
        for i in 0..n {
            for j in 0..n {
                gram[(i, j)] *= narrow[i].2 * narrow[j].2;
            }
            gram[(i, i)] += 1e-3 * (1.0 + gram[(i, i)]);
        }
        let gradient = gradient.map_with_location(|i, _, g| g * narrow[i].2);
        let largest = gradient.max();
        for price in [0.3, 0.1, 0.03, 0.01] {
            let paid = gradient.map(|g| g - price * largest);
            let Ok(minimum) = non_negative(&gram, &paid) else {
                continue;
            };
            let mut chosen: Vec<(f64, usize)> = Vec::new();
            for (i, (form, _, _)) in narrow.iter().enumerate() {
                if minimum.free[i] {
                    chosen.push((minimum.x[i], *form));
                }
            }
            chosen.sort_by(|a, b| b.0.total_cmp(&a.0));
            self.prune(chosen.into_iter().map(|c| c.1).collect());
        }
    }

    /// The best form of every seat of a part that the model lacks, kind by kind: who forgot one
    /// bearing may have forgotten all.
    fn kinds(&self) -> Vec<Vec<usize>> {
        let mut found: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        let mut held = Vec::new();
        for f in &self.kept {
            let seat = self.seats.forms[*f].seat;
            let own = &self.seats.seats[seat];
            let structure = own.cause.blame() == Blame::Structure && !own.stranger;
            if structure && !held.contains(&seat) {
                held.push(seat);
                found.entry(own.cause.card().name).or_default().push(*f);
            }
        }
        found
            .into_values()
            .filter(|forms| forms.len() > 1)
            .collect()
    }

    /// One-column forms with a sign, of those that are best alone: those that may be negative stand in
    /// it twice.
    fn narrow(&self) -> Vec<(usize, usize, f64)> {
        let one = |f: &usize| {
            let form = &self.seats.forms[*f];
            form.columns.len() == 1 && form.width >= 1.0
        };
        let alone = |f: &usize| self.tried.get(&vec![*f]).copied().unwrap_or(f64::MIN);
        let mut forms: Vec<usize> = (0..self.seats.forms.len()).filter(one).collect();
        forms.sort_by(|a, b| alone(b).total_cmp(&alone(a)));
        forms.truncate(PROPOSED);
        forms.sort_unstable();
        let mut found = Vec::new();
        for f in forms {
            if let [column] = self.seats.forms[f].columns[..] {
                found.push((f, column, 1.0));
                if self.field.low(column) < 0.0 {
                    found.push((f, column, -1.0));
                }
            }
        }
        found
    }

    /// Leaves out one member after another while that raises the score.
    fn prune(&mut self, forms: Vec<usize>) {
        let mut held = Vec::new();
        for f in forms {
            let seat = |f: usize| self.seats.forms[f].seat;
            if held.iter().all(|g| seat(*g) != seat(f)) && held.len() < 2 * LONGEST {
                held.push(f);
            }
        }
        while held.len() > 1 {
            let own = self.add(&held);
            let less = |i: usize| [&held[..i], &held[i + 1..]].concat();
            let tries: Vec<(f64, usize)> =
                (0..held.len()).map(|i| (self.add(&less(i)), i)).collect();
            let best = tries.iter().max_by(|a, b| a.0.total_cmp(&b.0));
            match best {
                Some((score, i)) if *score > own => drop(held.remove(*i)),
                _ => return,
            }
        }
    }
}
