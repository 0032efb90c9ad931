//! Rapid motions that cut.

use super::run::{Cut, Drilled, Outcome};
use crate::ground::spatial::norm;

/// Share of the largest force from which a rapid motion cuts, and stations one after the other that show it: the last touch of a wall on
/// the way out is none.
const FELT: f64 = 0.05;
const FEW: usize = 5;
/// What the flat end may take on the way, m³: cells of the stock hold more than a touch. A choice.
const TOUCH_M3: f64 = 1e-9;

impl Outcome {
    /// Where a rapid motion cuts or drills first, arc length of the path in m. `is_rapid`: of a place.
    pub fn cut_in_rapid(&self, is_rapid: impl Fn(f64) -> bool) -> Option<f64> {
        let cut = self.teeth_in_rapid(&is_rapid).into_iter();
        cut.chain(self.end_in_rapid(&is_rapid)).reduce(f64::min)
    }

    fn teeth_in_rapid(&self, is_rapid: impl Fn(f64) -> bool) -> Option<f64> {
        let counts = |c: &Cut| c.cutting && norm(c.force) > FELT * self.peak_n && is_rapid(c.s_m);
        let all = self.course.windows(FEW);
        all.filter(|own| own.iter().all(counts))
            .map(|own| own[0].s_m)
            .next()
    }

    /// Where the flat end drills, which has no force: in one motion more than a touch.
    fn end_in_rapid(&self, is_rapid: impl Fn(f64) -> bool) -> Option<f64> {
        let counts = |d: &&Drilled| d.between_m.iter().all(|s| is_rapid(*s));
        let own: Vec<&Drilled> = self.drilled.iter().filter(counts).collect();
        let motions = own.chunk_by(|a, b| a.between_m[1] == b.between_m[0]);
        let volume = |motion: &[&Drilled]| motion.iter().map(|d| d.volume_m3).sum::<f64>();
        let mut cut = motions.filter(|motion| volume(motion) > TOUCH_M3);
        cut.next().map(|motion| motion[0].between_m[0])
    }
}
