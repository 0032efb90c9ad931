//! Is anything left that the noise does not explain?

use crate::findings::engine::rest::Rest;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// What is left after a set of causes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adequacy {
    /// Probability that chance leaves so much in the slopes.
    pub slopes: f64,
    /// Probability that chance leaves so much beyond the straight lines.
    pub levels: f64,
    /// Share of the error's variance above the noise that is left.
    pub share: f64,
    /// Squares left beyond the lines over what noise leaves.
    pub bent: f64,
    /// Probability that chance leaves such an even part, cubic part or loop.
    pub shape: f64,
    /// How far the zero wanders between cycles, in standard deviations of a reading.
    pub wander: f64,
}

/// A sum of squares in variances of the noise, with its degrees of freedom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Squares {
    /// The sum.
    pub sum: f64,
    /// Degrees of freedom.
    pub freedom: f64,
}

impl Squares {
    /// Probability of more by chance.
    pub fn chance(self) -> f64 {
        let law = ChiSquared::new(self.freedom.max(1.0));
        law.map_or(1.0, |law| law.sf(self.sum.max(0.0)))
    }

    fn excess(self) -> f64 {
        (self.sum - self.freedom).max(0.0)
    }
}

/// Slopes left that chance explains with less than this are structure ...
const SLOPES: f64 = 1e-4;
/// ... and levels, whose noise may be slow, with less than this ...
const LEVELS: f64 = 1e-8;
/// ... and this much above the noise ...
const BENT: f64 = 1.6;
/// ... if this share of the error is left.
const MATTERS: f64 = 0.06;
/// Stationary noise, however slow, moves the mean of a cycle by less than this many of its deviations.
const WANDER: f64 = 1.5;

/// A simple bend is structure below this probability.
const SHAPE: f64 = 1e-6;

/// Probability of the largest of three simple bends.
fn shape((sums, freedom): ([f64; 3], f64)) -> f64 {
    let chance = |sum: &f64| Squares { sum: *sum, freedom }.chance();
    (3.0 * sums.iter().map(chance).fold(1.0, f64::min)).min(1.0)
}

impl Adequacy {
    /// Of what is left in slopes and levels, against what there was before.
    pub fn of(
        slopes: Squares,
        levels: Squares,
        before: f64,
        (bends, wander): (([f64; 3], f64), f64),
    ) -> Self {
        let left = slopes.excess() + levels.excess();
        let noise = slopes.freedom + levels.freedom;
        Self {
            slopes: slopes.chance(),
            levels: levels.chance(),
            share: left / (before - noise).max(left).max(1.0),
            bent: levels.sum / levels.freedom.max(1.0),
            shape: shape(bends),
            wander,
        }
    }

    /// Whether force and displacement are out of proportion.
    pub fn is_bent(&self) -> bool {
        (self.levels < LEVELS && self.bent > BENT) || self.shape < SHAPE
    }

    /// Whether structure is left.
    pub fn is_left(&self) -> bool {
        let left = (self.slopes < SLOPES || self.is_bent()) && self.share > MATTERS;
        left || self.wanders() || self.shape < SHAPE
    }

    /// Whether readings do not come back from cycle to cycle.
    pub fn wanders(&self) -> bool {
        self.wander > WANDER
    }

    /// As it is judged; `strange`: a pattern that no cause of the library has stands beside them.
    pub fn rest(&self, strange: bool) -> Rest {
        Rest {
            nats: -self.p_value().max(f64::MIN_POSITIVE).ln(),
            share: self.share.sqrt(),
            is_left: self.is_left() || strange,
            scatter: None,
        }
    }

    /// Probability that chance leaves so much.
    fn p_value(&self) -> f64 {
        match self.is_bent() {
            true => self.levels.min(self.shape),
            false => self.slopes,
        }
    }
}
