//! Scalars that carry their derivatives, so that each law is written once.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// What a physical law may be written over: `f64`, or [`Dual`] for its derivatives.
pub trait Scalar:
    Copy
    + PartialOrd
    + std::fmt::Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// A constant: no derivative.
    fn constant(value: f64) -> Self;
    /// The value without its derivatives.
    fn value(self) -> f64;
    /// f(self), given f and f' at the value.
    fn chain(self, f: f64, slope: f64) -> Self;

    /// Sine.
    #[inline]
    fn sin(self) -> Self {
        let v = self.value();
        self.chain(v.sin(), v.cos())
    }
    /// Cosine.
    #[inline]
    fn cos(self) -> Self {
        let v = self.value();
        self.chain(v.cos(), -v.sin())
    }
    /// Sine and cosine at the price of one.
    #[inline]
    fn sin_cos(self) -> [Self; 2] {
        let (sin, cos) = self.value().sin_cos();
        [self.chain(sin, cos), self.chain(cos, -sin)]
    }
    /// Natural exponential.
    #[inline]
    fn exp(self) -> Self {
        let e = self.value().exp();
        self.chain(e, e)
    }
    /// Square root.
    #[inline]
    fn sqrt(self) -> Self {
        let r = self.value().sqrt();
        self.chain(r, 0.5 / r)
    }
    /// Absolute value; slope 0 at 0.
    #[inline]
    fn abs(self) -> Self {
        let v = self.value();
        self.chain(v.abs(), if v == 0.0 { 0.0 } else { v.signum() })
    }
    /// The larger of two.
    #[inline]
    fn max(self, other: Self) -> Self {
        if self.value() >= other.value() {
            self
        } else {
            other
        }
    }
    /// The smaller of two.
    #[inline]
    fn min(self, other: Self) -> Self {
        if self.value() <= other.value() {
            self
        } else {
            other
        }
    }
}

impl Scalar for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    #[inline]
    fn value(self) -> f64 {
        self
    }
    #[inline]
    fn chain(self, f: f64, _slope: f64) -> Self {
        f
    }
}

/// A value with its derivatives with respect to N parameters (forward mode).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub re: f64,
    /// Its derivatives.
    pub eps: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The i-th parameter itself: derivative 1 in place i.
    #[inline]
    pub fn variable(value: f64, i: usize) -> Self {
        let mut eps = [0.0; N];
        eps[i] = 1.0;
        Self { re: value, eps }
    }

    /// A loop: arrays mapped by closures are calls of functions where little is optimised.
    #[inline]
    fn zip(mut self, other: Self, re: f64, f: impl Fn(f64, f64) -> f64) -> Self {
        self.re = re;
        for i in 0..N {
            self.eps[i] = f(self.eps[i], other.eps[i]);
        }
        self
    }
}

impl<const N: usize> Scalar for Dual<N> {
    #[inline]
    fn constant(value: f64) -> Self {
        Self {
            re: value,
            eps: [0.0; N],
        }
    }
    #[inline]
    fn value(self) -> f64 {
        self.re
    }
    #[inline]
    fn chain(mut self, f: f64, slope: f64) -> Self {
        self.re = f;
        for e in &mut self.eps {
            *e *= slope;
        }
        self
    }
}

impl<const N: usize> PartialOrd for Dual<N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        self.re.partial_cmp(&other.re)
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        self.zip(o, self.re + o.re, |a, b| a + b)
    }
}
impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        self.zip(o, self.re - o.re, |a, b| a - b)
    }
}
#[allow(clippy::suspicious_arithmetic_impl)] // the product rule adds
impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        self.zip(o, self.re * o.re, |a, b| a * o.re + b * self.re)
    }
}
#[allow(clippy::suspicious_arithmetic_impl)] // the quotient rule subtracts
impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        let (q, over) = (self.re / o.re, 1.0 / o.re);
        self.zip(o, q, |a, b| (a - q * b) * over)
    }
}
impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.chain(-self.re, -1.0)
    }
}
impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn add(self, o: f64) -> Self {
        self.chain(self.re + o, 1.0)
    }
}
impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn sub(self, o: f64) -> Self {
        self.chain(self.re - o, 1.0)
    }
}
impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn mul(self, o: f64) -> Self {
        self.chain(self.re * o, o)
    }
}
impl<const N: usize> Div<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn div(self, o: f64) -> Self {
        self.chain(self.re / o, 1.0 / o)
    }
}
impl<const N: usize> AddAssign for Dual<N> {
    #[inline]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<const N: usize> SubAssign for Dual<N> {
    #[inline]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}
impl<const N: usize> MulAssign for Dual<N> {
    #[inline]
    fn mul_assign(&mut self, o: Self) {
        *self = *self * o;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_match_finite_differences() {
        fn law<S: Scalar>(x: S, y: S) -> S {
            (x * y).sin() / (y.exp() + 2.0) + (x * x + 1.0).sqrt() * y.cos() - x.abs()
        }
        let (x, y, h) = (0.7, -0.3, 1e-6);
        let d = law(Dual::<2>::variable(x, 0), Dual::<2>::variable(y, 1));
        let dx = (law(x + h, y) - law(x - h, y)) / (2.0 * h);
        let dy = (law(x, y + h) - law(x, y - h)) / (2.0 * h);
        assert!((d.eps[0] - dx).abs() < 1e-8 && (d.eps[1] - dy).abs() < 1e-8);
    }
}
