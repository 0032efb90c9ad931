//! What is not known of levers widens what a fit says.

use super::Fixed;
use crate::ground::stats::Z95;
use crate::measurement::leading::front_of;
use crate::measurement::load_cycle::{LEVER_REL_STD, lever_spread};
use std::path::Path;

/// Relative standard deviation by the levers of a measurement; the usual one if it is not there.
pub(super) fn levers(measurement: &Path) -> f64 {
    let front = front_of(measurement).ok();
    let stated = front.and_then(|front| lever_spread(&front).ok());
    stated.unwrap_or(LEVER_REL_STD * std::f64::consts::SQRT_2)
}

/// A value with standard error and interval, with an independent relative error added.
pub(super) fn widened((value, stderr, [low, high]): Fixed, relative: f64) -> Fixed {
    let more = value * relative;
    let half = |own: f64| own.hypot(Z95 * more);
    let ci95 = [value - half(value - low), value + half(high - value)];
    (value, stderr.hypot(more), ci95)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levers_widen_what_the_fit_says() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("axis6.csv");
        let spread = |facts: &str| {
            let head = "# kind = \"load-cycle\"\n# lever_rel_std = 0.03\n";
            std::fs::write(&path, format!("{head}{facts}time_s,force_N\n")).unwrap();
            levers(&path)
        };
        let both = spread("# load_lever_m = 0.6\n# sensor_lever_m = 0.5\n");
        assert!((both - 0.03 * 2.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(spread("# sensor_lever_m = 0.5\n"), 0.03);
        assert_eq!(spread(""), 0.0);
        assert!(levers(&folder.path().join("gone.csv")) > LEVER_REL_STD);
        let (value, stderr, ci95) = widened((2e5, 3e3, [1.9e5, 2.1e5]), 0.02);
        assert_eq!((value, stderr), (2e5, 5e3));
        assert!(ci95[0] < 1.9e5 && (ci95[0] + ci95[1] - 4e5).abs() < 1e-6);
    }
}
