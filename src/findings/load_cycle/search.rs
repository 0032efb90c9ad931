//! All sets of one, two and three causes over the grids, by batched normal equations.

use crate::fit::candidates::Candidates;
use crate::fit::normal::{Found, Normal};

fn allowed(candidates: &Candidates, found: &Found) -> bool {
    found
        .atoms
        .iter()
        .zip(&found.amplitudes)
        .all(|(i, a)| *a > 0.0 || !candidates.atoms[*i].one_signed)
}

/// The best curve set of every combination of up to three causes worth refining, best first.
pub fn search(candidates: &Candidates, normal: &Normal, keep: usize) -> Vec<Found> {
    let m = candidates.atoms.len();
    let mut best = Best::default();
    for i in 0..m {
        best.offer(candidates, normal.single(i));
    }
    for i in 0..m {
        for j in i + 1..m {
            if candidates.cause(i) != candidates.cause(j) {
                best.offer(candidates, normal.solve(&[i, j]));
            }
        }
    }
    for pair in best.top(2, 20) {
        for j in 0..m {
            if pair
                .atoms
                .iter()
                .all(|i| candidates.cause(*i) != candidates.cause(j))
            {
                let mut atoms = pair.atoms.clone();
                atoms.push(j);
                best.offer(candidates, normal.solve(&atoms));
            }
        }
    }
    let mut all = best.top(1, usize::MAX);
    all.extend(best.top(2, keep));
    all.extend(best.top(3, keep / 2));
    all
}

/// The best set of curves per set of effects.
#[derive(Default)]
struct Best {
    found: std::collections::BTreeMap<Vec<usize>, Found>,
}

impl Best {
    fn offer(&mut self, candidates: &Candidates, found: Option<Found>) {
        let Some(found) = found.filter(|f| allowed(candidates, f)) else {
            return;
        };
        let mut key: Vec<usize> = found
            .atoms
            .iter()
            .map(|i| candidates.atoms[*i].effect)
            .collect();
        key.sort_unstable();
        match self.found.get_mut(&key) {
            Some(old) if old.nats >= found.nats => {}
            Some(old) => *old = found,
            None => {
                self.found.insert(key, found);
            }
        }
    }

    fn top(&self, size: usize, most: usize) -> Vec<Found> {
        let mut sets: Vec<Found> = self
            .found
            .values()
            .filter(|f| f.atoms.len() == size)
            .cloned()
            .collect();
        sets.sort_by(|a, b| b.nats.total_cmp(&a.nats));
        sets.truncate(most);
        sets
    }
}
