//! Instants at which a zero may have jumped.

/// Instants of an even grid.
const EVEN: usize = 10;
/// Sharpest instants of a residual that are tried besides.
const SHARPEST: usize = 3;
/// Share of the rows over which the means before and after an instant are compared.
const COMPARED: usize = 40;

/// Rows of an even grid, and those where the means of a residual before and after differ most.
pub fn jumps(residual: &[f64]) -> Vec<usize> {
    let (n, w) = (residual.len(), (residual.len() / COMPARED).max(4));
    let mut sums = vec![0.0];
    residual
        .iter()
        .for_each(|r| sums.push(sums[sums.len() - 1] + r));
    let jump = |i: usize| (sums[i + w] - 2.0 * sums[i] + sums[i - w]).abs();
    let mut order: Vec<usize> = (w..n - w).collect();
    order.sort_by(|a, b| jump(*b).total_cmp(&jump(*a)));
    let mut kept: Vec<usize> = Vec::new();
    for row in order {
        if kept.len() < SHARPEST && kept.iter().all(|k| k.abs_diff(row) > 2 * w) {
            kept.push(row);
        }
    }
    kept.extend((1..=EVEN).map(|k| n * k / (EVEN + 1)));
    kept
}
