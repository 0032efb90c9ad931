//! Where a runout points that is stated by its size: nobody states its direction.

use super::Case;
use super::aim::{Aim, Loose};
use crate::experiments::milling_force::RUNOUT;
use std::f64::consts::TAU;

/// Directions that are tried.
const TRIED: usize = 720;

/// A runout as a fit sees it, whatever its size.
pub struct Direction {
    /// Along tooth 1 and a quarter turn on, m.
    pub at: [f64; 2],
    /// Its covariance, m².
    pub covariance: [[f64; 2]; 2],
}

impl Direction {
    /// Of a case, with what is uncertain beside it.
    pub fn seen(case: &Case) -> Option<Self> {
        let places = [RUNOUT, RUNOUT + 1];
        let is_runout = |l: &Loose| l.along.iter().any(|(place, _)| places.contains(place));
        let mut loose = case.loose();
        loose.retain(|l| !is_runout(l));
        let others = loose.len();
        loose.extend(places.map(|place| Loose::place(place, f64::INFINITY)));
        let (by, covariance) = Aim::new(case, loose).last_two(others)?;
        let before = case.runout();
        Some(Self {
            at: [before[0] + by[0], before[1] + by[1]],
            covariance,
        })
    }

    /// The runout of this size that is the most probable: two teeth show one part of it alone.
    pub fn of_size(&self, size: f64) -> [f64; 2] {
        let [[xx, xy], [_, yy]] = self.covariance;
        let away = |[x, y]: &[f64; 2]| {
            let (x, y) = (x - self.at[0], y - self.at[1]);
            yy * x * x - 2.0 * xy * x * y + xx * y * y
        };
        let each = (0..TRIED).map(|i| {
            let (sin, cos) = (i as f64 / TRIED as f64 * TAU).sin_cos();
            [size * cos, size * sin]
        });
        let nearest = each.min_by(|a, b| away(a).total_cmp(&away(b)));
        nearest.unwrap_or(self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_fit_sees_stays_and_the_rest_makes_up_the_size() {
        let seen = Direction {
            at: [3e-6, 1e-6],
            covariance: [[1e-16, 0.0], [0.0, 1e-9]],
        };
        let [x, y] = seen.of_size(5e-6);
        assert!(
            (x - 3e-6).abs() < 5e-8 && (y - 4e-6).abs() < 5e-8,
            "{x} {y}"
        );
    }
}
