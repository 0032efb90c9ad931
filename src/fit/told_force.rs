//! How exactly the force of every step was told: a display of five newtons rounds what it shows, in every
//! set-up at a level alike.

/// Smallest part of a newton that is looked at, N.
const FINEST: f64 = 0.01;
/// A grid finer than this is none, N.
const FINE: f64 = 0.05;
/// Forces that fill their grid to this share were commanded on it, not rounded to it.
const FILLED: f64 = 0.4;
/// More distinct forces than this were recorded, not told.
const MANY: usize = 5000;

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
    let filled = parts.len() as f64 * common as f64 / last as f64;
    let rounded = filled < FILLED && parts.len() < MANY;
    let grid = common as f64 * FINEST;
    (rounded && grid > FINE).then_some(grid)
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
        let rounded = [0.0, 105.0, 215.0, 320.0, -110.0, 415.0];
        assert_eq!(grid(rounded.into_iter()), Some(5.0));
        let exact = [0.0, 104.9931, 213.4452];
        assert_eq!(grid(exact.into_iter()), None);
    }
}
