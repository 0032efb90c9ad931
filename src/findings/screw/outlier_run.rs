//! One run lies beside the others: something slipped or was set anew before it.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, together};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "outlier_run",
    summary: "One run lies beside the others.",
    mechanism: "run",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let runs = case.runs();
        match runs.len() {
            0..3 => Vec::new(),
            _ => runs
                .into_iter()
                .map(|run| Place::new(format!("run{run}"), members(case, run)))
                .collect(),
        }
    },
    parameters: |_, blamed| {
        let mut found = vec![("shift", blamed.amounts[0], "m")];
        found.extend(blamed.amounts.get(1).map(|scale| ("scale", *scale, "m/m")));
        found
    },
    would_tell: "repeat the run",
};

fn members(case: &Case, run: i64) -> Vec<Member> {
    let own = |i: usize| f64::from(u8::from(case.test.readings[i].run == run));
    let way = |side: f64| {
        Member::free(case.column(|i| {
            if case.side[i] * side > 0.0 {
                own(i)
            } else {
                0.0
            }
        }))
    };
    let sloped = together(
        vec![case.column(own), case.column(|i| own(i) * case.at[i])],
        &[1.0],
    );
    let mut members = vec![Member::free(case.column(own)), sloped];
    if case.both_ways() {
        members.extend([way(1.0), way(-1.0)]);
    }
    members.extend(slips(case, run));
    members
}

/// Places within a run at which its zero may have slipped.
const SLIPS: usize = 24;

/// A zero that slipped within the run: all readings from one on, in the order in which an axis passes its
/// targets (a file may be sorted by target).
fn slips(case: &Case, run: i64) -> Vec<Member> {
    let mut own: Vec<usize> = (0..case.rows())
        .filter(|i| case.test.readings[*i].run == run)
        .collect();
    let way = |i: usize| if case.side[i] < 0.0 { 1.0 } else { -1.0 };
    own.sort_by(|a, b| {
        let of = |i: usize| (case.side[i], way(i) * case.at[i]);
        of(*a)
            .partial_cmp(&of(*b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let step = own.len().div_ceil(SLIPS).max(1);
    let from = |first: usize| {
        let mut column = vec![0.0; case.rows()];
        own[first..].iter().for_each(|i| column[*i] = 1.0);
        Member::free(column)
    };
    (1..own.len().saturating_sub(1))
        .step_by(step)
        .map(from)
        .collect()
}
