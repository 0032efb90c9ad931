//! Where along its part a cause sits, and how much of the part lies behind it.

/// Shares of the body of a part behind the place where it bends: half of it first, as of a bar that bends in its middle. All of it
/// would leave nothing before.
pub const SHARES_BEHIND: [f64; 5] = [0.5, 0.0, 0.25, 0.75, 0.95];

/// How far from one place to the next a cause is tried, eighths of the way: as far as the middle.
pub const STEPS: [u8; 2] = [2, 4];

/// A place between two: what is shared by both in proportion acts there, but for a small spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Between {
    /// The other place.
    pub other: usize,
    /// How far towards it, eighths of the way.
    pub eighths: u8,
}

impl Between {
    /// Share of the other place.
    pub fn share(self) -> f64 {
        f64::from(self.eighths) / 8.0
    }
}

/// A site, a place of it, and how far from there towards the next.
pub type Seat = (String, usize, Option<Between>);
