//! A load without the noise of its cell.

use crate::effects::Scene;
use crate::signal::denoised::Denoised;
use crate::signal::outliers;

/// Ratio of the load's noise to the reading's below which it is negligible.
const QUIET: f64 = 0.3;

/// Takes the load cell's noise off the load, where it is not negligible beside the reading's: laws answer to the load
/// that was there, and a filter of the noise in it would explain the noise that it leaves in the misfit (errors in
/// variables, Fuller 1987). Where what the smooth load still holds of it is not negligible either, the readings take
/// that noise over: then the misfit scatters as the channels do, and no smooth function of the load explains it.
pub fn quieten(scene: &mut Scene, reading: &mut [f64]) {
    let k = scene.load_scale / scene.deflection_scale;
    let quick = Quick::of(&scene.load, reading, k);
    if quick.ratio < QUIET * QUIET {
        return;
    }
    let quiet = Denoised::of(&scene.time, &scene.load);
    let exact = quiet.left * quiet.left * quick.ratio < QUIET * QUIET;
    let taken = if exact { quick.followed } else { 1.0 };
    let each = reading.iter_mut().zip(&scene.load).zip(&quiet.values);
    each.for_each(|((y, read), smooth)| *y -= taken * (read - smooth) / k);
    scene.load = quiet.values;
}

/// Noises of load and reading in fourth differences, deflections: load l = s + m, reading y = s/k + e, so that
/// cov(l, y) = var(s)/k tells the noises m and e from what moves both.
struct Quick {
    /// Variance of m/k over that of e.
    ratio: f64,
    /// Share of the load's quick changes that the reading follows.
    followed: f64,
}

impl Quick {
    fn of(load: &[f64], reading: &[f64], k: f64) -> Self {
        let fourth = |w: &[f64]| w[0] - 4.0 * w[1] + 6.0 * w[2] - 4.0 * w[3] + w[4];
        let l: Vec<f64> = load.windows(5).map(|w| fourth(w) / k).collect();
        let y: Vec<f64> = reading.windows(5).map(fourth).collect();
        let limit = |v: &[f64]| 4.0 * outliers::robust_std(v);
        let (ll, ly) = (limit(&l), limit(&y));
        let calm = l.iter().zip(&y);
        let calm = calm.filter(|(a, b)| a.abs() <= ll && b.abs() <= ly);
        let (mut vl, mut vy, mut both) = (0.0, 0.0, 0.0);
        for (a, b) in calm {
            vl += a * a;
            vy += b * b;
            both += a * b;
        }
        let least = f64::MIN_POSITIVE;
        Self {
            ratio: (vl - both).max(0.0) / (vy - both).max(least),
            followed: (both / vl.max(least)).clamp(0.0, 1.0),
        }
    }
}
