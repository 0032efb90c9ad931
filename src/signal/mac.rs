//! How alike mode shapes are.

use rustfft::num_complex::Complex64;

/// Modal assurance criterion `|aᴴb|²/(aᴴa·bᴴb)`: 1 for shapes that differ by a factor, 0 for such that have
/// nothing in common (Allemang and Brown, A correlation coefficient for modal vector analysis, IMAC 1982;
/// Allemang, The modal assurance criterion - twenty years of use and abuse, Sound and Vibration 2003).
/// Not a number where a shape is zero.
pub fn mac(a: &[Complex64], b: &[Complex64]) -> f64 {
    let product = |a: &[Complex64], b: &[Complex64]| -> Complex64 {
        a.iter().zip(b).map(|(a, b)| a.conj() * b).sum()
    };
    product(a, b).norm_sqr() / (product(a, a).re * product(b, b).re)
}

/// [`mac`] of every one of `rows` with every one of `columns`.
pub fn matrix(rows: &[Vec<Complex64>], columns: &[Vec<Complex64>]) -> Vec<Vec<f64>> {
    let row = |a: &Vec<Complex64>| columns.iter().map(|b| mac(a, b)).collect();
    rows.iter().map(row).collect()
}

/// How far the parts of a shape move in step: 1 on one line through zero, less where they pass their ends
/// one after the other (modal phase collinearity; Pappa, Elliott and Schenk, Consistent-mode indicator for
/// the eigensystem realization algorithm, 1993): the assurance of a shape with its own conjugate.
pub fn phase_collinearity(shape: &[Complex64]) -> f64 {
    let back: Vec<Complex64> = shape.iter().map(Complex64::conj).collect();
    mac(shape, &back)
}

/// The shape turned so that its parts lie as near to the real line as they can, the largest at 1.
pub fn upright(shape: &[Complex64]) -> Vec<Complex64> {
    let square: Complex64 = shape.iter().map(|v| v * v).sum();
    let turn = Complex64::from_polar(1.0, -0.5 * square.arg());
    let turned: Vec<Complex64> = shape.iter().map(|v| v * turn).collect();
    let largest = turned.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let by = largest.map_or(1.0, |v| v.re.signum() * v.norm());
    match by.is_finite() && by != 0.0 {
        true => turned.iter().map(|v| v / by).collect(),
        false => turned,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const I: Complex64 = Complex64::new(0.0, 1.0);

    fn real(values: &[f64]) -> Vec<Complex64> {
        values.iter().map(|v| Complex64::from(*v)).collect()
    }

    #[test]
    fn a_factor_changes_nothing_and_what_is_across_has_nothing_in_common() {
        let a = real(&[1.0, 2.0, -1.0]);
        let b: Vec<Complex64> = a.iter().map(|v| v * (0.3 - 2.0 * I)).collect();
        assert!((mac(&a, &b) - 1.0).abs() < 1e-12);
        assert!(mac(&a, &real(&[2.0, -1.0, 0.0])) < 1e-12);
        assert!(mac(&a, &real(&[0.0; 3])).is_nan());
        // By hand: (1·1 + 2·1)² / (6 · 2) = 9/12.
        assert!((mac(&a, &real(&[1.0, 1.0, 0.0])) - 0.75).abs() < 1e-12);
    }

    #[test]
    fn standing_and_travelling_shapes() {
        let standing: Vec<Complex64> = real(&[1.0, -0.5, 0.2])
            .iter()
            .map(|v| v * (1.0 + I))
            .collect();
        assert!((phase_collinearity(&standing) - 1.0).abs() < 1e-12);
        let travelling = [Complex64::from(1.0), I, Complex64::from(-1.0), -I];
        assert!(phase_collinearity(&travelling) < 1e-12);
        let turned = upright(&standing);
        assert!((turned[0] - 1.0).norm() < 1e-12 && (turned[1] + 0.5).norm() < 1e-12);
    }
}
