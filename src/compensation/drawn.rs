//! The drawn path as the part has it: the place nearest to where the tool is, on the same stretch between stops.

use crate::ground::spatial::{V3, dot, norm, sub};
use crate::path::Path;
use crate::process::way::normal_part;

/// A drawn path, of which what is left is measured.
pub struct Drawn<'a> {
    path: &'a Path,
    /// Arc lengths at which it stands still, begin and end among them, m.
    stops: Vec<f64>,
}

/// Steps to the nearest place, and how near they lead, m.
const STEPS: usize = 12;
const ARRIVED: f64 = 1e-9;

impl<'a> Drawn<'a> {
    /// A path.
    pub fn of(path: &'a Path) -> Self {
        Self {
            path,
            stops: path.halts.iter().map(|halt| halt.at).collect(),
        }
    }

    /// What is left where the tool is at `at` and should be at the arc length `s`: the way to it from the nearest place of the stretch,
    /// normal to the feed there. A tool that is late is not off the part; where the path bends it is, by what it cuts off the bend.
    pub fn left(&self, s: f64, at: V3) -> V3 {
        let stretch = self.stretch(s);
        let place = self.nearest(stretch, s, at);
        let off = sub(at, self.path.point(place));
        normal_part(off, Some(self.feed(stretch, place)))
    }

    /// Arc length of the nearest place: by the feed there, again and again; half as far where that leads away.
    fn nearest(&self, [first, last]: [f64; 2], s: f64, at: V3) -> f64 {
        let off = |s: f64| sub(at, self.path.point(s));
        let (mut place, mut share) = (s.clamp(first, last), 1.0);
        let mut here = off(place);
        for _ in 0..STEPS {
            let step = share * dot(here, self.feed([first, last], place));
            let next = (place + step).clamp(first, last);
            if (next - place).abs() < ARRIVED {
                break;
            }
            let there = off(next);
            if norm(there) < norm(here) {
                (place, here, share) = (next, there, 1.0);
            } else {
                share *= 0.5;
            }
        }
        place
    }

    /// Direction of the feed at a place of a stretch: at its end that in which it arrives.
    fn feed(&self, [first, last]: [f64; 2], place: f64) -> V3 {
        self.path.direction(place.min(last - ARRIVED).max(first))
    }

    /// From stop to stop about an arc length.
    fn stretch(&self, s: f64) -> [f64; 2] {
        let last = self.stops.len() - 1;
        let after = self.stops.partition_point(|stop| *stop <= s);
        let after = after.clamp(1, last);
        [self.stops[after - 1], self.stops[after]]
    }
}
