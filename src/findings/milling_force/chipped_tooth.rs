//! One tooth is shorter than the others along its edge: it takes less, the next one more.

use super::Case;
use super::coefficients::{far, moved};
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "chipped_tooth",
    summary: "One tooth is shorter than the others: it takes less of the chip, the next one more.",
    mechanism: "teeth",
    places: |case| {
        let teeth = case.places().teeth;
        if teeth < 2 {
            return Vec::new();
        }
        let one = |tooth: usize| {
            let mut direction = vec![0.0; case.places().len()];
            direction[case.places().shorter(tooth)] = 1e-6;
            far(case, &direction, MOST, &[]).positive()
        };
        vec![Place::new("tool", (0..teeth).map(one).collect())]
    },
    parameters: |case, blamed| {
        let sum = moved(case, blamed);
        let places = case.places();
        let own = (0..places.teeth).map(|j| (j, sum[places.shorter(j)]));
        own.filter(|(_, by)| *by != 0.0)
            .flat_map(|(j, by)| [("tooth", (j + 1) as f64, "1"), ("shorter_by", by, "m")])
            .collect()
    },
    would_tell: "look at the teeth, and put a dial gauge on the shank",
};

/// No chip is longer, µm.
const MOST: f64 = 200.0;
