//! The drawn path as the part has it: the place nearest to where the tool is, on the same stretch between stops.

use crate::ground::spatial::{V3, sub};
use crate::path::Path;
use crate::path::nearest::nearest;
use crate::process::way::normal_part;

/// A drawn path, of which what is left is measured.
pub struct Drawn<'a> {
    path: &'a Path,
    /// Arc lengths at which it stands still, begin and end among them, m.
    stops: Vec<f64>,
}

/// The feed at the end of a stretch is that so far before it, m.
const BEFORE: f64 = 1e-9;

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
        let [first, last] = stretch;
        let point = |s: f64| self.path.point(s);
        let place = nearest(point, |s| self.feed(stretch, s), at, &(first..=last), s);
        let off = sub(at, self.path.point(place));
        normal_part(off, Some(self.feed(stretch, place)))
    }

    /// Direction of the feed at a place of a stretch: at its end that in which it arrives.
    fn feed(&self, [first, last]: [f64; 2], place: f64) -> V3 {
        self.path.direction(place.min(last - BEFORE).max(first))
    }

    /// From stop to stop about an arc length.
    fn stretch(&self, s: f64) -> [f64; 2] {
        let last = self.stops.len() - 1;
        let after = self.stops.partition_point(|stop| *stop <= s);
        let after = after.clamp(1, last);
        [self.stops[after - 1], self.stops[after]]
    }
}
