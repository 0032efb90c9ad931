//! The cut chatters: oscillations at frequencies that are no harmonics of the spindle.

use super::Case;
use super::setting::SENSOR;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;
use std::f64::consts::TAU;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "chatter",
    summary: "The cut chatters at a frequency that is no harmonic of the spindle.",
    mechanism: "chatter",
    places: |case| vec![Place::new("tool", members(case))],
    parameters: |_, blamed| {
        let square: f64 = blamed.amounts.iter().map(|a| a * a).sum();
        let mut told = vec![
            ("frequency", blamed.shape[2], "Hz"),
            ("amplitude", square.sqrt(), "N"),
        ];
        if blamed.shape[1] > 0.0 {
            told.push(("cut", blamed.shape[1], "1"));
        }
        told
    },
    would_tell: "cut at another spindle speed or a smaller depth",
};

/// The highest lines of every cut, each with its own phase on x and y, or on all axes; and the highest of
/// all in every cut.
fn members(case: &Case) -> Vec<Member> {
    let lines = case.lines();
    let mut members: Vec<Member> = lines
        .iter()
        .flat_map(|line| [2, 3].map(|axes| member(case, &[line.cut], line.frequency_hz, axes)))
        .collect();
    let highest = lines.iter().max_by(|a, b| a.height.total_cmp(&b.height));
    if let Some(line) = highest.filter(|_| case.cuts().len() > 1) {
        let every: Vec<usize> = (0..case.cuts().len()).collect();
        members.push(member(case, &every, line.frequency_hz, 2));
    }
    members
}

fn member(case: &Case, cuts: &[usize], hz: f64, axes: usize) -> Member {
    let wave = |cut: usize, axis: usize, quarter: f64| {
        case.column(|c, i, k| match c == cut && k == axis {
            true => (TAU * (hz * case.cuts()[c].time[i] - quarter)).cos(),
            false => 0.0,
        })
    };
    let mut columns = Vec::new();
    for cut in cuts {
        for axis in 0..axes {
            columns.extend([0.0, 0.25].map(|quarter| wave(*cut, axis, quarter)));
        }
    }
    let number = match cuts {
        [only] => (only + 1) as f64,
        _ => 0.0,
    };
    Member {
        columns,
        size: Size::Free,
        positive: None,
        shape: vec![SENSOR, number, hz, axes as f64],
    }
}
