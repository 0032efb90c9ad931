//! Structure of any kind: smooth or local patterns over load, over each branch, over the way and over
//! time, falling with their order. What shows that something is left, whoever made it.

use super::families::View;
use std::f64::consts::PI;

/// Orders over load, over load on either branch, over the way of the load, over time, and over time
/// for what grows with the load.
const ORDERS: [usize; 5] = [40, 14, 90, 20, 6];
/// Rows that one column needs.
const ROWS_EACH: f64 = 4.0;

/// Rows that a column over the load needs.
const ROWS_OF_LOAD: usize = 6;
/// The same while the noise is chosen: enough to tell structure from colour.
const COARSE: [usize; 5] = [24, 8, 40, 12, 0];

/// The columns, one unit rms at order one.
pub fn span(view: &View) -> Vec<Vec<f64>> {
    waves_of(view, ORDERS)
}

/// Fewer of them.
pub fn coarse_span(view: &View) -> Vec<Vec<f64>> {
    waves_of(view, COARSE)
}

fn waves_of(view: &View, orders: [usize; 5]) -> Vec<Vec<f64>> {
    let total: usize = orders.iter().sum::<usize>() + orders[1];
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
    all
}

fn rising(u: &[f64]) -> Vec<bool> {
    ident::fit::screen::directions(u)
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
