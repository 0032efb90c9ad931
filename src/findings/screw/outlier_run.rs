//! One run lies beside the others: something slipped or was set anew before it.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "outlier_run",
    summary: "One run lies beside the others.",
    mechanism: "run",
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
    let sloped = Member {
        columns: vec![case.column(own), case.column(|i| own(i) * case.at[i])],
        size: Size::Free,
        positive: None,
        shape: vec![1.0],
    };
    let mut members = vec![Member::free(case.column(own)), sloped];
    if case.both_ways() {
        members.extend([way(1.0), way(-1.0)]);
    }
    members
}
