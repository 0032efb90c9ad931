//! Is anything left? Tests of the whitened residual against structure that no cause explained.

use crate::fit::observation::Observation;
use crate::fit::screen::{Screen, directions};
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

/// The tests for what repeats with the load.
pub const REPEATS: [&str; 2] = ["lack of fit", "pattern over load"];

/// One test: its name, p-value, and the sum of squares beyond chance that it points at.
struct Test {
    name: &'static str,
    p_value: f64,
    left: f64,
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
    let mut in_time = residual.to_vec();
    data.cosine.restore(&mut in_time);
    let tests = [
        lack_of_fit(chi2, dimension, screen),
        line(residual),
        scan("burst in time", &in_time),
        scan(REPEATS[1], &by_load(&in_time, data)),
    ];
    let explained = (base - residual.len() as f64).max(1.0);
    let left = tests
        .iter()
        .filter(|t| t.p_value < 0.01)
        .map(|t| t.left)
        .fold(0.0, f64::max);
    let strongest = tests.iter().min_by(|a, b| a.p_value.total_cmp(&b.p_value));
    Adequacy {
        p_value: strongest.map_or(1.0, |t| (tests.len() as f64 * t.p_value).min(1.0)),
        unexplained: (left / explained).clamp(0.0, 1.0),
        test: strongest.map_or("", |t| t.name),
    }
}

fn tail(sum: f64, freedom: f64) -> f64 {
    ChiSquared::new(freedom).map_or(1.0, |d| d.sf(sum))
}

/// p-value of the best of `tries` attempts.
fn of_many(p: f64, tries: f64) -> f64 {
    -(tries * (-p.min(1.0 - 1e-16)).ln_1p()).exp_m1()
}

/// The level of the noise inside the span is inferred from outside it: its square may be this much
/// higher there.
const LEVEL: f64 = 1.15;

/// Chi-square of what the saturated span still finds; and its size beyond chance.
fn lack_of_fit(chi2: f64, dimension: usize, screen: &Screen) -> Test {
    let freedom = screen.dimension.saturating_sub(dimension + 1).max(1) as f64;
    let excess = (chi2 - screen.saturated).max(0.0);
    Test {
        name: REPEATS[0],
        p_value: tail(excess / LEVEL, freedom),
        left: (excess - freedom).max(0.0),
    }
}

/// Largest sum over a short window of whitened cosine coefficients: a tone in the record.
fn line(residual: &[f64]) -> Test {
    const WIDTH: usize = 3;
    let energy = |w: &[f64]| w.iter().map(|r| r * r).sum::<f64>();
    let largest = residual.windows(WIDTH).map(energy).fold(0.0, f64::max);
    let tries = residual.len() as f64;
    Test {
        name: "periodic line",
        p_value: of_many(tail(largest, WIDTH as f64), tries),
        left: (largest - 2.0 * tries.ln()).max(0.0),
    }
}

/// Shares of the record that the windows of a scan span.
const SPANS: [f64; 4] = [0.01, 0.03, 0.08, 0.2];

/// A whitened reading counts at most so much in a scan: one wild reading alone is no structure.
const WILDEST: f64 = 5.0;

/// Scan of an ordered white sequence at several widths: windows whose mean, or whose energy, is too
/// large.
fn scan(name: &'static str, sequence: &[f64]) -> Test {
    let n = sequence.len();
    let held = |v: f64| v.clamp(-WILDEST, WILDEST);
    let sums = running(sequence, held);
    let squares = running(sequence, |v| held(v).powi(2));
    let mut best = Test {
        name,
        p_value: 1.0,
        left: 0.0,
    };
    let mut tries = 0.0;
    for span in SPANS {
        let width = ((span * n as f64) as usize).max(4);
        if width >= n {
            continue;
        }
        tries += 4.0 * (n / width) as f64;
        for i in 0..n - width {
            let w = width as f64;
            let (sum, energy) = (sums[i + width] - sums[i], squares[i + width] - squares[i]);
            let shift = sum * sum / w;
            for (value, freedom) in [(shift, 1.0), (energy, w)] {
                // the tail is costly: look only where it can matter
                if value > freedom + 5.0 * (2.0 * freedom).sqrt() {
                    let p = tail(value, freedom);
                    if p < best.p_value {
                        best = Test {
                            name,
                            p_value: p,
                            left: value - freedom,
                        };
                    }
                }
            }
        }
    }
    best.p_value = of_many(best.p_value, tries.max(1.0));
    best
}

fn running(sequence: &[f64], f: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut sums = vec![0.0];
    sums.extend(sequence.iter().map(|v| {
        sum += f(*v);
        sum
    }));
    sums
}

/// The residual ordered by branch, then by load: what repeats in every cycle comes together.
fn by_load(in_time: &[f64], data: &Observation) -> Vec<f64> {
    let u: Vec<f64> = data
        .scene
        .load
        .iter()
        .map(|m| m / data.scene.load_scale)
        .collect();
    let direction = directions(&u);
    let mut order: Vec<usize> = (0..in_time.len()).collect();
    order.sort_by(|a, b| {
        (direction[*a], u[*a])
            .partial_cmp(&(direction[*b], u[*b]))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    order.into_iter().map(|i| in_time[i]).collect()
}
