//! What an instrument of one mode passes: in general, and as the second-order low pass of Butterworth (1930).

use rustfft::num_complex::Complex64;

/// Response at `frequency` of one mode at `natural` (same unit) with a damping ratio: 1 / (1 + 2Ds + s²), s = jf/f₀.
pub fn second_order(frequency: f64, natural: f64, damping: f64) -> Complex64 {
    let x = frequency / natural;
    Complex64::new(1.0 - x * x, 2.0 * damping * x).inv()
}

/// Response at `frequency` to a corner at `corner` (same unit): 1 / (1 + √2 s + s²), s = jf/f₀.
pub fn butterworth2(frequency: f64, corner: f64) -> Complex64 {
    second_order(frequency, corner, std::f64::consts::FRAC_1_SQRT_2)
}

/// Derivative of [`butterworth2`] over the logarithm of the corner.
pub fn butterworth2_slope(frequency: f64, corner: f64) -> Complex64 {
    let x = frequency / corner;
    let h = butterworth2(frequency, corner);
    let denominator = Complex64::new(-2.0 * x * x, std::f64::consts::SQRT_2 * x);
    h * h * denominator
}

/// Time, s, after which what was before has decayed below 1e-4 behind a corner of `corner` Hz.
pub fn settling_s(corner: f64) -> f64 {
    let rate = std::f64::consts::TAU * corner * std::f64::consts::FRAC_1_SQRT_2;
    9.2 / rate
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_decibels_at_the_corner_and_the_slope_of_the_logarithm() {
        assert!((butterworth2(800.0, 800.0).norm() - 0.5_f64.sqrt()).abs() < 1e-12);
        let h = 1e-6;
        let numeric = (butterworth2(500.0, 800.0 * (1.0 + h))
            - butterworth2(500.0, 800.0 * (1.0 - h)))
            / (2.0 * h);
        assert!((numeric - butterworth2_slope(500.0, 800.0)).norm() < 1e-8);
    }
}
