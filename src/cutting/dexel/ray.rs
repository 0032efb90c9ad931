//! One ray: the pieces of a line that lie in material.

/// Pieces of a line, ascending and apart. Most rays have one; only others use the heap.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ray {
    first: [f64; 2],
    rest: Option<Box<[[f64; 2]]>>,
}

/// No piece: it begins after it ends.
const NONE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

impl Ray {
    /// A ray with these pieces (ascending).
    pub fn new(pieces: &[[f64; 2]]) -> Self {
        let mut pieces = pieces.iter().copied().filter(|p| p[0] < p[1]);
        let first = pieces.next().unwrap_or(NONE);
        let rest: Vec<[f64; 2]> = pieces.collect();
        let rest = (!rest.is_empty()).then(|| rest.into_boxed_slice());
        Self { first, rest }
    }

    /// The pieces.
    pub fn pieces(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let first = Some(self.first).filter(|p| p[0] < p[1]);
        first.into_iter().chain(self.others().iter().copied())
    }

    fn others(&self) -> &[[f64; 2]] {
        self.rest.as_deref().unwrap_or(&[])
    }

    /// Length in material.
    pub fn length(&self) -> f64 {
        self.pieces().map(|[a, b]| b - a).sum()
    }

    /// Takes everything between `low` and `high` away.
    #[inline]
    pub fn subtract(&mut self, low: f64, high: f64) {
        let [a, b] = self.first;
        if self.rest.is_none() {
            if high <= a || low >= b {
                return;
            }
            match (low > a, high < b) {
                (true, false) => self.first[1] = low,
                (false, true) => self.first[0] = high,
                (false, false) => self.first = NONE,
                (true, true) => self.split(low, high),
            }
            return;
        }
        if !self.trim(low, high) {
            self.split(low, high);
        }
    }

    /// Shortens pieces at their ends where that is all it takes; tells whether it was.
    fn trim(&mut self, low: f64, high: f64) -> bool {
        let others = self.rest.iter_mut().flat_map(|rest| rest.iter_mut());
        for [a, b] in std::iter::once(&mut self.first).chain(others) {
            if high <= *a || low >= *b {
                continue;
            }
            match (low > *a, high < *b) {
                (true, false) => *b = low,
                (false, true) => *a = high,
                _ => return false,
            }
        }
        true
    }

    #[cold]
    fn split(&mut self, low: f64, high: f64) {
        let cut = |[a, b]: [f64; 2]| [[a, b.min(low)], [a.max(high), b]];
        let kept: Vec<[f64; 2]> = self.pieces().flat_map(cut).collect();
        *self = Self::new(&kept);
    }

    /// Signed distance along the ray from `at` to the nearest border, positive in material, and how it
    /// changes with `at`: +1 where material begins there, −1 where it ends. Beyond `cap` the distance is
    /// the cap, and does not change.
    #[inline]
    pub fn border(&self, at: f64, cap: f64) -> (f64, f64) {
        let mut best = border(self.first, at);
        for piece in self.others() {
            let other = border(*piece, at);
            if other.0 > best.0 {
                best = other;
            }
        }
        if best.0.abs() >= cap {
            return (cap.copysign(best.0), 0.0);
        }
        best
    }
}

/// Distance to the nearer end of one piece, positive inside, and its slope over `at`.
#[inline]
fn border([a, b]: [f64; 2], at: f64) -> (f64, f64) {
    match at - a < b - at {
        true => (at - a, 1.0),
        false => (b - at, -1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_twice_is_taken_once() {
        let mut ray = Ray::new(&[[0.0, 10.0]]);
        ray.subtract(2.0, 3.0);
        ray.subtract(2.5, 5.0);
        ray.subtract(9.0, 12.0);
        let pieces: Vec<_> = ray.pieces().collect();
        assert_eq!(pieces, [[0.0, 2.0], [5.0, 9.0]]);
        assert_eq!(ray.length(), 6.0);
        ray.subtract(-1.0, 20.0);
        assert_eq!(ray.pieces().count(), 0);
    }

    #[test]
    fn borders_are_signed_and_capped() {
        let ray = Ray::new(&[[0.0, 4.0], [6.0, 10.0]]);
        assert_eq!(ray.border(1.0, 5.0), (1.0, 1.0));
        assert_eq!(ray.border(3.5, 5.0), (0.5, -1.0));
        assert_eq!(ray.border(5.5, 5.0), (-0.5, 1.0));
        assert_eq!(ray.border(20.0, 5.0), (-5.0, 0.0));
        assert_eq!(Ray::new(&[]).border(0.0, 5.0), (-5.0, 0.0));
    }
}
