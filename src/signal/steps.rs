//! Changes of level: where what comes after an instant does not go on as what came before.

/// Share of the rows that must stand still, and of the way that must be made in jumps, for dead weights.
const STANDS: f64 = 0.5;
/// A row to row change of a course that is a jump, of its largest value.
const JUMP: f64 = 0.04;
/// Rows on either side of an instant that are compared, as a share of all ...
const SHARE: usize = 60;
/// ... and at least.
const LEAST: usize = 4;

/// Rows on either side of an instant that are compared.
pub fn window(rows: usize) -> usize {
    (rows / SHARE).max(LEAST)
}

/// The change of level before every row, beside one slope on both sides: least squares over the rows about it. Zero where
/// there are too few.
pub fn steps(values: &[f64]) -> Vec<f64> {
    let (n, w) = (values.len(), window(values.len()));
    let wide = w as f64;
    let squares = wide * (wide * wide - 1.0) / 6.0;
    // a mean on either side, less what their common slope makes of the distance between them
    let weight = |j: usize| {
        let (sign, at) = match j < w {
            true => (-1.0, j),
            false => (1.0, j - w),
        };
        sign / wide - wide * (at as f64 - 0.5 * (wide - 1.0)) / squares
    };
    let weights: Vec<f64> = (0..2 * w).map(weight).collect();
    let at = |i: usize| match (w..(n + 1).saturating_sub(w)).contains(&i) {
        true => {
            let each = weights.iter().zip(&values[i - w..i + w]);
            each.map(|(a, b)| a * b).sum()
        }
        false => 0.0,
    };
    (0..n).map(at).collect()
}

/// The rows of the largest changes of level, largest first, none within the window of another.
pub fn sharpest(steps: &[f64], count: usize) -> Vec<usize> {
    let apart = window(steps.len());
    let mut order: Vec<usize> = (0..steps.len()).filter(|i| steps[*i] != 0.0).collect();
    order.sort_by(|a, b| steps[*b].abs().total_cmp(&steps[*a].abs()));
    let mut kept: Vec<usize> = Vec::new();
    for row in order {
        if kept.len() == count {
            break;
        }
        if kept.iter().all(|k| k.abs_diff(row) > apart) {
            kept.push(row);
        }
    }
    kept
}

/// Whether most rows stand still, and a course that is one at its largest moves in jumps.
pub fn goes_in_steps(u: &[f64]) -> bool {
    let steps: Vec<f64> = u.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
    let way: f64 = steps.iter().sum();
    let still = steps.iter().filter(|s| **s < 0.1 * JUMP).count();
    let jumps: f64 = steps.iter().filter(|s| **s > JUMP).sum();
    let busy = still as f64 > STANDS * steps.len() as f64;
    busy && jumps > STANDS * way
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_is_found_and_a_slope_is_none() {
        let values: Vec<f64> = (0..300)
            .map(|i| 0.01 * f64::from(i) + if i >= 120 { 2.0 } else { 0.0 })
            .collect();
        let steps = steps(&values);
        assert!((steps[120] - 2.0).abs() < 1e-9);
        assert!(steps[40].abs() < 1e-9);
        assert_eq!(sharpest(&steps, 1), [120]);
        assert!(super::steps(&[1.0; 5]).iter().all(|s| *s == 0.0));
    }
}
