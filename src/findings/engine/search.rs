//! Which sets of causes are worth comparing: a rank-one scan of every shape beside a base, the best
//! exactly; from nothing, from the best singles, from the best pairs; then every subset of what leads.

use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use crate::inference::gaussian::Size;
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// A set of causes in its best shapes.
#[derive(Debug, Clone)]
pub struct Scored {
    /// The suspects, ascending.
    pub suspects: Vec<usize>,
    /// Its fit.
    pub fit: Fit,
    /// Evidence over that of no cause, less the prices, nats.
    pub score: f64,
}

impl Scored {
    /// A fit with its evidence over that of no cause, less the price.
    pub(super) fn of(bank: &Bank, fit: Fit, nothing: &Fit, judgement: &Judgement) -> Self {
        let gained = fit.posterior.ln_evidence - nothing.posterior.ln_evidence;
        let members = fit.members.iter();
        Self {
            suspects: members.map(|m| bank.entries[*m].suspect).collect(),
            score: gained - price(bank, &fit.members, judgement),
            fit,
        }
    }
}

/// Bases that are continued, by the number of causes that they hold: from the ablations of the prototype
/// (house note "families"), where a wider beam found nothing more.
const CONTINUED: [usize; 4] = [1, 7, 3, 2];
/// Shapes of one column that are fitted exactly, of every suspect beside every base.
const EXACT: usize = 2;
/// Leading sets whose subsets are fitted, and whose shapes are tried again beside the others.
const LEADING: usize = 6;
/// Drawn shapes beyond which not all of a suspect's are fitted exactly beside every base, and how many are then:
/// they are wide, and neighbours overlap.
const MANY: usize = 12;
const MOST_PROMISING: usize = 6;
/// Sizes at which a column is scanned, noise deviations.
const SIZES: [f64; 10] = [0.3, 0.7, 1.5, 3.0, 6.0, 12.0, 25.0, 60.0, 200.0, 1000.0];

/// All sets compared, best first; the empty one among them.
pub fn search(bank: &mut Bank, judgement: &Judgement) -> Vec<Scored> {
    let Some(nothing) = bank.fit(&[]) else {
        return Vec::new();
    };
    let mut book = Book {
        judgement,
        nothing: nothing.clone(),
        sets: BTreeMap::new(),
    };
    book.offer(bank, nothing);
    for (size, count) in CONTINUED.iter().enumerate().take(judgement.largest) {
        for base in book.top(bank, size, *count) {
            book.extend(bank, &base);
        }
        book.reshape(bank);
    }
    book.divide(bank);
    let mut all: Vec<Scored> = book.sets.into_values().collect();
    all.sort_by(|a, b| {
        b.score
            .total_cmp(&a.score)
            .then(a.suspects.cmp(&b.suspects))
    });
    all
}

struct Book<'a> {
    judgement: &'a Judgement,
    nothing: Fit,
    /// The best fit of every set of suspects.
    sets: BTreeMap<Vec<usize>, Scored>,
}

impl Book<'_> {
    fn offer(&mut self, bank: &Bank, fit: Fit) {
        let set = Scored::of(bank, fit, &self.nothing, self.judgement);
        let old = self.sets.get(&set.suspects);
        if old.is_none_or(|old| old.score < set.score) {
            self.sets.insert(set.suspects.clone(), set);
        }
    }

    /// The best sets with so many causes.
    fn top(&self, bank: &Bank, size: usize, count: usize) -> Vec<Fit> {
        let own = self.sets.values().filter(|s| s.suspects.len() == size);
        best(bank, own.collect(), count)
    }

    /// Every suspect beside a base, in its most promising shapes.
    fn extend(&mut self, bank: &mut Bank, base: &Fit) {
        base.members.iter().for_each(|m| bank.keep(*m));
        let held: Vec<usize> = base
            .members
            .iter()
            .map(|m| bank.entries[*m].suspect)
            .collect();
        let wanted = |suspect: usize| !held.contains(&suspect);
        for member in promising(bank, base, wanted) {
            self.join(bank, base, member);
        }
    }

    fn join(&mut self, bank: &Bank, base: &Fit, member: usize) {
        let mut members = base.members.clone();
        members.push(member);
        members.sort_by_key(|m| bank.entries[*m].suspect);
        if let Some(fit) = bank.fit(&members) {
            self.offer(bank, fit);
        }
    }

    /// Tries the shapes of every cause of the leading sets again, now beside the others.
    fn reshape(&mut self, bank: &mut Bank) {
        for set in self.leading(bank, 3) {
            for at in 0..set.members.len() {
                let suspect = bank.entries[set.members[at]].suspect;
                let rest: Vec<usize> = (0..set.members.len())
                    .filter(|i| *i != at)
                    .map(|i| set.members[i])
                    .collect();
                if let Some(base) = bank.fit(&rest) {
                    rest.iter().for_each(|m| bank.keep(*m));
                    for member in promising(bank, &base, |s| s == suspect) {
                        self.join(bank, &base, member);
                    }
                }
            }
        }
    }

    /// Every subset of the leading sets: what the choice falls back on.
    fn divide(&mut self, bank: &Bank) {
        for set in self.leading(bank, LEADING) {
            let n = set.members.len();
            for mask in 0..1_usize << n {
                let part = (0..n)
                    .filter(|i| mask >> i & 1 == 1)
                    .map(|i| set.members[i]);
                if let Some(fit) = bank.fit(&part.collect::<Vec<_>>()) {
                    self.offer(bank, fit);
                }
            }
        }
    }

    fn leading(&self, bank: &Bank, count: usize) -> Vec<Fit> {
        let own = self.sets.values().filter(|s| s.suspects.len() > 1);
        best(bank, own.collect(), count)
    }
}

/// What a set costs before the data, nats.
pub(super) fn price(bank: &Bank, members: &[usize], judgement: &Judgement) -> f64 {
    let own = |m: &usize| {
        let (suspect, entry) = (bank.suspect(*m), &bank.entries[*m]);
        let free = match entry.size {
            Size::Free => entry.rank.saturating_sub(1) as f64,
            Size::Given(_) | Size::Drawn => 0.0,
        };
        let shapes = (entry.forms as f64).ln() + bank.member(*m).rare;
        judgement.name - suspect.share + shapes + judgement.amount * free
    };
    let kin = |i: usize| {
        let mechanism = bank.suspect(members[i]).mechanism;
        let others = members[..i].iter();
        others
            .filter(|m| bank.suspect(**m).mechanism == mechanism)
            .count() as f64
    };
    let kin: f64 = (0..members.len()).map(kin).sum();
    members.iter().map(own).sum::<f64>()
        + judgement.companion * members.len().saturating_sub(1) as f64
        + judgement.same_mechanism * kin
}

/// The best of some sets, and the best of those of named causes alone: a pattern must not hide the way to causes
/// that explain the same together.
fn best(bank: &Bank, mut sets: Vec<&Scored>, count: usize) -> Vec<Fit> {
    sets.sort_by(|a, b| b.score.total_cmp(&a.score));
    let named = |s: &&Scored| s.suspects.iter().all(|s| bank.suspects[*s].named);
    let others = sets.iter().skip(count).copied();
    let causes = sets.iter().take(count).copied().filter(named).count();
    let others = others.filter(named).take(count - causes.min(count));
    let first = sets.iter().take(count).copied();
    first.chain(others).map(|s| s.fit.clone()).collect()
}

/// Members worth an exact fit beside a base that was kept: of every wanted suspect the best shapes of one
/// column, and all with more.
fn promising(bank: &Bank, base: &Fit, wanted: impl Fn(usize) -> bool) -> Vec<usize> {
    let cross = bank.cross(&base.members);
    let mut best: BTreeMap<usize, Vec<(f64, usize)>> = BTreeMap::new();
    let mut found = Vec::new();
    let mut wide: BTreeMap<usize, Vec<(f64, usize)>> = BTreeMap::new();
    for (member, entry) in bank.entries.iter().enumerate() {
        if !wanted(entry.suspect) {
            continue;
        }
        if entry.columns.len() != 1 {
            wide.entry(entry.suspect).or_default().push((0.0, member));
            continue;
        }
        let row = cross.row(entry.columns.start);
        let taken = (row * &base.posterior.covariance).dot(&row);
        let pull = bank.right[entry.columns.start] - row.dot(&base.posterior.mean.transpose());
        let square = (bank.square(entry) - taken).max(0.0);
        if let Some(rise) = rise(bank, base, member, (square, pull)) {
            best.entry(entry.suspect).or_default().push((rise, member));
        }
    }
    for mut own in best.into_values() {
        own.sort_by(|a, b| b.0.total_cmp(&a.0));
        found.extend(own.iter().take(EXACT).map(|b| b.1));
    }
    for own in wide.into_values() {
        let is_drawn = |w: &(f64, usize)| bank.entries[w.1].size == Size::Drawn;
        let (mut drawn, own): (Vec<_>, Vec<_>) = own.into_iter().partition(is_drawn);
        if drawn.len() > MANY {
            drawn
                .iter_mut()
                .for_each(|w| w.0 = promise(bank, base, &cross, w.1));
            drawn.sort_by(|a, b| b.0.total_cmp(&a.0));
            drawn.truncate(MOST_PROMISING);
        }
        found.extend(own.iter().chain(&drawn).map(|w| w.1));
    }
    found
}

/// Squares that the columns of a member take of what a base leaves, each alone.
fn promise(bank: &Bank, base: &Fit, cross: &DMatrix<f64>, member: usize) -> f64 {
    let entry = &bank.entries[member];
    let one = |(k, column): (usize, usize)| {
        let row = cross.row(column);
        let taken = (row * &base.posterior.covariance).dot(&row);
        let pull = bank.right[column] - row.dot(&base.posterior.mean.transpose());
        let square = entry.own[(k, k)];
        match square - taken > 1e-6 * square {
            true => pull * pull / (square - taken),
            false => 0.0,
        }
    };
    entry.columns.clone().enumerate().map(one).sum()
}

/// Rise of ln E by one column: rank-one update of the Student evidence, at the best of some sizes.
fn rise(bank: &Bank, base: &Fit, member: usize, (square, pull): (f64, f64)) -> Option<f64> {
    let wrong = bank
        .member(member)
        .positive
        .as_ref()
        .is_some_and(|w| w[0] * pull <= 0.0);
    if wrong || square <= 1e-12 * bank.square(&bank.entries[member]) {
        return None;
    }
    if let Size::Given(size) = bank.entries[member].size {
        let amount = pull / (square + (size * size).recip());
        if !bank.member(member).allows(&[amount]) {
            return None;
        }
    }
    let left = base.posterior.left;
    let before = bank.reading.ln_evidence(left);
    let at = |size: f64| {
        let gain = 1.0 + size * size * square;
        let after = left - size * size * pull * pull / gain;
        bank.reading.ln_evidence(after) - before - 0.5 * gain.ln()
    };
    match bank.entries[member].size {
        Size::Given(size) => Some(at(size)),
        Size::Free | Size::Drawn => SIZES.iter().map(|s| at(*s)).reduce(f64::max),
    }
}
