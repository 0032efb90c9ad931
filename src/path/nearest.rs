//! The place of a curve nearest to a point: one search for corners, recordings and compensated paths.

use crate::ground::vector::{V3, dot, norm, sub};
use std::ops::RangeInclusive;

/// Steps to the nearest place, and how near they lead, m.
const STEPS: usize = 12;
const ARRIVED: f64 = 1e-9;
/// A step in what a straight line would take: about the middle of its curvature a point is as near to all places.
const FARTHEST: f64 = 10.0;

/// Pieces of a stretch that is looked at, and how often the best is looked at again by pieces: near a sharp corner two places are nearest
/// each on its own leg.
const PIECES: usize = 24;
const ROUNDS: usize = 2;

/// The nearest place of a whole stretch of arc length, m.
pub fn sought(
    point: impl Fn(f64) -> V3,
    feed: impl Fn(f64) -> V3,
    to: V3,
    within: RangeInclusive<f64>,
) -> f64 {
    let (mut place, mut about) = (*within.start(), within);
    for _ in 0..ROUNDS {
        (place, about) = coarse(&point, to, &about);
    }
    nearest(point, feed, to, &about, place)
}

/// The nearest of places spread evenly over a stretch, and the stretch between its neighbours.
fn coarse(
    point: impl Fn(f64) -> V3,
    to: V3,
    within: &RangeInclusive<f64>,
) -> (f64, RangeInclusive<f64>) {
    let (first, last) = (*within.start(), *within.end());
    let step = (last - first) / PIECES as f64;
    let far = |i: &usize| norm(sub(point(first + step * *i as f64), to));
    let best = (0..=PIECES).min_by(|a, b| far(a).total_cmp(&far(b)));
    let place = first + step * best.unwrap_or(0) as f64;
    let about = (place - step).max(first)..=(place + step).min(last);
    (place.min(last), about)
}

/// The nearest place of a stretch from a place near it, m: along the feed there (a unit vector), again and again, as far as the last step
/// says that the curve bends (a secant); half as far where that leads away.
pub fn nearest(
    point: impl Fn(f64) -> V3,
    feed: impl Fn(f64) -> V3,
    to: V3,
    within: &RangeInclusive<f64>,
    from: f64,
) -> f64 {
    let inside = |s: f64| s.max(*within.start()).min(*within.end());
    let off = |s: f64| sub(to, point(s));
    let mut place = inside(from);
    let (mut here, mut share) = (off(place), 1.0);
    let mut ahead = dot(here, feed(place));
    for _ in 0..STEPS {
        let next = inside(place + share * ahead);
        if (next - place).abs() < ARRIVED {
            break;
        }
        let there = off(next);
        let is_nearer = norm(there) < norm(here);
        if !is_nearer {
            share *= 0.5;
            continue;
        }
        let then = dot(there, feed(next));
        let bent = (next - place) / (ahead - then);
        share = if bent > 0.0 { bent.min(FARTHEST) } else { 1.0 };
        (place, here, ahead) = (next, there, then);
    }
    place
}

#[cfg(test)]
mod tests {
    use super::{V3, nearest, norm, sought, sub};
    use std::f64::consts::TAU;

    fn circle(radius: f64) -> [impl Fn(f64) -> V3; 2] {
        let point = move |s: f64| {
            [
                radius * (s / radius).cos(),
                radius * (s / radius).sin(),
                0.0,
            ]
        };
        let feed = move |s: f64| [-(s / radius).sin(), (s / radius).cos(), 0.0];
        [Box::new(point) as Box<dyn Fn(f64) -> V3>, Box::new(feed)]
    }

    /// Of a circle the nearest place has the point's angle, inside and outside of it.
    #[test]
    fn of_a_circle_it_has_the_angle_of_the_point() {
        let [point, feed] = circle(0.1);
        for (angle, away) in [(0.3_f64, 0.101), (1.0, 0.0993), (2.0, 0.16), (5.0, 0.02)] {
            let to = [away * angle.cos(), away * angle.sin(), 1e-3];
            let place = sought(&point, &feed, to, 0.0..=0.1 * TAU);
            assert!((place - 0.1 * angle).abs() < 1e-7, "{angle}: {place}");
        }
    }

    /// About a sharp corner the nearer leg is found: either one has a foot of the point.
    #[test]
    fn at_a_corner_it_is_on_the_nearer_leg() {
        let (corner, turn) = (5e-3, 135.0_f64.to_radians());
        let leg = [turn.cos(), turn.sin(), 0.0];
        let point = |s: f64| match s < corner {
            true => [s, 0.0, 0.0],
            false => [corner + (s - corner) * leg[0], (s - corner) * leg[1], 0.0],
        };
        let feed = |s: f64| if s < corner { [1.0, 0.0, 0.0] } else { leg };
        for k in 0..200 {
            let (back, up) = (1e-6 * f64::from(k), 2e-7 * f64::from(k * k % 97));
            let to = [corner - back, up, 0.0];
            let place = sought(point, feed, to, corner - 1.3e-3..=corner + 1.1e-3);
            let on = |s: f64| norm(sub(point(s), to));
            let best = (0..24000).map(|i| on(corner - 1.3e-3 + 1e-7 * f64::from(i)));
            let best = best.fold(f64::INFINITY, f64::min);
            assert!(on(place) < best + 1e-6, "{k}: {} {best}", on(place));
        }
    }

    /// Beyond the end of a stretch its end is nearest.
    #[test]
    fn it_does_not_leave_the_stretch() {
        let [point, feed] = circle(0.1);
        let place = nearest(&point, &feed, [0.0, 0.1, 0.0], &(0.0..=0.05), 0.04);
        assert_eq!(place, 0.05);
    }
}
