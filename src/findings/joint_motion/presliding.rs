//! Friction before it slides (Dahl 1968): it builds up over a little motion after every reversal, and rests hold it.

/// Friction along a way, −1 to 1, that builds up over this `reach` (unit of the way), from what holds at its begin.
pub(super) fn dahl(way: &[f64], reach: f64, begin: f64) -> Vec<f64> {
    let (mut held, mut before) = (begin, way[0]);
    let of = |at: &f64| {
        let moved = at - before;
        before = *at;
        // exact for motion in one direction: d(held)/d(way) = (1 − held · sign) / reach
        let slips = moved.signum();
        held = slips - (slips - held) * (-moved.abs() / reach.max(f64::MIN_POSITIVE)).exp();
        held
    };
    way.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::dahl;

    #[test]
    fn it_builds_up_rests_and_turns() {
        let way = [0.0, 1.0, 1.0, 40.0, 39.0, 0.0];
        let held = dahl(&way, 1.0, 0.0);
        let once = 1.0 - (-1.0_f64).exp();
        assert!((held[1] - once).abs() < 1e-12 && held[2] == held[1]);
        assert!((held[3] - 1.0).abs() < 1e-12 && (held[5] + 1.0).abs() < 1e-12);
        assert!((held[4] - (2.0 * (-1.0_f64).exp() - 1.0)).abs() < 1e-12);
    }
}
