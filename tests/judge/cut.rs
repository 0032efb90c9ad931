//! Straight cuts of a square end mill: what of its circumference stands in the material, and the mean force of a turn.
//! Material is a box less what earlier passes swept, told point by point; no grid.

use super::algebra::V3;
use std::f64::consts::TAU;

/// Ktc, Krc, Kac in N/m², Kte, Kre, Kae in N/m.
pub type Coefficients = [f64; 6];

/// A part of the tool's way in the material, two ends in the workpiece frame, m.
pub type Sweep = (V3, V3);

/// Tool and stock.
#[derive(Debug, Clone)]
pub struct Mill {
    pub radius: f64,
    pub teeth: usize,
    pub rpm: f64,
    pub low: V3,
    pub high: V3,
}

const ANGLES: usize = 720;

fn distance(p: [f64; 2], (a, b): &Sweep) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let long = dx * dx + dy * dy;
    let share = match long > 0.0 {
        true => (((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / long).clamp(0.0, 1.0),
        false => 0.0,
    };
    (p[0] - a[0] - share * dx).hypot(p[1] - a[1] - share * dy)
}

impl Mill {
    /// Height of the material at a place, m; `None` where there is none.
    fn height(&self, p: [f64; 2], swept: &[Sweep]) -> Option<f64> {
        let inside = (0..2).all(|k| p[k] > self.low[k] && p[k] < self.high[k]);
        if !inside {
            return None;
        }
        let taken = |s: &&Sweep| distance(p, s) < self.radius - 1e-9;
        let floor = |s: &Sweep| 0.5 * (s.0[2] + s.1[2]);
        Some(
            swept
                .iter()
                .filter(taken)
                .map(floor)
                .fold(self.high[2], f64::min),
        )
    }

    /// What each coefficient contributes to the mean force on the tool (feed, left, up) at `tip`, for one N/m² or N/m.
    pub fn shares(&self, tip: V3, feed: [f64; 2], speed: f64, swept: &[Sweep]) -> [V3; 6] {
        let chip = speed * 60.0 / (self.rpm * self.teeth as f64);
        let left = [-feed[1], feed[0]];
        let near = |s: &&Sweep| distance([tip[0], tip[1]], s) < 2.0 * self.radius;
        let swept: Vec<Sweep> = swept.iter().filter(near).copied().collect();
        let mut all = [[0.0; 3]; 6];
        for i in 0..ANGLES {
            let angle = TAU * (i as f64 + 0.5) / ANGLES as f64;
            let (s, c) = angle.sin_cos();
            if s <= 0.0 {
                continue;
            }
            let p = [0, 1].map(|k| tip[k] + self.radius * (s * feed[k] + c * left[k]));
            let Some(deep) = self
                .height(p, &swept)
                .map(|h| h - tip[2])
                .filter(|d| *d > 0.0)
            else {
                continue;
            };
            let weight = self.teeth as f64 / ANGLES as f64 * deep;
            // To the trochoid of the tooth before, second order in feed over radius.
            let turned = chip * self.teeth as f64 / (TAU * self.radius);
            let way = chip * (1.0 - turned * c);
            let thick = way * s + (way * c).powi(2) / (2.0 * self.radius);
            let sides = [[-c, s, 0.0], [-s, -c, 0.0], [0.0, 0.0, 1.0]];
            for (k, side) in sides.iter().enumerate() {
                for x in 0..3 {
                    all[k][x] += weight * thick * side[x];
                    all[k + 3][x] += weight * side[x];
                }
            }
        }
        all
    }
}

/// The force of these coefficients.
pub fn force(shares: &[V3; 6], k: &Coefficients) -> V3 {
    std::array::from_fn(|x| (0..6).map(|i| shares[i][x] * k[i]).sum())
}

/// Speed this far behind a stop, with a given jerk and greatest acceleration.
pub fn speed_after(way: f64, feed: f64, most: f64, jerk: f64) -> f64 {
    // Jerk up, hold, jerk down: time by small steps.
    let peak = most.min((feed * jerk).sqrt());
    let (mut v, mut s, dt) = (0.0_f64, 0.0, 2e-4);
    let rise = peak / jerk;
    let whole = feed / peak + rise;
    let mut t = 0.0;
    while s < way && v < feed {
        let a = if t < rise {
            jerk * t
        } else if t < whole - rise {
            peak
        } else {
            (jerk * (whole - t)).max(1e-3 * peak)
        };
        v = (v + a * dt).min(feed);
        s += v * dt;
        t += dt;
    }
    v.max(1e-4)
}
