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
        let surface = self.surface(ray, tooth, tips);
        let feed = self.feed_per_radian * TAU / tips.len() as f64;
        let slope = feed * cos.value().abs().max(FLAT);
        let bite = Bite {
            thickness: own - surface,
            depth_rad: (own - surface) / slope.max(f64::MIN_POSITIVE),
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

    /// Distance along the ray to the surface that all earlier teeth left, m.
    #[inline]
    fn surface(&self, ray: [S; 2], tooth: usize, tips: &[Tip<S>]) -> S {
        let (q, teeth) = (self.feed_per_radian, tips.len());
        let turn = |k: usize| TAU * k as f64 / teeth as f64;
        let plain = ray.map(Scalar::value);
        // which tooth left the farthest surface is told without derivatives, to second order of the feed: where two
        // are as far to 0.1 um, either will do
        let over = 1.0 / tips[tooth].radius.value();
        let reach = |k: &usize| {
            let tip = &tips[(tooth + k) % teeth];
            let back = q * (tip.aside.value() - tips[tooth].aside.value() + turn(*k));
            let across = back * plain[1];
            tip.radius.value()
                - (back - q * across * over) * plain[0]
                - 0.5 * across * across * over
        };
        let farthest = (1..=teeth).map(|k| (k, if teeth > 1 { reach(&k) } else { 0.0 }));
        let last = |a: (usize, f64), b: (usize, f64)| if b.1 > a.1 { b } else { a };
        let k = farthest.reduce(last).map_or(1, |f| f.0);
        let tip = tips[(tooth + k) % teeth];
        left_by(q, ray, tip.aside - tips[tooth].aside + turn(k), tip.radius)
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
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const R: f64 = 8e-3;

    fn tips(radii: &[f64]) -> Vec<Tip> {
        let tip = |radius: &f64| Tip {
            radius: *radius,
            aside: 0.0,
        };
        radii.iter().map(tip).collect()
    }

    fn bite(steady: &Steady, phi: f64, radii: &[f64]) -> f64 {
        steady
            .bite([phi.sin(), phi.cos()], 0, &tips(radii))
            .thickness
    }

    /// The chip along the ray of a tip from the tool's own axis, every place straight from the motion.
    fn chip_of_a_shifted_axis(q: f64, runout: [f64; 2], teeth: usize, phi: f64) -> f64 {
        let place = |tooth: usize, turn: f64| {
            let at = phi + turn;
            let own = at + TAU * tooth as f64 / teeth as f64;
            let (ahead, aside) = (at, at + 0.5 * PI);
            let x = q * turn + R * own.sin() + runout[0] * ahead.sin() + runout[1] * aside.sin();
            let y = R * own.cos() + runout[0] * ahead.cos() + runout[1] * aside.cos();
            [x, y]
        };
        let ([sin, cos], own) = ([phi.sin(), phi.cos()], place(0, 0.0));
        let left = |tooth: usize| {
            let mut turn = -TAU * tooth as f64 / teeth as f64;
            for _ in 0..20 {
                let [x, y] = place(tooth, turn);
                turn -= ((x - own[0]) * cos - (y - own[1]) * sin) / R;
            }
            let [x, y] = place(tooth, turn);
            (own[0] - x) * sin + (own[1] - y) * cos
        };
        (1..teeth).map(left).fold(f64::MAX, f64::min)
    }

    #[test]
    fn runout_moves_tips_outwards_and_aside() {
        let (q, teeth, runout) = (0.1e-3 * 3.0 / TAU, 3, [9e-6, -14e-6]);
        let steady = Steady::<f64> {
            feed_per_radian: q,
            stock: Stock::Full,
            before: 0.0,
        };
        let tool = crate::cutting::Tool::square(R, teeth, 0.0);
        let disc = tool.discs(1e-3)[0];
        let tips: Vec<Tip> = (0..teeth).map(|j| tool.tip(&disc, j, runout)).collect();
        for phi in [0.4_f64, 1.1, 2.0, 2.7] {
            let exact = chip_of_a_shifted_axis(q, runout, teeth, phi);
            let found = steady.bite([phi.sin(), phi.cos()], 0, &tips).thickness;
            assert!((found - exact).abs() < 1e-8, "{phi}: {found} {exact}");
        }
    }

    #[test]
    fn a_slow_feed_leaves_the_first_order() {
        let c = 1e-6;
        let steady = Steady {
            feed_per_radian: c * 2.0 / TAU,
            stock: Stock::Full,
            before: 0.0,
        };
        for phi in [0.3, 1.2, 2.5] {
            let h = bite(&steady, phi, &[R, R]);
            assert!((h / (c * phi.sin()) - 1.0).abs() < 1e-3, "{h} at {phi}");
        }
    }

    #[test]
    fn a_tooth_stands_where_its_surface_is() {
        // the earlier tooth's position, straight from its trochoid, lies on the ray
        let (q, teeth, k, phi) = (0.1e-3, 3.0, 2.0, 0.9_f64);
        let rho = left_by(q, [phi.sin(), phi.cos()], TAU * k / teeth, R);
        let point = [rho * phi.sin(), rho * phi.cos()];
        let nearest = (0..2_000_000)
            .map(|i| {
                let eps = -0.1 + 1e-7 * f64::from(i);
                let x = -q * (TAU * k / teeth - eps) + R * (phi + eps).sin();
                (x - point[0]).hypot(R * (phi + eps).cos() - point[1])
            })
            .fold(f64::MAX, f64::min);
        assert!(nearest < 2e-9, "{nearest}");
    }

    #[test]
    fn a_higher_tooth_takes_what_the_lower_one_left() {
        let steady = Steady {
            feed_per_radian: 0.1e-3 * 2.0 / TAU,
            stock: Stock::Full,
            before: 0.0,
        };
        let radii = [R + 5e-6, R - 5e-6];
        let of = |tooth: usize| steady.bite([1.0, 0.0], tooth, &tips(&radii)).thickness;
        assert!((of(0) - 110e-6).abs() < 1e-9 && (of(1) - 90e-6).abs() < 1e-9);
        let deep = [R + 80e-6, R - 80e-6];
        assert!((steady.bite([1.0, 0.0], 0, &tips(&deep)).thickness - 200e-6).abs() < 1e-9);
        assert!(steady.bite([1.0, 0.0], 1, &tips(&deep)).thickness < 0.0);
    }

    #[test]
    fn stock_on_one_side_is_met_there_only() {
        let q = 0.1e-3 / TAU;
        let left = Steady {
            feed_per_radian: q,
            stock: Stock::Left(R - 2e-3),
            before: 0.0,
        };
        let right = Steady {
            stock: Stock::Right(-(R - 2e-3)),
            before: 0.0,
            ..left
        };
        let reach = (0.75_f64).acos();
        assert!(bite(&left, 0.5 * reach, &[R]) > 0.0 && bite(&left, 1.1 * reach, &[R]) < 0.0);
        assert!(bite(&right, PI - 0.5 * reach, &[R]) > 0.0);
        assert!(bite(&right, PI - 1.1 * reach, &[R]) < 0.0);
    }
}
