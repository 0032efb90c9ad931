//! Stiffness that changes in the course of the record.

use super::shape::{Sign, even};
use super::{Family, Shapes, View};

/// Compliance times a function of time.
pub const LOOSENING: Family = Family {
    cause: "loosening",
    mechanism: "stiffness over time",
    suits: |view| view.half_cycle.last().is_some_and(|h| *h >= 2),
    members: loosening,
};

/// Most half cycles that have a compliance of their own.
const STEPS: usize = 12;

fn loosening(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    let grown = |f: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..view.rows()).map(|i| view.u[i] * f(i)).collect()
    };
    let t = |i: usize| view.t[i];
    let work = work(view);
    for p in [0.4, 0.7, 1.0, 1.5, 2.5] {
        shapes.one(view, &grown(&|i| work[i].powf(p)));
    }
    shapes.one(view, &grown(&t));
    for tau in [0.1, 0.25, 0.6] {
        shapes.one(view, &grown(&|i| 1.0 - (-t(i) / tau).exp()));
    }
    for at in even(0.04, 0.96, 48) {
        shapes.one(view, &grown(&|i| f64::from(u8::from(t(i) >= at))));
    }
    for at in &view.jumps.rows {
        shapes.one(view, &grown(&|i| f64::from(u8::from(i >= *at))));
    }
    let count = |i: usize| view.half_cycle[i] as f64;
    shapes.one(view, &grown(&count));
    shapes.one(view, &grown(&|i| (1.0 + count(i)).ln()));
    // what gives way from stroke to stroke, or from cycle to cycle, is another where the load is nought
    let strokes = if view.two_sided { 2 } else { 1 };
    let cycle = |i: usize| (view.stroke[i] / strokes) as f64;
    if view.two_sided {
        shapes.one(view, &grown(&|i| view.stroke[i] as f64));
    }
    shapes.one(view, &grown(&cycle));
    shapes.one(view, &grown(&|i| (1.0 + cycle(i)).ln()));
    let hats: Vec<Vec<f64>> = even(0.0, 0.85, 6)
        .iter()
        .map(|from| grown(&|i| ((t(i) - from) / 0.17).clamp(0.0, 1.0)))
        .collect();
    shapes.density(view, &hats, &[1.0; 6], (0.8, Sign::Any));
    let last = view.half_cycle.last().copied().unwrap_or(0).min(STEPS);
    let steps: Vec<Vec<f64>> = (1..=last)
        .map(|k| grown(&|i| f64::from(u8::from(view.half_cycle[i] >= k))))
        .collect();
    if steps.len() > 1 {
        shapes.density(view, &steps, &vec![1.0; steps.len()], (0.8, Sign::Any));
    }
    shapes
}

/// Way of the load so far over the whole, 0 to 1.
fn work(view: &View) -> Vec<f64> {
    let mut sum = 0.0;
    let mut ways = vec![0.0];
    for w in view.u.windows(2) {
        sum += (w[1] - w[0]).abs();
        ways.push(sum);
    }
    ways.iter()
        .map(|w| w / sum.max(f64::MIN_POSITIVE))
        .collect()
}
