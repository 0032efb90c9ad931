//! The chip: what a tooth finds along its radius between the surface that the teeth before it left on
//! their trochoids and its own edge, in stock of a given width.
//!
//! Not c sin φ, which is its first order (Martellotti 1941): earlier teeth have their own radii, and
//! their centres stood elsewhere. A tooth that came k pitches earlier crossed the ray at tooth angle
//! φ + ε, when the axis lay δ = q (2πk/N - ε) behind, q the feed per radian: R_i sin ε = δ cos φ, and its
//! surface lies R_i cos ε - δ sin φ from the axis.

use crate::ground::dual::Scalar;
use std::f64::consts::TAU;

/// The tip of a tooth as the spindle's axis sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip<S: Scalar = f64> {
    /// Its distance from the spindle's axis, m.
    pub radius: S,
    /// How far it stands ahead of its tooth angle, rad: runout moves a tip aside as well as outwards.
    pub aside: S,
}

/// Where stock stands beside the tool: the half plane on one side of a line along the feed, or both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stock<S: Scalar = f64> {
    /// On either side: a full slot.
    Full,
    /// Left of the feed, beyond this y (m): teeth enter at φ = 0, up milling.
    Left(S),
    /// Right of the feed, below this y (m): teeth leave at φ = 180°, down milling.
    Right(S),
}

impl<S: Scalar> Stock<S> {
    /// Where the border stands across the ray of a tooth: its y and cos φ, both counted into the stock.
    #[inline]
    fn border(&self, cos: S) -> Option<[S; 2]> {
        match *self {
            Self::Full => None,
            Self::Left(y) => Some([y, cos]),
            Self::Right(y) => Some([-y, -cos]),
        }
    }
}

/// A steady cut of one disc: constant feed and spindle speed, all revolutions alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steady<S: Scalar = f64> {
    /// Feed per radian of the spindle, m/rad.
    pub feed_per_radian: f64,
    /// The stock.
    pub stock: Stock<S>,
    /// Share of a ray before the border that counts as chip all the same: 0 by geometry; up to 1 where the
    /// chip gives way towards the free face of the stock before it is cut.
    pub before: S,
}

/// Least cosine with which a chip is taken to grow over the angle.
const FLAT: f64 = 1e-3;

/// Angle, rad, behind the border of the cut from which on nobody asks how far it is: no edge is spread so far.
const WITHIN: f64 = 0.3;

/// Chips that differ by no more than this, m, are told apart exactly: twice what the second order of the feed may be off.
const ALIKE: f64 = 2e-7;

/// What a tooth meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bite<S: Scalar = f64> {
    /// Length of the ray in material, m; meant only where `depth_rad` is above zero.
    pub thickness: S,
    /// How far the tooth is within the cut, as an angle, rad: negative outside. To first order; it
    /// spreads an entry or exit over an edge that lags within its disc.
    pub depth_rad: S,
    /// 1 where the tooth is nearest to its entry, −1 where to its exit.
    pub side: f64,
}

impl<S: Scalar> Bite<S> {
    /// The part of it behind a border of which teeth enter (1) or leave (−1), and `share` of what lies before it.
    #[inline]
    fn within(self, [own, sin]: [S; 2], [border, into]: [S; 2], side: f64, share: S) -> Self {
        let ahead = own * into - border;
        let across = (own * sin).value().abs().max(FLAT * own.value());
        let behind = match into.value() > 0.0 && border.value() > 0.0 {
            true => self.thickness.min(ahead / into),
            false => self.thickness,
        };
        let depth_rad = ahead / across;
        Self {
            thickness: behind + (self.thickness - behind) * share,
            side: match depth_rad.value() < self.depth_rad.value() {
                true => side,
                false => self.side,
            },
            depth_rad: self.depth_rad.min(depth_rad),
        }
    }
}

impl<S: Scalar> Steady<S> {
    /// What tooth `tooth` meets at tooth angle φ (`[sin φ, cos φ]`), all tips where they really are.
    /// An edge cuts while its tip is in the stock; what of its ray lies before the border is no chip.
    pub fn bite(&self, direction: [S; 2], tooth: usize, tips: &[Tip<S>]) -> Bite<S> {
        let Tip { radius: own, aside } = tips[tooth];
        let ray = turned(direction, aside);
        let [sin, cos] = ray;
        let feed = self.feed_per_radian * TAU / tips.len() as f64;
        let slope = feed * cos.value().abs().max(FLAT);
        let [thickness, of_a_pitch] = self.chip(ray, tooth, tips);
        let bite = Bite {
            thickness,
            depth_rad: of_a_pitch / slope.max(f64::MIN_POSITIVE),
            side: 1.0_f64.copysign(cos.value()),
        };
        let side = match self.stock {
            Stock::Right(_) => 1.0,
            _ => -1.0,
        };
        match self.stock.border(cos) {
            None => bite,
            Some(border) => bite.within([own, sin], border, side, self.before),
        }
    }

    /// How far the tip of a tooth stands behind the border of the stock, as an angle, rad: negative outside,
    /// infinite where there is none. No derivatives: what it is for is to pass over a tooth that meets nothing.
    #[inline]
    pub fn ahead(&self, direction: [f64; 2], tip: &Tip<S>) -> f64 {
        let [sin, cos] = turned(direction, tip.aside.value());
        let own = tip.radius.value();
        let (border, into) = match self.stock {
            Stock::Full => return f64::INFINITY,
            Stock::Left(y) => (y.value(), cos),
            Stock::Right(y) => (-y.value(), -cos),
        };
        (own * into - border) / (own * sin).abs().max(FLAT * own)
    }

    /// What of the ray lies before the surfaces that earlier teeth left, m: the least of it, and the least for each pitch since then, which
    /// grows alike for all of them on the way into the cut.
    #[inline]
    fn chip(&self, ray: [S; 2], tooth: usize, tips: &[Tip<S>]) -> [S; 2] {
        let (q, teeth) = (self.feed_per_radian, tips.len());
        let turn = |k: usize| TAU * k as f64 / teeth as f64;
        let plain = ray.map(Scalar::value);
        // which surfaces these may be is told without derivatives, to second order of the feed
        let own = tips[tooth];
        let over = 1.0 / own.radius.value();
        let rough = |k: usize| {
            let tip = &tips[(tooth + k) % teeth];
            let back = q * (tip.aside.value() - own.aside.value() + turn(k));
            let across = back * plain[1];
            let reach = tip.radius.value()
                - (back - q * across * over) * plain[0]
                - 0.5 * across * across * over;
            own.radius.value() - reach
        };
        let of = |k: usize| {
            let tip = tips[(tooth + k) % teeth];
            let left = left_by(q, ray, tip.aside - own.aside + turn(k), tip.radius);
            own.radius - left
        };
        if teeth == 1 {
            return [of(1); 2];
        }
        let mut least = [Least::UNTOLD; 2];
        for k in 1..=teeth {
            let chip = rough(k);
            least[0].hear(k, chip);
            least[1].hear(k, chip / k as f64);
        }
        let [whole, each] = least;
        let thickness = whole.told(teeth, |_| 1.0, rough, of);
        let slope = q * turn(1) * plain[1].abs().max(FLAT);
        if each.chip > WITHIN * slope {
            return [thickness; 2];
        }
        let per_pitch = match each.is_plain() && whole.is_plain() && each.k == whole.k {
            true => thickness / each.k as f64,
            false => each.told(teeth, |k| k as f64, rough, of),
        };
        [thickness, per_pitch]
    }
}

/// The least of some chips, told roughly.
#[derive(Debug, Clone, Copy)]
struct Least {
    /// Pitches since the surface that leaves it.
    k: usize,
    /// m.
    chip: f64,
    /// The next one, m.
    next: f64,
}

impl Least {
    const UNTOLD: Self = Self {
        k: 1,
        chip: f64::INFINITY,
        next: f64::INFINITY,
    };

    #[inline]
    fn hear(&mut self, k: usize, chip: f64) {
        if chip < self.chip {
            (self.next, self.chip, self.k) = (self.chip, chip, k);
        } else if chip < self.next {
            self.next = chip;
        }
    }

    /// Whether no other may be as small.
    fn is_plain(&self) -> bool {
        self.next > self.chip + ALIKE
    }

    /// Told exactly: of those that may be the least, divided each `by` its own.
    #[inline]
    fn told<S: Scalar>(
        &self,
        teeth: usize,
        by: impl Fn(usize) -> f64,
        rough: impl Fn(usize) -> f64,
        of: impl Fn(usize) -> S,
    ) -> S {
        if self.is_plain() {
            return of(self.k) / by(self.k);
        }
        let near = (1..=teeth).filter(|k| rough(*k) / by(*k) <= self.chip + ALIKE);
        let exact = near.map(|k| of(k) / by(k)).reduce(S::min);
        exact.unwrap_or_else(|| of(1))
    }
}

/// Distance along the ray to the surface that a tip left which the spindle's turn carried there by
/// `turn` (rad) earlier, m; `q` the feed per radian.
#[inline]
fn left_by<S: Scalar>(q: f64, [sin, cos]: [S; 2], turn: S, radius: S) -> S {
    let lean = radius + cos * q;
    let over = S::constant(1.0) / lean;
    let first = cos * turn * q * over;
    // R sin ε = q (turn - ε) cos φ; sin ε to third order, exact to ε⁵
    let angle = first + radius * over * first * first * first * (1.0 / 6.0);
    let behind = (turn - angle) * q;
    let square = angle * angle;
    let fall = square * 0.5 - square * square / 24.0;
    radius - radius * fall - behind * sin
}

/// A direction across the axis turned by a small angle, to second order.
#[inline]
pub(super) fn turned<S: Scalar>([sin, cos]: [S; 2], by: S) -> [S; 2] {
    let near = S::constant(1.0) - by * by * 0.5;
    [sin * near + cos * by, cos * near - sin * by]
}

#[cfg(test)]
mod tests;
