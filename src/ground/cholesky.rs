//! Symmetric positive definite systems in place, without heap: A = L Lᵀ by rows.

/// Factorises the n×n matrix `a` (by rows; the lower triangle is read and replaced by L).
/// `false`: not positive definite, `a` is spoilt.
pub fn factor(a: &mut [f64], n: usize) -> bool {
    for i in 0..n {
        let (above, row) = a.split_at_mut(i * n);
        for j in 0..i {
            let known = &above[j * n..j * n + j];
            let sum: f64 = known.iter().zip(row.iter()).map(|(x, y)| x * y).sum();
            row[j] = (row[j] - sum) / above[j * n + j];
        }
        let rest = row[i] - row[..i].iter().map(|x| x * x).sum::<f64>();
        if rest.is_nan() || rest <= 0.0 {
            return false;
        }
        row[i] = rest.sqrt();
    }
    true
}

/// Solves L Lᵀ x = b in place.
pub fn solve(l: &[f64], n: usize, b: &mut [f64]) {
    forward(l, n, b);
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| l[k * n + i] * b[k]).sum();
        b[i] = (b[i] - sum) / l[i * n + i];
    }
}

/// Solves L y = b in place.
pub fn forward(l: &[f64], n: usize, b: &mut [f64]) {
    for i in 0..n {
        let sum: f64 = l[i * n..i * n + i]
            .iter()
            .zip(b.iter())
            .map(|(x, y)| x * y)
            .sum();
        b[i] = (b[i] - sum) / l[i * n + i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_and_refuses() {
        let mut a = [4.0, 2.0, 2.0, 3.0];
        assert!(factor(&mut a, 2));
        let mut b = [10.0, 8.0];
        solve(&a, 2, &mut b);
        assert!((b[0] - 1.75).abs() < 1e-15 && (b[1] - 1.5).abs() < 1e-15);
        assert!(!factor(&mut [1.0, 2.0, 2.0, 1.0], 2));
    }
}
