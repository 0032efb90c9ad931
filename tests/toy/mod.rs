//! An effect that the program has never heard of.

use ident::effects::contract::{Card, Family, Law, Parameter, Scale};
use ident::effects::scene::Scene;
use ident::ground::dual::Scalar;

/// A detent: the joint gives way around one load.
pub struct Detent;

impl Law for Detent {
    const CARD: Card = Card {
        name: "detent",
        cause: "detent",
        family: Family::Physics,
        summary: "A toy: the joint gives way around one load.",
        equation: "φ += depth / (1 + ((M − load)/width)²)",
        source: "invented for this test",
        signature: "a bump at one load",
        parameters: &[
            Parameter {
                name: "depth",
                meaning: "height of the bump",
                scale: Scale::Deflection,
                bounds: (0.0, 1.0),
                grid: &[0.02],
            },
            Parameter {
                name: "load",
                meaning: "where it is",
                scale: Scale::Load,
                bounds: (-0.9, 0.9),
                grid: &[-0.5, -0.2, 0.1, 0.3, 0.5],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        for (y, load) in out.iter_mut().zip(&scene.load) {
            let x = (S::constant(*load) - p[1]) / (0.12 * scene.load_scale);
            *y += p[0] / (x * x + 1.0);
        }
    }
}

/// The same bump written otherwise, over relative deflection.
pub fn bump(u: f64) -> f64 {
    let x = (u - 0.4) / 0.12;
    (-(x * x + 1.0).ln()).exp()
}

/// A file with `extra` (rad) added to its first deflection.
pub fn with(csv: &str, extra: &[f64]) -> String {
    let fact = |key: &str| {
        let line = csv.lines().find(|l| l.contains(key))?;
        line.split('=').nth(1)?.trim().parse::<f64>().ok()
    };
    let factor = fact("sensor_lever_m").map_or(1.0, |lever| 1e3 * lever);
    let mut rows = extra.iter();
    let mut seen_header = false;
    let mut out = String::new();
    for line in csv.lines() {
        if line.starts_with('#') || !seen_header {
            seen_header |= !line.starts_with('#');
            out.push_str(line);
        } else {
            let mut cells: Vec<String> = line.split(',').map(str::to_string).collect();
            let value: f64 = cells[2].parse().unwrap();
            cells[2] = format!("{:e}", value + factor * rows.next().unwrap());
            out.push_str(&cells.join(","));
        }
        out.push('\n');
    }
    out
}
