//! Linear memory: creep with one relaxation time or a spectrum of them.

use super::shape::{Sign, geometric};
use super::{Family, Shapes, View};

/// Deflection that follows late, with any spectrum of times.
pub const CREEP: Family = Family {
    cause: "creep",
    mechanism: "linear memory",
    suits: |view| !view.stepped || view.rows() > 30,
    members: creep,
};

fn creep(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    // below a few rows a lag is a delay
    let least = (3.0 / view.rows() as f64).max(0.03 * view.period);
    let taus = geometric(least, (3.0 * view.period).max(2.0 * least), 9);
    let lags: Vec<Vec<f64>> = taus.iter().map(|tau| view.lagged(*tau)).collect();
    lags.iter().for_each(|lag| shapes.positive(view, lag));
    let n = taus.len();
    let power = |p: f64| {
        taus.iter()
            .map(|t| (t / taus[0]).powf(p))
            .collect::<Vec<f64>>()
    };
    let mut spectra = vec![vec![1.0; n], power(0.3), power(0.7)];
    for spectrum in &mut spectra {
        shapes.density(view, &lags, spectrum, (0.7, Sign::Loses));
        if view.loaded_start {
            past(view, &lags, &taus, spectrum, &mut shapes);
        }
    }
    shapes
}

/// A record that starts under load has a past: terms that decay whatever the load does.
fn past(view: &View, lags: &[Vec<f64>], taus: &[f64], mean: &[f64], shapes: &mut Shapes) {
    let decays = taus.iter().map(|tau| view.over_time(|t| (-t / tau).exp()));
    let all: Vec<Vec<f64>> = lags.iter().cloned().chain(decays).collect();
    let mean: Vec<f64> = mean.iter().chain(mean).copied().collect();
    shapes.density(view, &all, &mean, (1.0, Sign::Any));
}
