//! Elementary operators that several laws share.

use crate::ground::dual::Scalar;

/// Smooth saturation x/(1+|x|^p)^(1/p): slope 1 at zero, ±1 far away; p → ∞ is the sharp clip.
pub fn saturate<S: Scalar>(x: S, sharpness: f64) -> S {
    let a = x.value().abs();
    if a > 1e6 {
        return S::constant(x.value().signum());
    }
    let root = (1.0 + a.powf(sharpness)).powf(1.0 / sharpness);
    let value = x.value() / root;
    let slope = 1.0 / (root * (1.0 + a.powf(sharpness)));
    x.chain(value, slope)
}

/// The same with a sharpness that is sought too.
pub fn saturate_as<S: Scalar>(x: S, sharpness: S) -> S {
    let a = x.value().abs();
    if a < 1e-9 {
        return x;
    }
    let size = x.chain(a.ln(), 1.0 / x.value());
    let power = (sharpness * size).exp();
    x / (ln(power + 1.0) / sharpness).exp()
}

/// Odd power sign(x)|x|^p with constant p.
pub fn odd_power<S: Scalar>(x: S, exponent: S) -> S {
    let a = x.abs();
    if a.value() < 1e-12 {
        return S::constant(0.0);
    }
    let power = (exponent * ln(a)).exp();
    if x.value() < 0.0 { -power } else { power }
}

/// Natural logarithm.
pub fn ln<S: Scalar>(x: S) -> S {
    let v = x.value();
    x.chain(v.ln(), 1.0 / v)
}

/// Stop operator (Jenkins element): follows the increments of the input, held within ±`threshold`.
#[derive(Debug, Clone, Copy)]
pub struct Stop<S> {
    /// Present value.
    pub value: S,
}

impl<S: Scalar> Stop<S> {
    /// Virgin state.
    pub fn new() -> Self {
        Self {
            value: S::constant(0.0),
        }
    }

    /// Slipping state just after the input turned: full in the direction before its first motion.
    pub fn turned(input: &[f64], threshold: S) -> Self {
        let first = input
            .windows(2)
            .map(|w| w[1] - w[0])
            .find(|d| *d != 0.0)
            .unwrap_or(0.0);
        Self {
            value: threshold * -first.signum(),
        }
    }

    /// Moves the input by `step`. Duals are long: none is copied that stays.
    #[inline]
    pub fn advance(&mut self, step: f64, threshold: S) -> S {
        let (moved, limit) = (self.value.value() + step, threshold.value());
        if moved > limit {
            self.value = threshold;
        } else if moved < -limit {
            self.value = -threshold;
        } else if step != 0.0 {
            self.value = self.value + step;
        }
        self.value
    }
}

/// Linear interpolation of a history with derivative, shifted in time by `delay`: value at
/// t − delay, constant before the start and after the end.
pub fn delayed<S: Scalar>(time: &[f64], values: &[S], delay: S, out: &mut [S]) {
    let mut i = 0;
    let last = time.len() - 1;
    for (n, slot) in out.iter_mut().enumerate() {
        let at = time[n] - delay.value();
        while i < last && time[i + 1] < at {
            i += 1;
        }
        while i > 0 && time[i] > at {
            i -= 1;
        }
        *slot = sample(time, values, i, last, at, time[n], delay);
    }
}

fn sample<S: Scalar>(
    time: &[f64],
    v: &[S],
    i: usize,
    last: usize,
    at: f64,
    now: f64,
    delay: S,
) -> S {
    if at <= time[0] {
        return v[0];
    }
    if i >= last {
        return v[last];
    }
    let width = time[i + 1] - time[i];
    if width <= 0.0 {
        return v[i];
    }
    let share = (-delay + (now - time[i])) / width;
    v[i] + (v[i + 1] - v[i]) * share
}
