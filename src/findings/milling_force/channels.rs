//! Patterns of channels that do not pass a force as it is: bent, or with a charge that leaks away.

use super::Case;
use super::patterns::SEEN;
use super::sought::Sought;
use crate::findings::engine::Member;
use crate::findings::table;
use crate::ground::spatial::{add, scale};
use crate::inference::gaussian::Size;

/// Times in which all but 1/e of a charge leaks away, s: those of amplifiers, short and long. A choice; no others were tried.
const LEAKS: [f64; 9] = [0.03, 0.06, 0.12, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Steps of the record from which samples are some that were left out between.
const GAP: f64 = 3.0;

/// Factors by which such a time is brought closer: what the next one leaves was told as a drift.
const CLOSER: [f64; 4] = [1.4, 1.2, 1.1, 1.05];

/// What has leaked of the charge of all channels alike, in the time that suits best. With amounts of their own for every channel, and for
/// what each cut began with, it was told in the place of a drift beside a gain (a file by strangers).
pub(super) fn leaks(case: &Case) -> Vec<Member> {
    let nearer = CLOSER.map(|by| move |time: f64| [time * by, time / by]);
    let columns = |time| leaked(case, time);
    let found = Sought::of(case, LEAKS.into_iter(), columns, (SEEN, &nearer));
    found.map_or(Vec::new(), |f| table::flexible(f.columns))
}

/// What is forgotten of a force that began with the file, and by channel of what was there before.
fn leaked(case: &Case, constant: f64) -> Vec<Vec<f64>> {
    let first = case.cuts()[0].time[0];
    let (mut forgotten, mut at, mut before) = (Vec::new(), [0.0; 3], first);
    for (c, cut) in case.cuts().iter().enumerate() {
        let steps = cut.time.windows(2).map(|w| w[1] - w[0]);
        let step = steps.fold(f64::INFINITY, f64::min);
        let sum = (0..cut.time.len()).fold([0.0; 3], |sum, i| add(sum, case.simulated(c, i)));
        let mean = scale((cut.time.len() as f64).recip(), sum);
        for (i, t) in cut.time.iter().enumerate() {
            let kept = ((before - t) / constant).exp();
            // between cuts nothing presses; over what was left out of one, its mean
            let force = match i {
                0 => [0.0; 3],
                _ if t - before > GAP * step => mean,
                _ => case.simulated(c, i),
            };
            for (own, force) in at.iter_mut().zip(force) {
                *own = kept * *own + (1.0 - kept) * force;
            }
            forgotten.push(at);
            before = *t;
        }
    }
    let all = case.column(|c, i, k| forgotten[case.cuts()[c].first + i][k]);
    let force = case.force_rms();
    let begun = |axis: usize| {
        case.column(|c, i, k| match k == axis {
            true => force * ((first - case.cuts()[c].time[i]) / constant).exp(),
            false => 0.0,
        })
    };
    std::iter::once(all).chain((0..3).map(begun)).collect()
}

/// Shares of its largest force from which a channel may show less.
const LIMITS: [f64; 3] = [0.5, 0.7, 0.85];

/// One channel, or all, over the square of the force, its square with sign, and what lies beyond a limit.
pub(super) fn bends(case: &Case) -> Vec<Member> {
    let axes: [&[usize]; 4] = [&[0], &[1], &[2], &[0, 1, 2]];
    axes.iter().map(|own| bend(case, own)).collect()
}

fn bend(case: &Case, axes: &[usize]) -> Member {
    let all = case.forces();
    let own = all
        .iter()
        .enumerate()
        .filter(|(row, _)| axes.contains(&(row % 3)));
    let most = own.fold(f64::MIN_POSITIVE, |m, (_, f)| m.max(f.abs()));
    let column = |of: &dyn Fn(f64) -> f64| {
        case.column(|c, i, k| match axes.contains(&k) {
            true => most * of(case.simulated(c, i)[k] / most),
            false => 0.0,
        })
    };
    let beyond = |limit: f64| move |x: f64| (x.abs() - limit).max(0.0) * x.signum();
    let mut columns = vec![column(&|x| x * x), column(&|x| x * x.abs())];
    columns.extend(LIMITS.map(|limit| column(&beyond(limit))));
    Member {
        columns,
        size: Size::Free,
        shape: vec![axes.len() as f64],
        ..Member::free(Vec::new())
    }
}
