//! The tool's envelope cut into rings, from the middle of its end up its side.

use crate::cutting::tool::{Disc, Tool};
use std::f64::consts::FRAC_PI_2;

/// One ring of the envelope between two circles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// What a force law needs to know; the flat end has no edge.
    pub disc: Disc,
    /// Lower and upper circle: radius and height above the tip, m.
    pub circles: [[f64; 2]; 2],
    /// Length along the meridian, m.
    pub length_m: f64,
}

/// Rings about as wide as `width` (m), up to `height` (m) above the tip.
pub fn rings(tool: &Tool, width: f64, height: f64) -> Vec<Ring> {
    let (radius, corner) = (tool.radius_m, tool.corner_radius_m);
    let flat = radius - corner;
    let mut circles = vec![[0.0, 0.0]];
    let steps = |length: f64| (length / width).ceil().max(1.0) as usize;
    if flat > 0.0 {
        let n = steps(flat);
        circles.extend((1..=n).map(|i| [flat * i as f64 / n as f64, 0.0]));
    }
    if corner > 0.0 {
        let n = steps(corner * FRAC_PI_2).max(8);
        circles.extend((1..=n).map(|i| {
            let (sin, cos) = (FRAC_PI_2 * i as f64 / n as f64).sin_cos();
            [flat + corner * sin, corner * (1.0 - cos)]
        }));
    }
    let straight = height - corner;
    if straight > 0.0 {
        let n = steps(straight);
        circles.extend((1..=n).map(|i| [radius, corner + straight * i as f64 / n as f64]));
    }
    circles
        .windows(2)
        .map(|c| ring(tool, [c[0], c[1]]))
        .collect()
}

fn ring(tool: &Tool, circles: [[f64; 2]; 2]) -> Ring {
    let [[r0, z0], [r1, z1]] = circles;
    let (dr, dz) = (r1 - r0, z1 - z0);
    let chord = dr.hypot(dz);
    let normal = [dz / chord, dr / chord];
    // the arc is a little longer than its chord
    let round = tool.corner_radius_m > 0.0 && dz > 0.0 && dr > 0.0;
    let half = 0.5 * chord / tool.corner_radius_m;
    let length = if round {
        chord * half.asin() / half
    } else {
        chord
    };
    let z = 0.5 * (z0 + z1);
    let disc = Disc {
        z_m: z,
        height_m: dz,
        radius_m: 0.5 * (r0 + r1),
        edge_m: if dz > 0.0 { length } else { 0.0 },
        normal,
        lag_rad: tool.lag_rad(z),
        lag_width_rad: tool.lag_rad(dz),
    };
    Ring {
        disc,
        circles,
        length_m: length,
    }
}
