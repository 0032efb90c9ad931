//! A reading that is late: a dead time, a clock that runs away, a short low pass.

use super::shape::Sign;
use super::{Family, Shapes, View};

/// Late, or early, by a time that may grow.
pub const TIME_SKEW: Family = Family {
    cause: "time_skew",
    mechanism: "delay",
    suits: |view| !view.stepped || SHORTEST * view.row < LONGEST * view.period,
    members: skew,
};

/// Longest delay that is tried, periods.
const LONGEST: f64 = 0.06;
/// Delay of a clock that runs away, at the end of the record, periods.
const SMALL: f64 = 0.01;
/// Rows from which a delay shows under a load that jumps: when between two rows it jumped nobody knows.
const SHORTEST: f64 = 2.0;

fn skew(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    let shows = |d: &f64| !view.stepped || *d > SHORTEST * view.row;
    let delays = [0.003, 0.006, 0.01, 0.016, 0.024, 0.036, LONGEST].map(|d| d * view.period);
    let delays: Vec<f64> = delays.into_iter().filter(shows).collect();
    for d in &delays {
        shapes.positive(view, &view.delayed(|_| *d));
        shapes.positive(view, &view.delayed(|_| -d));
        let late: Vec<f64> = view
            .lagged(*d)
            .iter()
            .zip(&view.u)
            .map(|(a, u)| a - u)
            .collect();
        shapes.positive(view, &late);
    }
    let small = SMALL * view.period;
    if shows(&small) {
        shapes.one(view, &view.delayed(|t| small * t));
    }
    let all: Vec<Vec<f64>> = delays.iter().map(|d| view.delayed(|_| *d)).collect();
    if all.len() > 1 {
        shapes.density(view, &all, &vec![1.0; all.len()], (0.7, Sign::Positive));
    }
    shapes
}
