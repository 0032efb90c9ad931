//! Ringing after the corners of the load: robot, weights or sensor swing when the load changes its course, and the swing dies
//! away. A mode that is pushed at every corner by the change of slope (of the load itself where that jumps), or at each by as much
//! as it happens.

use super::{Kind, Seen, Sought};
use crate::findings::load_cycle::families::View;
use crate::findings::table::flexible;
use crate::ground::stats::largest;
use crate::signal::outliers::robust_std;
use crate::signal::swing::{shapes, taken};
use std::f64::consts::TAU;
use std::ops::Range;

pub(super) const KIND: Kind = Kind {
    name: "ringing",
    summary: "an oscillation that dies away after every corner of the load",
    seek,
};

/// Shares of critical damping that are tried: more hardly swings back.
const DAMPINGS: [f64; 4] = [0.03, 0.06, 0.12, 0.2];
/// Time constants of the swing that pass from one corner to the next: what rings on may be a line of the mains.
const DIES: f64 = 2.0;
/// Rows of the shortest period, and periods of the longest that fit between two corners.
const PERIODS: (f64, f64) = (2.5, 3.0);
/// Shapes that are kept of all, of either kind.
const KEPT: usize = 4;
/// Most corners whose swings are each of their own size.
const MOST: usize = 24;
/// Rows from one push to the next that are one corner.
const SAME: usize = 3;
/// Robust deviations of the changes of slope, and share of the largest, from which one is a corner.
const CORNER: (f64, f64) = (8.0, 0.1);
/// Rows of which one at most may be a corner: where more are, the load is rough.
const ROWS_EACH: usize = 10;

/// Period (share of the record) and damping of a swing.
type Shape = (f64, f64);
/// Both phases of a swing, by rows.
type Phases = [Vec<f64>; 2];

fn seek(seen: &Seen) -> Sought {
    let pushes = pushes(seen.view);
    let corners = corners(&pushes);
    let (least, most) = (1.0 / seen.view.rows() as f64, 1.0 / corners.len() as f64);
    let mut shapes = match corners.is_empty() {
        true => Vec::new(),
        false => shapes(PERIODS.0 * least, most / PERIODS.1, &DAMPINGS),
    };
    shapes.retain(|(period, damping)| damping * TAU * most / period > DIES);
    let ends = |from: usize| corners.get(from + 1).copied().unwrap_or(seen.left.len());
    let pieces: Vec<Range<usize>> = (0..corners.len()).map(|k| corners[k]..ends(k)).collect();
    shapes.retain(|(period, _)| dies(seen, &pieces, *period));
    let whole = |shape: Shape| swing(seen.view, &pushes, &[], shape);
    let anew = |shape: Shape| swing(seen.view, &pushes, &corners, shape);
    let as_pushed = best(&shapes, |shape| {
        size(&whole(shape), 0..seen.left.len(), &seen.left)
    });
    let each = |shape| {
        let phases = anew(shape);
        let sizes = pieces.iter().map(|p| size(&phases, p.clone(), &seen.left));
        sizes.sum()
    };
    let as_it_happens = match pieces.len() <= MOST {
        true => best(&shapes, each),
        false => Vec::new(),
    };
    let columns = as_pushed.into_iter().map(|shape| whole(shape).to_vec());
    let columns = columns.chain(
        as_it_happens
            .into_iter()
            .map(|shape| cut(&anew(shape), &pieces)),
    );
    Sought {
        members: columns.flat_map(flexible).collect(),
        searched: (shapes.len().max(1) as f64 / KEPT as f64).max(1.0).ln(),
    }
}

/// Times that there must be more of a swing in the first third of the pieces than in the last: a line of the mains is in both.
const MORE: f64 = 2.0;

/// Whether what swings with a period is there after the corners rather than before the next ones.
fn dies(seen: &Seen, pieces: &[Range<usize>], period: f64) -> bool {
    let of = |third: usize| -> f64 {
        let part = |piece: &Range<usize>| {
            let wide = piece.len() / 3;
            let rows = piece.start + third * wide..piece.start + (third + 1) * wide;
            let phase = |f: fn(f64) -> f64| -> Vec<f64> {
                let each = seen.view.t[rows.clone()].iter();
                each.map(|t| f(TAU * t / period)).collect()
            };
            taken(
                [&phase(f64::cos), &phase(f64::sin)],
                &seen.left[rows.clone()],
            )
        };
        pieces.iter().map(part).sum()
    };
    of(0) > MORE * of(2)
}

/// The shapes of the largest size.
fn best(shapes: &[Shape], size: impl Fn(Shape) -> f64) -> Vec<Shape> {
    let mut each: Vec<(f64, Shape)> = shapes.iter().map(|s| (size(*s), *s)).collect();
    each.sort_by(|a, b| b.0.total_cmp(&a.0));
    each.truncate(KEPT);
    each.into_iter().map(|(_, shape)| shape).collect()
}

/// Squares that a swing takes of what is left in some rows.
fn size([a, b]: &Phases, rows: Range<usize>, left: &[f64]) -> f64 {
    taken([&a[rows.clone()], &b[rows.clone()]], &left[rows])
}

/// A swing as columns of its own in every piece.
fn cut(phases: &Phases, pieces: &[Range<usize>]) -> Vec<Vec<f64>> {
    let inside = |phase: &[f64], piece: &Range<usize>| {
        let mut own = vec![0.0; phase.len()];
        own[piece.clone()].copy_from_slice(&phase[piece.clone()]);
        own
    };
    let each = pieces.iter();
    each.flat_map(|piece| phases.each_ref().map(|phase| inside(phase, piece)))
        .collect()
}

/// The rows at which something pushes first: a corner may take several.
fn corners(pushes: &[f64]) -> Vec<usize> {
    let mut all: Vec<usize> = Vec::new();
    let mut last = 0;
    for (i, _) in pushes.iter().enumerate().filter(|(_, p)| **p != 0.0) {
        if all.is_empty() || i > last + SAME {
            all.push(i);
        }
        last = i;
    }
    all
}

/// What pushes at every row: the change of slope at a corner, the change of a load that jumps; none where the load has no
/// corners or nothing but corners.
fn pushes(view: &View) -> Vec<f64> {
    let n = view.rows();
    let change = |i: usize| view.u[i] - view.u[i - 1];
    let slope = |i: usize| change(i) / (view.t[i] - view.t[i - 1]).max(f64::MIN_POSITIVE);
    let push = |i: usize| match view.stepped {
        _ if i == 0 => 0.0,
        true => change(i),
        false if i + 1 < n => slope(i + 1) - slope(i),
        false => 0.0,
    };
    let mut own: Vec<f64> = (0..n).map(push).collect();
    let most = largest(&own);
    let limit = (CORNER.0 * robust_std(&own)).max(CORNER.1 * most);
    own.iter_mut()
        .filter(|p| p.abs() <= limit)
        .for_each(|p| *p = 0.0);
    let count = own.iter().filter(|p| **p != 0.0).count();
    match count * ROWS_EACH > n {
        true => Vec::new(),
        false => own,
    }
}

/// The two phases of a swing of this period (share of the record) and damping; at the rows of `anew` it begins anew.
fn swing(view: &View, pushes: &[f64], anew: &[usize], (period, damping): Shape) -> Phases {
    let omega = TAU / period;
    let (mut re, mut im) = (0.0_f64, 0.0_f64);
    let (mut step, mut turn) = (f64::NAN, (0.0, 0.0));
    let mut out = [vec![0.0; view.rows()], vec![0.0; view.rows()]];
    for i in 1..view.rows() {
        let dt = view.t[i] - view.t[i - 1];
        if (dt - step).abs() > 1e-9 * dt || step.is_nan() {
            let keep = (-damping * omega * dt).exp();
            turn = (keep * (omega * dt).cos(), keep * (omega * dt).sin());
            step = dt;
        }
        (re, im) = (re * turn.0 - im * turn.1, re * turn.1 + im * turn.0);
        match anew.binary_search(&i) {
            Ok(_) => (re, im) = (1.0, 0.0),
            Err(_) if anew.is_empty() => re += pushes[i],
            Err(_) => {}
        }
        (out[0][i], out[1][i]) = (re, im);
    }
    out
}
