//! Structure of any kind: smooth or local patterns over load, over each branch, over the way, over time,
//! over the place in the cycle, and powers of the rate, falling with their order. What shows that something is left, whoever made it.

use super::families::View;
use crate::ground::stats::rms;
use std::f64::consts::PI;

/// Orders over load, over load on either branch, over the way of the load, over time, over time for what
/// grows with the load, and over the place in the cycle (twice: cosines and sines).
const ORDERS: [usize; 6] = [40, 14, 80, 20, 6, 20];
/// Rows that one column needs.
const ROWS_EACH: f64 = 4.0;

/// Rows that a column over the load needs.
const ROWS_OF_LOAD: usize = 6;
/// The same while the noise is chosen: enough to tell structure from colour.
const COARSE: [usize; 6] = [24, 8, 32, 12, 4, 12];

/// The columns, one unit rms at order one.
pub fn span(view: &View) -> Vec<Vec<f64>> {
    waves_of(view, ORDERS)
}

/// Fewer of them.
pub fn coarse_span(view: &View) -> Vec<Vec<f64>> {
    waves_of(view, COARSE)
}

fn waves_of(view: &View, orders: [usize; 6]) -> Vec<Vec<f64>> {
    let total: usize = orders.iter().sum::<usize>() + orders[1] + orders[5];
    let share = (view.rows() as f64 / ROWS_EACH / total as f64).min(1.0);
    // a ripple over the load repeats: it can be seen in fewer rows
    let most = |k: usize| match k {
        0 => (view.rows() / ROWS_OF_LOAD).min(orders[0]),
        _ => (share * orders[k] as f64).ceil() as usize,
    };
    let place = |u: &f64| 0.5 * (1.0 + u.clamp(-1.0, 1.0));
    let load: Vec<f64> = view.u.iter().map(place).collect();
    let up = rising(&view.u);
    let mut all = Vec::new();
    let mut waves = |x: &[f64], times: &dyn Fn(usize) -> f64, orders: usize| {
        for k in 1..=orders {
            let wave = |(i, x): (usize, &f64)| {
                (2.0 / k as f64).sqrt() * (PI * k as f64 * x).cos() * times(i)
            };
            all.push(x.iter().enumerate().map(wave).collect::<Vec<f64>>());
        }
    };
    waves(&load, &|_| 1.0, most(0));
    waves(&load, &|i| f64::from(u8::from(up[i])), most(1));
    waves(&load, &|i| f64::from(u8::from(!up[i])), most(1));
    waves(&way(&view.u), &|_| 1.0, most(2));
    waves(&view.t, &|_| 1.0, most(3));
    waves(&view.t, &|i| view.u[i], most(4));
    let phase = phase(view);
    waves(&phase, &|_| 1.0, most(5));
    for k in 1..=most(5) {
        let sine = |x: &f64| (2.0 / k as f64).sqrt() * (PI * k as f64 * x).sin();
        all.push(phase.iter().map(sine).collect());
    }
    all.extend(rates(view));
    all
}

/// Place in the cycle: half cycles so far, and the share in time of the present one.
fn phase(view: &View) -> Vec<f64> {
    let bounds = |h: usize| {
        let first = view.half_cycle.partition_point(|k| *k < h);
        let last = view
            .half_cycle
            .partition_point(|k| *k <= h)
            .min(view.rows() - 1);
        (view.t[first], view.t[last])
    };
    let at = |i: usize| {
        let half = view.half_cycle[i];
        let (from, to) = bounds(half);
        half as f64 + (view.t[i] - from) / (to - from).max(f64::MIN_POSITIVE)
    };
    (0..view.rows()).map(at).collect()
}

/// Farthest rate that is believed, of the usual one.
const FASTEST: f64 = 4.0;

/// Powers of the rate of the load, rms one; none where the load jumps.
fn rates(view: &View) -> Vec<Vec<f64>> {
    let last = view.rows().saturating_sub(1);
    let rate = |i: usize| {
        let (a, b) = (i.saturating_sub(2), (i + 2).min(last));
        (view.u[b] - view.u[a]) / (view.t[b] - view.t[a]).max(f64::MIN_POSITIVE)
    };
    let rate: Vec<f64> = (0..view.rows()).map(rate).collect();
    let usual = rms(&rate);
    if view.stepped || usual <= 0.0 {
        return Vec::new();
    }
    let powers: [fn(f64) -> f64; 4] = [f64::abs, |r| r * r, |r| r * r.abs(), |r| r * r * r];
    let column = |f: fn(f64) -> f64| {
        let own = rate.iter().map(|r| f((r / usual).clamp(-FASTEST, FASTEST)));
        let own: Vec<f64> = own.collect();
        let size = rms(&own).max(f64::MIN_POSITIVE);
        own.iter().map(|v| v / size).collect()
    };
    powers.into_iter().map(column).collect()
}

fn rising(u: &[f64]) -> Vec<bool> {
    crate::fit::screen::directions(u)
        .iter()
        .map(|d| *d > 0.0)
        .collect()
}

/// Way of the load so far, 0 to 1.
fn way(u: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut ways = vec![0.0];
    for w in u.windows(2) {
        sum += (w[1] - w[0]).abs();
        ways.push(sum);
    }
    ways.iter()
        .map(|w| w / sum.max(f64::MIN_POSITIVE))
        .collect()
}
