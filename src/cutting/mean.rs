//! Mean forces in closed form for a chip c sin φ (Altintas 2000, eqs. 2.21 to 2.24): the textbook check
//! beside every fit of wave forms.

use super::wave::{Basis, Cut, Side};
use std::f64::consts::{PI, TAU};

/// Tooth angles at which a tooth enters and leaves, rad.
pub fn engagement(cut: &Cut, radius_m: f64) -> [f64; 2] {
    let reach = (1.0 - cut.width_m / radius_m).clamp(-1.0, 1.0).acos();
    match cut.side {
        Side::Slot => [0.0, PI],
        Side::Up => [0.0, reach],
        Side::Down => [PI - reach, PI],
    }
}

/// The sums of the linear law, averaged over a revolution of a square end.
pub fn mean_basis(cut: &Cut, radius_m: f64, teeth: usize) -> Basis<f64> {
    let [from, to] = engagement(cut, radius_m);
    let over = |f: fn(f64) -> f64| f(to) - f(from);
    let squares = over(|p| 0.5 * p - 0.25 * (2.0 * p).sin());
    let products = over(|p| -0.25 * (2.0 * p).cos());
    let (sines, cosines) = (over(|p| -p.cos()), over(f64::sin));
    let edge = teeth as f64 * cut.depth_m / TAU;
    let area = edge * cut.feed_per_tooth(teeth);
    [
        [-area * products, area * squares, 0.0],
        [-area * squares, -area * products, 0.0],
        [0.0, 0.0, area * sines],
        [-edge * cosines, edge * sines, 0.0],
        [-edge * sines, -edge * cosines, 0.0],
        [0.0, 0.0, edge * (to - from)],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutting::wave::force;

    #[test]
    fn the_published_slot() {
        let cut = Cut {
            spindle_rad_s: TAU * 100.0,
            feed_m_s: 0.1e-3 * 2.0 * 100.0,
            depth_m: 2e-3,
            width_m: 16e-3,
            side: Side::Slot,
        };
        let k = crate::cutting::Material::linear_edge([
            951.365, 262.597, 323.33, 11.115, 11.314, 1.105,
        ]);
        let mean = force(&mean_basis(&cut, 8e-3, 2), &k.coefficients);
        for (m, expected) in mean.iter().zip([-40.6651, 109.2886, 43.3777]) {
            assert!((m - expected).abs() < 1e-4, "{mean:?}");
        }
    }
}
