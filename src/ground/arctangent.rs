//! Arc tangents for the innermost loop, without calls and branches, so that several run side by side:
//! the polynomial of fdlibm (Sun Microsystems 1993, `s_atan.c`) after a reduction to an eighth of π.
//! Within two units in the last place of π/4, and the same bits on every platform.

use std::f64::consts::PI;

/// π/4 in two parts: the first has 33 bits, so that small multiples of it are exact.
const QUARTER_PI: f64 = 0.785_398_163_367_062_8;
const QUARTER_PI_REST: f64 = 3.038_550_253_253_096e-11;
/// tan(π/8).
const EIGHTH: f64 = 0.414_213_562_373_095;

/// Angles (rad, in [−π, π]) of the directions (x, y); zero where both are zero.
#[inline(always)]
pub fn arctangents<const N: usize>(mut y: [f64; N], x: [f64; N]) -> [f64; N] {
    for (y, x) in y.iter_mut().zip(x) {
        *y = arctangent(*y, x);
    }
    y
}

/// Angle (rad, in [−π, π]) of the direction (x, y); zero where both are zero.
#[inline(always)]
pub fn arctangent(y: f64, x: f64) -> f64 {
    let (across, along) = (y.abs(), x.abs());
    let steep = across > along;
    let (low, high) = if steep {
        (along, across)
    } else {
        (across, along)
    };
    let wide = low > EIGHTH * high;
    let rise = if wide { low - high } else { low };
    let run = if wide { low + high } else { high };
    let ratio = rise / if run == 0.0 { 1.0 } else { run };
    let small = kernel(ratio);
    let n = if wide { 1.0 } else { 0.0 };
    let (n, small) = if steep { (2.0 - n, -small) } else { (n, small) };
    let (n, small) = if x < 0.0 {
        (4.0 - n, -small)
    } else {
        (n, small)
    };
    (n * QUARTER_PI + (n * QUARTER_PI_REST + small)).copysign(y)
}

/// The whole turns (as a number) that are nearest to an angle over 2π: half a turn more or less is all
/// that is left. For angles below 1e15 rad.
#[inline(always)]
pub fn whole_turns(angle: f64) -> f64 {
    /// Adding and taking away 1.5·2⁵² rounds to the nearest integer.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    angle * (0.5 / PI) + ROUND - ROUND
}

/// atan t for |t| ≤ 7/16.
#[inline(always)]
fn kernel(t: f64) -> f64 {
    const A: [f64; 11] = [
        3.333_333_333_333_293e-1,
        -1.999_999_999_987_648_3e-1,
        1.428_571_427_250_346_6e-1,
        -1.111_111_040_546_235_6e-1,
        9.090_887_133_436_507e-2,
        -7.691_876_205_044_83e-2,
        6.661_073_137_387_531e-2,
        -5.833_570_133_790_573_5e-2,
        4.976_877_994_615_932e-2,
        -3.653_157_274_421_691_6e-2,
        1.628_582_011_536_578_2e-2,
    ];
    let z = t * t;
    let w = z * z;
    let even = A[0] + w * (A[2] + w * (A[4] + w * (A[6] + w * (A[8] + w * A[10]))));
    let odd = A[1] + w * (A[3] + w * (A[5] + w * (A[7] + w * A[9])));
    t - t * (z * even + w * odd)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    #[test]
    fn agrees_with_the_library() {
        let mut random = Random::new(7);
        let mut draw = |k: usize| random.uniform(-1.0, 1.0) * [1.0, 1e-3, 1e3, 1e-12][k % 4];
        for k in 0..1_000_000 {
            let (y, x) = (draw(k / 4), draw(k));
            let wanted = y.atan2(x);
            assert!((arctangent(y, x) - wanted).abs() <= 9e-16, "{y} {x}");
            assert!((arctangent(y, x.abs()) / y.atan2(x.abs()) - 1.0).abs() < 1e-15);
        }
        for (y, x) in [
            (0.0, 0.0),
            (0.0, 1.0),
            (0.0, -1.0),
            (-0.0, -1.0),
            (1.0, 0.0),
            (-3.0, 0.0),
            (2.0, -2.0),
        ] {
            assert_eq!(arctangent(y, x), f64::atan2(y, x), "{y} {x}");
        }
        assert!(arctangent(f64::NAN, 1.0).is_nan() && arctangent(1.0, f64::NAN).is_nan());
    }

    #[test]
    fn turns_are_whole_and_leave_half_a_turn() {
        let mut random = Random::new(9);
        for _ in 0..100_000 {
            let angle = random.uniform(-50.0, 50.0);
            let turns = whole_turns(angle);
            assert_eq!(turns, turns.trunc());
            assert!((angle - 2.0 * PI * turns).abs() <= PI + 1e-13);
        }
    }
}
