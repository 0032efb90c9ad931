//! Random errors that follow from the coherence.

/// Normalised random error of `|H1|`, and of its phase in rad: `√((1−γ²)/(2 n γ²))` over `n` hits
/// (Bendat and Piersol 2010, eq. 9.90). Not a number below two hits.
pub fn random_error(coherence: f64, hits: usize) -> f64 {
    if hits < 2 {
        return f64::NAN;
    }
    ((1.0 - coherence).max(0.0) / (2.0 * hits as f64 * coherence)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_at_simple_points() {
        assert!((random_error(0.5, 2) - 0.5).abs() < 1e-12);
        assert!(random_error(0.9, 1).is_nan());
    }
}
