//! Sine and cosine together, for the innermost loop: the kernels of fdlibm (Sun Microsystems 1993,
//! `k_sin.c`, `k_cos.c`) after one Cody–Waite reduction. Under one unit in the last place up to
//! 1e5 rad, and the same bits on every platform.

use std::f64::consts::FRAC_2_PI;

/// π/2 in two parts: the first has 33 bits, so that small multiples of it are exact.
const HALF_PI: f64 = 1.570_796_326_734_125_6;
const HALF_PI_REST: f64 = 6.077_100_506_506_192e-11;
/// Adding and taking away 1.5·2⁵² rounds to the nearest integer, whose bits stand at the end.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// (sin x, cos x), x in rad.
#[inline(always)]
pub fn sine_cosine(x: f64) -> (f64, f64) {
    if x.is_nan() || x.abs() > 1e5 {
        return x.sin_cos();
    }
    reduced(x)
}

/// [`sine_cosine`] of many angles: without calls and branches, so that several run side by side.
#[inline]
pub fn sines_cosines(angles: impl Iterator<Item = f64> + Clone, out: &mut [(f64, f64)]) {
    let small = angles
        .clone()
        .fold(true, |small, x| small & (x.abs() <= 1e5));
    if small {
        out.iter_mut()
            .zip(angles)
            .for_each(|(out, x)| *out = reduced(x));
    } else {
        out.iter_mut()
            .zip(angles)
            .for_each(|(out, x)| *out = sine_cosine(x));
    }
}

#[inline(always)]
fn reduced(x: f64) -> (f64, f64) {
    let shifted = x * FRAC_2_PI + ROUND;
    let turns = shifted - ROUND;
    let (near, rest) = (x - turns * HALF_PI, turns * HALF_PI_REST);
    let y = near - rest;
    let tail = (near - y) - rest;
    let (sin, cos) = (
        kernel_sine(y, tail).to_bits(),
        kernel_cosine(y, tail).to_bits(),
    );
    let quadrant = shifted.to_bits();
    let swap = (sin ^ cos) & (quadrant & 1).wrapping_neg();
    let sign = |bit: u64| (bit & 2) << 62;
    let (sin, cos) = (
        sin ^ swap ^ sign(quadrant),
        cos ^ swap ^ sign(quadrant.wrapping_add(1)),
    );
    (f64::from_bits(sin), f64::from_bits(cos))
}

/// sin(x + tail) for |x| ≤ π/4.
#[inline(always)]
fn kernel_sine(x: f64, tail: f64) -> f64 {
    const S: [f64; 6] = [
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    let z = x * x;
    let r = S[1] + z * (S[2] + z * (S[3] + z * (S[4] + z * S[5])));
    let v = z * x;
    x - ((z * (0.5 * tail - v * r) - tail) - v * S[0])
}

/// cos(x + tail) for |x| ≤ π/4.
#[inline(always)]
fn kernel_cosine(x: f64, tail: f64) -> f64 {
    const C: [f64; 6] = [
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];
    let z = x * x;
    let r = z * (C[0] + z * (C[1] + z * (C[2] + z * (C[3] + z * (C[4] + z * C[5])))));
    let half = 0.5 * z;
    let w = 1.0 - half;
    w + (((1.0 - w) - half) + (z * r - x * tail))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    #[test]
    fn agrees_with_the_library_to_the_last_digit() {
        let mut random = Random::new(5);
        let edges = [
            0.0,
            -0.0,
            1e-300,
            std::f64::consts::FRAC_PI_2,
            std::f64::consts::PI,
            -7.5 * std::f64::consts::PI,
        ];
        let draws = (0..1_000_000).map(|i| random.uniform(-1.0, 1.0) * [0.8, 7.0, 1e4][i % 3]);
        for x in edges.into_iter().chain(draws) {
            let ((s, c), (sin, cos)) = (sine_cosine(x), x.sin_cos());
            assert!(
                (s - sin).abs() <= 2.3e-16 && (c - cos).abs() <= 2.3e-16,
                "{x}"
            );
            assert!(
                (s - sin).abs() <= 1e-9 * sin.abs() && (c - cos).abs() <= 1e-9 * cos.abs(),
                "{x}"
            );
        }
        assert!(sine_cosine(f64::INFINITY).0.is_nan() && sine_cosine(f64::NAN).1.is_nan());
        assert_eq!(sine_cosine(1e6), 1e6_f64.sin_cos());
    }
}
