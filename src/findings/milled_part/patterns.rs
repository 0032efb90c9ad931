//! Deviations of a part that no cause of the library makes. They compete with the causes and are never named.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{self, Pattern};
use crate::inference::gaussian::Size;

/// All of them.
pub(super) const PATTERNS: &[Pattern<Case>] = &[
    Pattern {
        name: "step",
        summary: "the deviation jumps at one time of the job: another tool, or a part that slipped",
        members: steps,
    },
    Pattern {
        name: "lobes",
        summary: "walls along one direction are off outwards, those across it inwards: a probe that reads by direction",
        members: lobes,
    },
    Pattern {
        name: "warp",
        summary: "the deviation is bent over the part: it was warped when it was probed",
        members: warps,
    },
];

/// Times at which a step is sought, at most: a large one at the wrong place is none.
const STEPS: usize = 160;

/// From a station on the tool is another one, or the part stands elsewhere.
fn steps(case: &Case) -> Vec<Member> {
    let mut times: Vec<f64> = case.stations.iter().map(|s| s.time_s).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let count = STEPS.min(times.len().saturating_sub(1));
    let from = |i: usize| times[((i + 1) * times.len()) / (count + 1)];
    (0..count).flat_map(|i| step(case, from(i))).collect()
}

fn step(case: &Case, from: f64) -> Vec<Member> {
    let after = |of: &dyn Fn(&super::Row) -> f64| {
        case.column(|s, row| if s.time_s >= from { of(row) } else { 0.0 })
    };
    let tool = [true, false].map(|left| after(&|row| f64::from(u8::from(row.left == left))));
    let part = [0, 1, 2].map(|k| after(&|row| row.across[k]));
    let members = [drawn(tool.to_vec()), drawn(part.to_vec())];
    members.into_iter().flatten().collect()
}

/// Walls that face ways whose numbers of twice per turn differ less than this are all alike: no lobe is seen there.
const LOBED: f64 = 1.0;

/// What a wall shows by the direction that it faces, twice per turn: once per turn is a datum, all alike a radius.
fn lobes(case: &Case) -> Vec<Member> {
    let facing = |row: &super::Row| 2.0 * row.across[1].atan2(row.across[0]);
    let twice =
        |of: fn(f64) -> f64| case.column(|_, row| if row.left { of(facing(row)) } else { 0.0 });
    let walls = || case.rows.iter().filter(|row| row.left);
    let unlike = [f64::cos, f64::sin].iter().any(|of| {
        let range = walls().fold([f64::INFINITY, f64::NEG_INFINITY], |r, row| {
            let value = of(facing(row));
            [r[0].min(value), r[1].max(value)]
        });
        range[1] - range[0] > LOBED
    });
    if !unlike {
        return Vec::new();
    }
    drawn(vec![twice(f64::cos), twice(f64::sin)])
        .into_iter()
        .collect()
}

/// Quadratics over the plane of the workpiece: upwards, and in all directions.
fn warps(case: &Case) -> Vec<Member> {
    let place = |k: usize| table::unit_range(&case.column(|s, _| s.tip[k]));
    let [x, y] = [place(0), place(1)].map(|u| u.iter().map(|u| 2.0 * u - 1.0).collect::<Vec<_>>());
    let bends: [fn(f64, f64) -> f64; 3] = [|x, _| x * x, |x, y| x * y, |_, y| y * y];
    let along = |k: usize| {
        bends.map(|bend| {
            let rows = case.rows.iter().zip(x.iter().zip(&y));
            rows.map(|(row, (x, y))| row.across[k] * bend(*x, *y))
                .collect::<Vec<f64>>()
        })
    };
    let upwards = along(2).to_vec();
    let all = (0..3).flat_map(along).collect();
    [drawn(upwards), drawn(all)].into_iter().flatten().collect()
}

/// Columns that are there, with amounts about zero; none where there is no column.
fn drawn(columns: Vec<Vec<f64>>) -> Option<Member> {
    let acts = |c: &Vec<f64>| c.iter().any(|x| x.abs() > 1e-9);
    let columns: Vec<Vec<f64>> = columns.into_iter().filter(acts).collect();
    (!columns.is_empty()).then_some(Member {
        columns,
        size: Size::Drawn,
        shape: vec![-1.0],
        ..Member::free(Vec::new())
    })
}
