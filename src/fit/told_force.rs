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
/// Steps that are a little unequal in one grid were rounded to it, from so many on: two forces are always near halves of
/// some grid.
const STEPS: usize = 3;
/// Errors of this arithmetic.
const CALCULATED: f64 = 1e-9;
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
    let rounded = filled < FILLED && parts.len() >= FEWEST || steps_rounded(&parts, common);
    let grid = common as f64 * FINEST;
    (rounded && share < COARSEST && grid > FINE).then_some(grid)
}

/// Whether these were equal steps before they were rounded to a grid: 265, 535 and 800 N are thirds of 800 to five.
fn steps_rounded(parts: &[u64], grid: u64) -> bool {
    let Some(last) = parts.last() else {
        return false;
    };
    // each step may be off by half a grid of its own, and by its share of half a grid of the last
    let off = |(i, part): (usize, &u64)| {
        let share = (i + 1) as f64 / parts.len() as f64;
        let may = 0.5 * grid as f64 * (1.0 + share);
        (*part as f64 - share * *last as f64).abs() / may
    };
    let most = parts.iter().enumerate().map(off).fold(0.0, f64::max);
    parts.len() >= STEPS && most > CALCULATED && most <= 1.0 + CALCULATED
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
        let thirds = [0.0, 265.0, 535.0, 800.0, -265.0];
        assert_eq!(grid(thirds.into_iter()), Some(5.0));
        let chosen = [0.0, 265.0, 600.0, 800.0];
        assert_eq!(grid(chosen.into_iter()), None);
        let exact = [0.0, 104.9931, 213.4452];
        assert_eq!(grid(exact.into_iter()), None);
    }
}
