//! Cubic spring (Duffing, 1918): tau = k d + k3 d^3, solved for d.

use super::super::line::{Line, bisect, peak};

/// Strongest ratio k3 d^2 / k at the plain spring's full deflection that stays believable; softening
/// must keep a rising curve.
pub fn strongest(hardening: bool) -> f64 {
    if hardening { 0.8 } else { -0.12 }
}

/// Solves w + r w^3 = u by Newton from the plain spring.
fn deflection(u: f64, ratio: f64) -> f64 {
    let mut w = u;
    for _ in 0..30 {
        let step = (w + ratio * w.powi(3) - u) / (1.0 + 3.0 * ratio * w * w);
        w -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    w
}

/// Deflection beyond the plain spring's.
pub fn response(load: &[f64], ratio: f64) -> Vec<f64> {
    load.iter().map(|&u| deflection(u, ratio) - u).collect()
}

/// Peak beyond the best straight line.
pub fn size(load: &[f64], ratio: f64) -> f64 {
    peak(&response(load, ratio), load, Line::Full)
}

/// The ratio that gives the wanted peak.
pub fn ratio_for(load: &[f64], hardening: bool, wanted: f64) -> f64 {
    let end = strongest(hardening);
    end * bisect(0.0, 1.0, wanted, |share| size(load, end * share))
}
