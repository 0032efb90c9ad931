//! Rapid motions that cut.

use super::run::{Cut, Outcome};
use crate::ground::spatial::norm;

/// Share of the largest force from which a rapid motion cuts, and stations one after the other that show it: the last touch of a wall on
/// the way out is none.
const FELT: f64 = 0.05;
const FEW: usize = 5;

impl Outcome {
    /// Where a rapid motion cuts first, arc length of the path in m. `is_rapid`: of a place. What only drills has no force, and is not seen.
    pub fn cut_in_rapid(&self, is_rapid: impl Fn(f64) -> bool) -> Option<f64> {
        let counts = |c: &Cut| c.cutting && norm(c.force) > FELT * self.peak_n && is_rapid(c.s_m);
        let all = self.course.windows(FEW);
        all.filter(|own| own.iter().all(counts))
            .map(|own| own[0].s_m)
            .next()
    }
}
