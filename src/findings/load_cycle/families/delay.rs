//! A reading that is late: a dead time, a clock that runs away, a short low pass.

use super::{Family, Shapes, View};

/// Late, or early, by a time that may grow.
pub const TIME_SKEW: Family = Family {
    cause: "time_skew",
    mechanism: "delay",
    suits: |view| !view.stepped,
    members: skew,
};

fn skew(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    let delays = [0.003, 0.006, 0.01, 0.016, 0.024, 0.036].map(|d| d * view.period);
    for d in delays {
        shapes.positive(view, &view.delayed(|_| d));
        shapes.positive(view, &view.delayed(|_| -d));
        let late: Vec<f64> = view
            .lagged(d)
            .iter()
            .zip(&view.u)
            .map(|(a, u)| a - u)
            .collect();
        shapes.positive(view, &late);
    }
    let small = delays[2];
    shapes.one(view, &view.delayed(|t| small * t));
    let all = delays.map(|d| view.delayed(|_| d));
    shapes.density(view, &all, &[1.0; 6], (0.7, true));
    shapes
}
