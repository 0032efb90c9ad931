//! A slope that rises and falls again: a gain with the room's heating, a pump that comes and goes, a joint that is held by a regulator.
//! What loosens never comes back.

use super::{Kind, Seen, Sought};
use crate::findings::load_cycle::families::View;
use crate::findings::table::flexible;
use std::f64::consts::TAU;

pub(super) const KIND: Kind = Kind {
    name: "wandering stiffness",
    summary: "a stiffness (or a gain) that falls and rises again",
    seek,
};

/// Turns in the record: from one, by so many, to the most; a single bend that does not come back is what loosens or settles.
const TURNS: (f64, f64, f64) = (1.0, 0.25, 6.0);
/// Cycles of the load in the shortest turn: a slope that changes within a cycle is a curve of the load, or a loop.
const CYCLES: f64 = 1.5;

fn seek(seen: &Seen) -> Sought {
    let view = seen.view;
    let most = (1.0 / (CYCLES * view.period)).min(TURNS.2);
    let count = ((most - TURNS.0) / TURNS.1 + 1.0 + 1e-9).max(0.0) as usize;
    let turns = (0..count).map(|k| TURNS.0 + TURNS.1 * k as f64);
    Sought {
        members: turns
            .flat_map(|turns| flexible(phases(view, turns)))
            .collect(),
        searched: 0.0,
    }
}

/// Both phases of a slope that swings so often in the record.
fn phases(view: &View, turns: f64) -> Vec<Vec<f64>> {
    let swing = |phase: fn(f64) -> f64| -> Vec<f64> {
        let each = view.u.iter().zip(&view.t);
        each.map(|(u, t)| u * phase(TAU * turns * t)).collect()
    };
    let both = [swing(f64::sin), swing(f64::cos)];
    both.iter().filter_map(|c| view.beyond_spring(c)).collect()
}
