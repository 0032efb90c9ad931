//! Memory that knows no rate: contacts that slip, one or many. With the spring beside it a play operator
//! and a contact that holds (a stop) span the same curves.

use super::shape::{Sign, geometric};
use super::{Family, Shapes, View};
use crate::ground::stats::difference;

/// Many contacts with a density of slip loads (Iwan 1966).
pub const HYSTERESIS: Family = Family {
    cause: "hysteresis",
    mechanism: "rate-independent memory",
    suits: |_| true,
    members: hysteresis,
};

/// One contact in the load path.
pub const COULOMB_FRICTION: Family = Family {
    cause: "coulomb_friction",
    mechanism: "rate-independent memory",
    suits: |_| true,
    members: friction,
};

fn friction(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    for width in geometric(0.01, 0.3, 22) {
        shapes.positive(view, &held_back(view, width));
    }
    // a contact whose bristles let go one after the other (Dahl 1968; Canudas de Wit and others 1995)
    for centre in geometric(0.03, 0.3, 6) {
        let widths = [0.6, 0.8, 1.0, 1.25, 1.6].map(|f| f * centre);
        let plays = widths.map(|w| held_back(view, w));
        let mean = |i: usize| plays.iter().map(|p| p[i]).sum();
        let own: Vec<f64> = (0..view.rows()).map(mean).collect();
        shapes.positive(view, &own);
    }
    shapes
}

/// What a contact that slips at this load holds back, as an addition.
fn held_back(view: &View, width: f64) -> Vec<f64> {
    let played = view.played(width);
    difference(&played, &view.u)
}

/// How contacts yield: the power at which, and the share that acts only on the way to the limit. At half of it loops are those of
/// plays; above, the way back is straighter than the virgin one, below, rounder.
const YIELDS: [(f64, f64); 6] = [
    (1.0, 0.3),
    (1.0, 0.8),
    (2.0, 0.3),
    (2.0, 0.5),
    (2.0, 0.8),
    (1.0, 1.0),
];
/// Steps of the load, of the width, in which a yielding contact is followed.
const FINE: f64 = 0.1;

/// Friction that nears its limit, 1, smoothly: dz/du = (1 − |z|ⁿ (share · sgn(z du) + 1 − share)) / width, from rest (Bouc 1967; Wen
/// 1976, eq. 2, driven by the load).
fn yielding(u: &[f64], width: f64, power: f64, share: f64) -> Vec<f64> {
    let (mut z, mut before) = (0.0_f64, 0.0);
    let one = |load: &f64| {
        let way = load - before;
        before = *load;
        let count = (way.abs() / (FINE * width)).ceil().max(1.0);
        let step = way / count / width;
        for _ in 0..count as usize {
            let toward = share * (z * step).signum() + 1.0 - share;
            z = (z + step * (1.0 - z.abs().powf(power) * toward)).clamp(-1.0, 1.0);
        }
        z
    };
    u.iter().map(one).collect()
}

fn hysteresis(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    let widths = geometric(0.03, 0.95, 13);
    let plays: Vec<Vec<f64>> = widths.iter().map(|w| held_back(view, *w)).collect();
    let about = |centre: f64, wide: f64| {
        let weight = |w: &f64| (-0.5 * ((w / centre).ln() / wide).powi(2)).exp();
        widths.iter().map(weight).collect::<Vec<f64>>()
    };
    // backbones |u|^p have a density of plays r^(p − 2), on a geometric grid r^(p − 1)
    let power = |p: f64| widths.iter().map(|w| w.powf(p - 1.0)).collect::<Vec<f64>>();
    let densities: Vec<Vec<f64>> = [0.08, 0.15, 0.25, 0.4, 0.65]
        .iter()
        .map(|c| about(*c, 0.7))
        .chain([1.3, 1.7, 2.0, 2.5, 3.0, 3.5].map(power))
        .collect();
    for density in &densities {
        let at = |i: usize| plays.iter().zip(density).map(|(p, d)| d * p[i]).sum();
        let own: Vec<f64> = (0..view.rows()).map(at).collect();
        shapes.positive(view, &own);
    }
    for width in geometric(0.05, 0.8, 6) {
        for (power, share) in YIELDS {
            let yielding = yielding(&view.u, width, power, share);
            let own: Vec<f64> = yielding.iter().map(|z| -z).collect();
            shapes.positive(view, &own);
        }
    }
    for density in densities.iter().step_by(2) {
        shapes.density(view, &plays, density, (0.7, Sign::Loses));
    }
    let cubes: Vec<Vec<f64>> = widths
        .iter()
        .map(|w| view.played(*w).iter().map(|p| p.powi(3)).collect())
        .collect();
    let both: Vec<Vec<f64>> = plays.iter().chain(&cubes).step_by(2).cloned().collect();
    shapes.density(view, &both, &vec![1.0; both.len()], (0.7, Sign::Loses));
    shapes
}
