//! How well a simulated FRF meets a measured one.

use rustfft::num_complex::Complex64;

/// Two measures: one that sees shape, one that sees scale and damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrfMatch {
    /// Frequency response assurance criterion, 0 to 1; blind to scale and nearly so to damping.
    pub frac: f64,
    /// Mean absolute difference of the amplitudes, dB.
    pub log_error_db: f64,
}

/// `FRAC = |Σ Hm·Ha*|² / (Σ|Hm|²·Σ|Ha|²)` (Heylen and Lammens 1996) and the mean of
/// `|20·lg(|Ha|/|Hm|)|`, over the lines where both are numbers.
pub fn frf_match(measured: &[Complex64], simulated: &[Complex64]) -> FrfMatch {
    let pairs = measured.iter().zip(simulated);
    let known = pairs.filter(|(m, a)| m.is_finite() && a.is_finite());
    let known: Vec<(Complex64, Complex64)> = known.map(|(m, a)| (*m, *a)).collect();
    let cross: Complex64 = known.iter().map(|(m, a)| m * a.conj()).sum();
    let powers = known.iter().map(|(m, a)| (m.norm_sqr(), a.norm_sqr()));
    let (mm, aa) = powers.fold((0.0, 0.0), |sum, p| (sum.0 + p.0, sum.1 + p.1));
    let errors = known
        .iter()
        .map(|(m, a)| 20.0 * (a.norm() / m.norm()).log10().abs());
    FrfMatch {
        frac: cross.norm_sqr() / (mm * aa),
        log_error_db: errors.sum::<f64>() / known.len() as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frac_is_blind_to_scale_and_the_amplitude_is_not() {
        let h: Vec<Complex64> = (1..9).map(|k| Complex64::new(k as f64, -0.5)).collect();
        let tenfold: Vec<Complex64> = h.iter().map(|h| h * 10.0).collect();
        let found = frf_match(&h, &tenfold);
        assert!((found.frac - 1.0).abs() < 1e-12);
        assert!((found.log_error_db - 20.0).abs() < 1e-12);
    }
}
