//! The cut chatters: oscillations at frequencies that are no harmonics of the spindle.

use super::Case;
use super::lines::Line;
use super::setting::SENSOR;
use super::sought::Sought;
use super::tremor::Tremor;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;
use std::f64::consts::TAU;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "chatter",
    summary: "The cut chatters at a frequency that is no harmonic of the spindle.",
    mechanism: "chatter",
    // a tremor has no single direction or frequency
    law_error: 0.09,
    can_be: |_, _| true,
    places: |case| vec![Place::new("tool", members(case))],
    parameters: |_, blamed| told(&blamed.shape, &blamed.amounts),
    would_tell: "cut at another spindle speed or a smaller depth",
};

/// Frequency and size, and the cut where it is one; of tremors of several cuts all of them, cut by cut.
fn told(shape: &[f64], amounts: &[f64]) -> Vec<(&'static str, f64, &'static str)> {
    let root = |own: &[f64]| own.iter().map(|a| a * a).sum::<f64>().sqrt();
    let cut = |number: f64| (number > 0.0).then_some(("cut", number, "1"));
    if shape[3] > TREMOR {
        let line = [
            ("frequency", shape[2], "Hz"),
            ("amplitude", root(amounts), "N"),
        ];
        return line.into_iter().chain(cut(shape[1])).collect();
    }
    let each = shape[1..].chunks(3).zip(amounts.chunks(WAYS));
    each.flat_map(|(own, amounts)| {
        let one = [
            ("frequency", own[1], "Hz"),
            ("tremor", 1e-6 * root(amounts), "m"),
        ];
        one.into_iter().chain(cut(own[0]))
    })
    .collect()
}

/// The highest lines of every cut, each with its own phase on x and y, or on all axes; the highest of all in every cut; and
/// tremors of the tool that make the highest of all, or those of every cut.
fn members(case: &Case) -> Vec<Member> {
    let lines = case.lines();
    let mut members: Vec<Member> = lines
        .iter()
        .flat_map(|line| [2, 3].map(|axes| member(case, &[line.cut], line.frequency_hz, axes)))
        .collect();
    let highest = lines.iter().max_by(|a, b| a.height.total_cmp(&b.height));
    if let Some(line) = highest {
        members.extend(tremors(case, line));
    }
    if let Some(line) = highest.filter(|_| case.cuts().len() > 1) {
        let every: Vec<usize> = (0..case.cuts().len()).collect();
        members.push(member(case, &every, line.frequency_hz, 2));
    }
    members
}

/// Stands in the shape of a tremor where lines have the number of their axes.
const TREMOR: f64 = 0.0;
/// Amounts of one: along the feed and left of it, each in two phases.
const WAYS: usize = 4;
/// Share by which its frequency may differ from cut to cut: of the files by strangers that were looked at it was up to 6 %.
const ALIKE: f64 = 0.15;
/// Steps in which the frequency of a tremor is brought closer, as shares of the resolution of the record.
const CLOSER: [f64; 5] = [0.4, 0.25, 0.15, 0.08, 0.04];
/// Multiples of the tooth passing by which a line may lie beside the tremor that makes it.
const BESIDE: [f64; 7] = [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0];

/// The tremor of the tool that makes a line and those beside it.
fn stirred(case: &Case, line: &Line) -> Option<Member> {
    let tremor = Tremor::new(case, line.cut);
    let passing = tremor.passing_hz(case);
    let each = BESIDE.iter().map(|m| line.frequency_hz + m * passing);
    let time = &case.cuts()[line.cut].time;
    let ends = time.first().zip(time.last());
    let resolution = ends.map_or(0.0, |(a, b)| (b - a).max(1e-9).recip());
    let nearer =
        CLOSER.map(|share| move |hz: f64| [-1.0, 1.0].map(|side| hz + side * share * resolution));
    let columns = |hz| tremor.columns(case, hz);
    let tried = each.filter(|hz| *hz > 0.0);
    let found = Sought::of(case, tried, columns, (f64::NEG_INFINITY, &nearer));
    found.map(|found| Member {
        columns: found.columns,
        size: Size::Free,
        shape: vec![SENSOR, (line.cut + 1) as f64, found.at, TREMOR],
        ..Member::free(Vec::new())
    })
}

/// The tremor of the tool that makes the highest line of all, and those of all cuts that have lines of about that frequency, each with its
/// own: what chatters in one cut does so in the next.
fn tremors(case: &Case, highest: &Line) -> Vec<Member> {
    let Some(first) = stirred(case, highest) else {
        return Vec::new();
    };
    let of = |cut: usize| {
        let own = case.lines().iter().filter(|l| l.cut == cut);
        own.max_by(|a, b| a.height.total_cmp(&b.height))
    };
    let others = (0..case.cuts().len()).filter(|cut| *cut != highest.cut);
    let others = others.filter_map(of).filter_map(|l| stirred(case, l));
    let alike = |m: &Member| (m.shape[2] / first.shape[2] - 1.0).abs() < ALIKE;
    let mut each: Vec<Member> = others.filter(alike).collect();
    each.insert(0, first.clone());
    let every = (each.len() > 1).then(|| Member {
        columns: each.iter().flat_map(|m| m.columns.clone()).collect(),
        size: Size::Free,
        shape: std::iter::once(SENSOR)
            .chain(each.iter().flat_map(|m| m.shape[1..].to_vec()))
            .collect(),
        ..Member::free(Vec::new())
    });
    std::iter::once(first).chain(every).collect()
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
        shape: vec![SENSOR, number, hz, axes as f64],
        ..Member::free(Vec::new())
    }
}

#[cfg(test)]
mod tests {
    use super::told;

    #[test]
    fn tremors_of_several_cuts_are_told_one_by_one() {
        let shape = [0.0, 2.0, 700.0, 0.0, 1.0, 690.0, 0.0];
        let amounts = [3.0, 0.0, 4.0, 0.0, 0.0, 1.0, 0.0, 0.0];
        let wanted = [
            ("frequency", 700.0, "Hz"),
            ("tremor", 1e-6 * 5.0, "m"),
            ("cut", 2.0, "1"),
            ("frequency", 690.0, "Hz"),
            ("tremor", 1e-6, "m"),
            ("cut", 1.0, "1"),
        ];
        assert_eq!(told(&shape, &amounts), wanted);
    }

    #[test]
    fn a_line_of_all_cuts_is_told_once() {
        let told = told(&[0.0, 0.0, 50.0, 2.0], &[3.0, 4.0]);
        assert_eq!(told, [("frequency", 50.0, "Hz"), ("amplitude", 5.0, "N")]);
    }
}
