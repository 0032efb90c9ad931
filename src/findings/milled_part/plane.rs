//! Where a tool passes a probed place: it may be ahead or behind of where it is told to be.

use crate::ground::spatial::{V3, dot, sub};

/// Speed below which a tool stands, m/s: the places that it passes later are not told from its deviation.
const STANDS: f64 = 1e-3;
/// Steps to the time at which the tool passes a place, and how near to the place it is passed, m.
const STEPS: usize = 4;
const PASSED: f64 = 1e-6;
/// Way within which that time is sought, m, and parts of it that are looked at on either side: a tool that passes the place from
/// farther off has been there before or comes again.
const NEAREST: f64 = 2e-3;
const PARTS: i32 = 40;

/// The plane across the feed at a place.
pub(super) struct Plane {
    /// The place, m.
    pub place: V3,
    /// How fast the tool goes through it, m/s.
    pub speed: f64,
    /// The direction of the feed.
    pub feed: V3,
}

impl Plane {
    /// From its place to where a tool passes it, m: ahead or behind of about that time as it gives way along the feed. `tool`: where
    /// that is at any time.
    pub fn passed_by(&self, tool: impl Fn(f64) -> V3, about_s: f64) -> V3 {
        let off = |time: f64| sub(tool(time), self.place);
        if self.speed <= STANDS {
            return off(about_s);
        }
        let behind = |time: f64| -dot(off(time), self.feed);
        let passes = (0..STEPS).fold(about_s, |time, _| time + behind(time) / self.speed);
        let far_s = NEAREST / self.speed;
        if behind(passes).abs() < PASSED && (passes - about_s).abs() < far_s {
            return off(passes);
        }
        off(passed(behind, about_s, far_s / f64::from(PARTS)).unwrap_or(about_s))
    }
}

/// When what is behind of a place no longer is: the nearest such time about one, looked for in steps.
fn passed(behind: impl Fn(f64) -> f64, about_s: f64, step_s: f64) -> Option<f64> {
    let time = |k: i32| about_s + step_s * f64::from(k);
    let far: Vec<f64> = (-PARTS..=PARTS).map(|k| behind(time(k))).collect();
    let turns = far.windows(2).zip(-PARTS..);
    let turns = turns.filter(|(w, _)| w[0] >= 0.0 && w[1] < 0.0);
    let crossed = turns.map(|(w, k)| time(k) + step_s * w[0] / (w[0] - w[1]));
    crossed.min_by(|a, b| (a - about_s).abs().total_cmp(&(b - about_s).abs()))
}

#[cfg(test)]
mod tests {
    use super::Plane;
    use crate::ground::spatial::V3;

    /// A tool that swings along its feed by 0.8 mm at 10 Hz passes a place when it is there, not when it is told to be there.
    #[test]
    fn a_place_is_passed_when_the_tool_is_there() {
        let tool = |time: f64| -> V3 {
            let swing = 0.8e-3 * (62.8 * time).sin();
            [0.03 * time + swing, 1e-4 * time, 0.0]
        };
        for k in 0..20 {
            let time = 0.01 * f64::from(k) + 0.1;
            let plane = Plane {
                place: [0.03 * time, 0.0, 0.0],
                speed: 0.03,
                feed: [1.0, 0.0, 0.0],
            };
            let left = plane.passed_by(tool, time);
            assert!(left[0].abs() < 3e-6, "{left:?}");
            assert!((left[1] / 1e-4 - time).abs() < 0.03, "{left:?}");
        }
    }
}
