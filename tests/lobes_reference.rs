//! Chatter against published and independent numbers: Insperger and Stépán's one mode, Altintas's two
//! directions, in converged collocations of other hands (knowledge of the project, 3.6).

use ident::cutting::directional::Directional;
use ident::cutting::mean::engagement;
use ident::cutting::stability::{Passing, TipMode, limit};
use ident::cutting::wave::{Cut, Side};
use ident::cutting::{Material, Tool};
use std::f64::consts::TAU;

struct Bench {
    modes: Vec<TipMode>,
    material: Material,
    tool: Tool,
}

fn insperger() -> Bench {
    Bench {
        modes: vec![TipMode {
            direction: [1.0, 0.0, 0.0],
            omega: TAU * 922.0,
            damping_ratio: 0.011,
            stiffness: 1_340_049.648,
        }],
        material: Material::linear_edge([600.0, 200.0, 0.0, 0.0, 0.0, 0.0]),
        tool: Tool::square(5e-3, 2, 0.0),
    }
}

impl Bench {
    /// Immersion as width over diameter.
    fn passing(&self, rpm: f64, immersion: f64, side: Side, refine: f64) -> Passing {
        let cut = Cut {
            spindle_rad_s: 1.0,
            feed_m_s: 0.0,
            depth_m: 1e-3,
            width_m: immersion * 2.0 * self.tool.radius_m,
            side,
        };
        let angles = engagement(&cut, self.tool.radius_m);
        let cut = Directional::new(&self.tool, &self.material, angles, 1e-3, 5e-5);
        Passing::new(
            &self.modes,
            &cut,
            60.0 / rpm / self.tool.teeth as f64,
            refine,
        )
    }

    fn radius(&self, rpm: f64, depth_mm: f64, immersion: f64, side: Side) -> f64 {
        self.passing(rpm, immersion, side, 1.0)
            .radius(1e-3 * depth_mm)
    }

    fn limit_mm(&self, rpm: f64, immersion: f64, side: Side) -> f64 {
        let passing = self.passing(rpm, immersion, side, 1.0);
        1e3 * limit(|d| passing.radius(d), 1e-6, 10e-3).unwrap_or(f64::NAN)
    }
}

#[test]
fn spectral_radii_of_the_benchmark() {
    let bench = insperger();
    for (rpm, depth, immersion, side, expected) in [
        (5000.0, 0.2, 1.0, Side::Slot, 0.819743),
        (5000.0, 0.5, 1.0, Side::Slot, 1.073976),
        (5000.0, 0.7, 1.0, Side::Slot, 1.221556),
        (5000.0, 1.0, 1.0, Side::Slot, 1.406474),
        (10000.0, 1.0, 1.0, Side::Slot, 1.232469),
        (5000.0, 1.0, 0.05, Side::Down, 0.749503),
        (5000.0, 1.0, 0.05, Side::Up, 0.812727),
        (14000.0, 2.0, 0.5, Side::Up, 1.018282),
        (14000.0, 2.0, 0.5, Side::Down, 0.839097),
    ] {
        let found = bench.radius(rpm, depth, immersion, side);
        println!("{rpm} {depth} {immersion} {side:?}: {found:.6} for {expected}");
        assert!((found - expected).abs() < 1e-4, "{found} for {expected}");
    }
}

#[test]
fn depth_limits_of_the_benchmark() {
    let bench = insperger();
    for (rpm, immersion, side, expected) in [
        (6000.0, 1.0, Side::Slot, 0.35322),
        (9000.0, 1.0, Side::Slot, 3.00921),
        (14000.0, 1.0, Side::Slot, 2.14001),
        (18000.0, 1.0, Side::Slot, 0.68954),
        (20000.0, 1.0, Side::Slot, 1.41751),
        (6000.0, 0.5, Side::Down, 1.13885),
        (9000.0, 0.5, Side::Down, 1.56479),
        (14000.0, 0.5, Side::Down, 3.09052),
        (18000.0, 0.5, Side::Down, 1.61970),
        (20000.0, 0.5, Side::Down, 0.71964),
        (6000.0, 0.5, Side::Up, 0.22789),
        (14000.0, 0.5, Side::Up, 1.43627),
        (6000.0, 0.05, Side::Down, 3.07133),
        (9000.0, 0.05, Side::Down, 4.31646),
        (20000.0, 0.05, Side::Down, 2.29868),
    ] {
        let found = bench.limit_mm(rpm, immersion, side);
        println!("{rpm} {immersion} {side:?}: {found:.5} for {expected}");
        assert!(
            (found / expected - 1.0).abs() < 5e-3,
            "{found} for {expected}"
        );
    }
}

#[test]
fn the_least_limit_of_two_directions_is_that_of_the_real_modes() {
    // of a residue σ + jν a real mode keeps ν: H = -2 ω_d ν / (s² + 2ζω s + ω²)
    let mode = |direction: [f64; 3], hz: f64, zeta: f64, nu: f64| {
        let omega = TAU * hz;
        let alpha = -2.0 * omega * (1.0 - zeta * zeta).sqrt() * nu;
        TipMode {
            direction,
            omega,
            damping_ratio: zeta,
            stiffness: omega * omega / alpha,
        }
    };
    let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let bench = Bench {
        modes: vec![
            mode(x, 452.77, 0.123718, -1.862195e-4),
            mode(x, 1448.53, 0.01651, -3.043618e-4),
            mode(y, 516.17, 0.0243, -1.721539e-4),
            mode(y, 1407.64, 0.0324, -3.618808e-4),
        ],
        material: Material::linear_edge([1319.4, 788.8, 0.0, 0.0, 0.0, 0.0]),
        tool: Tool::square(15.875e-3, 2, 0.0),
    };
    // the two lobes about the published pocket of 5.03 mm at 14000 rev/min
    let speeds = (0..21).map(|i| 10_000.0 + 250.0 * f64::from(i));
    let limits: Vec<f64> = speeds
        .map(|rpm| bench.limit_mm(rpm, 0.5, Side::Down))
        .collect();
    let least = limits.iter().copied().fold(f64::MAX, f64::min);
    let pocket = bench.limit_mm(14_000.0, 0.5, Side::Down);
    assert!((least / 0.916 - 1.0).abs() < 0.02, "{least}");
    assert!((pocket / 5.03 - 1.0).abs() < 0.02, "{pocket}");
}

#[test]
fn two_hundred_speeds_take_less_than_two_seconds() {
    use rayon::prelude::*;
    let bench = insperger();
    let start = std::time::Instant::now();
    let limits: Vec<f64> = (0..200)
        .into_par_iter()
        .map(|i| bench.limit_mm(5000.0 + 100.0 * f64::from(i), 1.0, Side::Slot))
        .collect();
    println!(
        "{:.2?}, least {:.3}",
        start.elapsed(),
        limits.iter().fold(f64::MAX, |m, v| m.min(*v))
    );
    assert!(limits.iter().filter(|v| v.is_finite()).count() > 150);
}
