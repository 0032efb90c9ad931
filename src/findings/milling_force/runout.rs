//! The tool runs out of centre.

use super::Case;
use super::coefficients::{member, moved};
use crate::experiments::milling_force::RUNOUT;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "runout",
    summary: "The tool turns about another axis than its own: its teeth take unequal chips.",
    mechanism: "teeth",
    places: |case| {
        if case.places().teeth < 2 {
            return Vec::new();
        }
        let part = |k: usize| {
            let mut direction = vec![0.0; case.places().len()];
            direction[RUNOUT + k] = 1e-6;
            direction
        };
        vec![Place::new("tool", vec![member(case, &[part(0), part(1)])])]
    },
    parameters: |case, blamed| {
        let sum = moved(case, blamed);
        let stated = case.cuts()[0].present.p;
        let [x, y] = [0, 1].map(|k| stated[RUNOUT + k] + sum[RUNOUT + k]);
        vec![
            ("runout", x.hypot(y), "m"),
            ("runout_angle", y.atan2(x), "rad"),
        ]
    },
    would_tell: "put a dial gauge on the shank, and look at the teeth",
};
