//! How exactly the force of every step was told: a display of five newtons rounds what it shows, in every
//! set-up at a level alike.

/// Smallest part of a newton that is looked at, N: displays show no more decimals.
const FINEST: f64 = 0.01;
/// A grid finer than this is none, N: it moves a robot of 10 N/µm by less than 2 nm.
const FINE: f64 = 0.05;
/// Forces that fill their grid to this share were commanded on it, not rounded to it: steps of a test are equal.
const FILLED: f64 = 0.4;
/// Fewer distinct forces than this lie on a common grid by choice: 100, 500 and 1000 N are no display of 100 N.
const FEWEST: usize = 8;
/// No display is coarser than this share of the largest force that is read from it.
const COARSEST: f64 = 0.02;

/// The grid on which forces (N) were told, N, if they were rounded to one.
pub fn grid(forces: impl Iterator<Item = f64>) -> Option<f64> {
    let mut parts: Vec<u64> = Vec::new();
    for force in forces {
        let part = force.abs() / FINEST;
        let whole = part.round();
        if (part - whole).abs() > 1e-6 * part.max(1.0) {
            return None;
        }
        parts.push(whole as u64);
    }
    parts.sort_unstable();
    parts.dedup();
    parts.retain(|part| *part > 0);
    let common = parts.iter().copied().fold(0, divisor);
    let last = *parts.last()?;
    let share = common as f64 / last as f64;
    let filled = parts.len() as f64 * share;
    let rounded = filled < FILLED && parts.len() >= FEWEST && share < COARSEST;
    let grid = common as f64 * FINEST;
    (rounded && grid > FINE).then_some(grid)
}

/// The sizes of force (N) that occur, ascending, none twice and not zero.
pub fn distinct(forces: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sizes: Vec<f64> = forces.map(f64::abs).filter(|size| *size > 0.0).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * *b);
    sizes
}

fn divisor(a: u64, b: u64) -> u64 {
    match b {
        0 => a,
        _ => divisor(b, a % b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_forces_are_told_from_commanded_ones() {
        let commanded = [0.0, 200.0, 400.0, -200.0, 600.0];
        assert_eq!(grid(commanded.into_iter()), None);
        let chosen = [0.0, 100.0, 500.0, 1000.0];
        assert_eq!(grid(chosen.into_iter()), None);
        let rounded = [0.0, 105.0, 215.0, 320.0, -110.0, 415.0, 525.0, 610.0, 705.0];
        assert_eq!(grid(rounded.into_iter()), Some(5.0));
        assert_eq!(grid(rounded.into_iter().take(5)), None);
        let exact = [0.0, 104.9931, 213.4452];
        assert_eq!(grid(exact.into_iter()), None);
    }
}
