//! Is anything left? Tests of the whitened residual against structure that no cause explained.

use crate::fit::observation::Observation;
use crate::fit::screen::Screen;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// What the tests of a residual say.
#[derive(Debug, Clone)]
pub struct Adequacy {
    /// Smallest p-value of the tests, corrected for their number.
    pub p_value: f64,
    /// Share of the base model's excess misfit that is still unexplained.
    pub unexplained: f64,
    /// Which test spoke.
    pub test: &'static str,
}

/// Judges a whitened residual in cosine order. `base` is the whitened sum of squares of the spring
/// alone, `dimension` the number of parameters fitted.
pub fn judge(
    residual: &[f64],
    dimension: usize,
    base: f64,
    screen: &Screen,
    data: &Observation,
) -> Adequacy {
    let chi2: f64 = residual.iter().map(|r| r * r).sum();
    let lack = lack_of_fit(chi2, dimension, screen);
    let line = largest_line(residual, data);
    let (p_value, test) = if lack.0 < line.0 {
        (lack.0, "lack of fit")
    } else {
        (line.0, "periodic line")
    };
    let left = lack.1.max(line.1);
    let explained = (base - residual.len() as f64).max(1.0);
    Adequacy {
        p_value: (2.0 * p_value).min(1.0),
        unexplained: (left / explained).clamp(0.0, 1.0),
        test,
    }
}

/// Chi-square of what the saturated span still finds; and its size beyond chance.
fn lack_of_fit(chi2: f64, dimension: usize, screen: &Screen) -> (f64, f64) {
    let freedom = screen.dimension.saturating_sub(dimension + 1).max(1) as f64;
    let excess = (chi2 - screen.saturated).max(0.0);
    let p = ChiSquared::new(freedom).map_or(1.0, |d| d.sf(excess));
    (p, (excess - freedom).max(0.0))
}

/// Largest sum over a short window of whitened cosine coefficients: a tone in the record.
fn largest_line(residual: &[f64], _data: &Observation) -> (f64, f64) {
    const WIDTH: usize = 3;
    if residual.len() < 4 * WIDTH {
        return (1.0, 0.0);
    }
    let largest = residual
        .windows(WIDTH)
        .map(|w| w.iter().map(|r| r * r).sum::<f64>())
        .fold(0.0, f64::max);
    let single = ChiSquared::new(WIDTH as f64).map_or(1.0, |d| d.sf(largest));
    let tries = residual.len() as f64;
    (
        1.0 - (1.0 - single.min(1.0)).powf(tries),
        (largest - 2.0 * tries.ln()).max(0.0),
    )
}
