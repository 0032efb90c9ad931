//! The mains: what oscillates at its frequency came in by a cable.

/// Frequencies of the mains, Hz: most of the world; the Americas and parts of Asia.
pub const MAINS_HZ: [f64; 2] = [50.0, 60.0];
/// Harmonics of it that are sought: rectifiers make them.
pub const HARMONICS: [f64; 3] = [1.0, 2.0, 3.0];

/// Distance of a frequency from the nearest of these, Hz.
pub fn off_mains(hz: f64) -> f64 {
    let all = HARMONICS.iter().flat_map(|n| MAINS_HZ.map(|own| n * own));
    all.map(|own| (hz - own).abs())
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::off_mains;

    #[test]
    fn harmonics_of_either_mains_are_near() {
        assert!((off_mains(119.5) - 0.5).abs() < 1e-12 && (off_mains(151.0) - 1.0).abs() < 1e-12);
        assert_eq!(off_mains(250.0), 70.0);
    }
}
