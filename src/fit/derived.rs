//! What follows from a fitted joint: loss and the stiffnesses of one settled cycle at full load.

use super::observation::Observation;
use super::parameter::{Identified, Status, Z95};
use super::solution::Solution;
use crate::experiments::load_cycle::{Settled, settle, settled_cycle};
use crate::measurement::load_cycle::LoadCycle;
use nalgebra::DMatrix;

/// A quantity that follows from a settled cycle.
struct Derived {
    name: &'static str,
    unit: fn(&LoadCycle) -> &'static str,
    meaning: &'static str,
    read: fn(&Settled) -> f64,
    /// Whether there may be none of it.
    may_vanish: bool,
    /// Whether it is a slope at one load, which a curve that misses the readings tells of itself alone.
    is_slope: bool,
}

const DERIVED: &[Derived] = &[
    Derived {
        name: "hysteresis_loss",
        unit: |_| "J",
        meaning: "work lost in one settled cycle at full load",
        read: |s| s.loss,
        may_vanish: true,
        is_slope: false,
    },
    Derived {
        name: "loss_factor",
        unit: |_| "1",
        meaning: "loss per cycle over 2π times the energy stored at full load",
        read: |s| s.loss_factor,
        may_vanish: true,
        is_slope: false,
    },
    Derived {
        name: "secant_stiffness",
        unit: |f| f.port.stiffness_unit(),
        meaning: "load range over deflection range of a settled cycle at full load, lost motion included",
        read: |s| s.secant,
        may_vanish: false,
        is_slope: false,
    },
    Derived {
        name: "tangent_stiffness",
        unit: |f| f.port.stiffness_unit(),
        meaning: "slope at the end of loading, at full load",
        read: |s| s.tangent,
        may_vanish: false,
        is_slope: true,
    },
    Derived {
        name: "reversal_stiffness",
        unit: |f| f.port.stiffness_unit(),
        meaning: "slope right after the load turns",
        read: |s| s.reversal,
        may_vanish: false,
        is_slope: true,
    },
];

/// Everything that follows, with the uncertainty that the fit's parameters hand on. `fits`: whether the model is the curve
/// that was measured; no slope follows from another.
pub fn derived(
    solution: &Solution,
    data: &Observation,
    file: &LoadCycle,
    fits: bool,
) -> Vec<Identified> {
    let (low, high) = data.load_range();
    let at = |p: &[f64]| {
        let (load, deflection) = settled_cycle(&solution.model, p, &data.scene, low, high);
        settle(&load, &deflection)
    };
    let here = at(&solution.p);
    let fitted = Moved::new(solution, &solution.covariance, &at);
    let reaching = Moved::new(solution, &solution.reach, &at);
    let spring_known = solution.status[0] == Status::Identified;
    let site = file.site();
    let report = |d: &Derived| {
        let (value, stderr) = ((d.read)(&here), fitted.stderr(d.read));
        let parameter = Identified::new(d.name, &site, value, (d.unit)(file), stderr, d.meaning);
        let known =
            spring_known && stderr.is_finite() && value.is_finite() && (fits || !d.is_slope);
        match known {
            false => parameter.without_value(Status::NotIdentifiable),
            true if d.may_vanish && parameter.may_be_zero() => {
                let limit = value.max(0.0) + Z95 * reaching.stderr(d.read);
                parameter.limited(Status::NotIdentifiable, limit)
            }
            true => parameter,
        }
    };
    DERIVED.iter().map(report).collect()
}

/// The settled cycle with each parameter moved a little up and down.
struct Moved<'a> {
    covariance: &'a DMatrix<f64>,
    /// Above, below, and how far apart; `None` for a parameter that does not move.
    pairs: Vec<Option<(Settled, Settled, f64)>>,
}

impl<'a> Moved<'a> {
    fn new(
        solution: &Solution,
        covariance: &'a DMatrix<f64>,
        at: &dyn Fn(&[f64]) -> Settled,
    ) -> Self {
        let pair = |j: usize| {
            let (std, value) = (covariance[(j, j)].sqrt(), solution.p[j].abs());
            let small = match value > 0.0 {
                true => (0.1 * std).min(1e-3 * value).max(1e-9 * value),
                false => 0.1 * std,
            };
            if !std.is_finite() || std == 0.0 || small == 0.0 {
                return None;
            }
            let (mut up, mut down) = (solution.p.clone(), solution.p.clone());
            up[j] += small;
            // from zero there is only one way
            let below = if value > 0.0 { small } else { 0.0 };
            down[j] -= below;
            Some((at(&up), at(&down), small + below))
        };
        Self {
            covariance,
            pairs: (0..solution.p.len()).map(pair).collect(),
        }
    }

    /// Standard error of what is read off a settled cycle.
    fn stderr(&self, read: fn(&Settled) -> f64) -> f64 {
        let slope = |pair: &Option<(Settled, Settled, f64)>| {
            let pair = pair.as_ref();
            pair.map_or(0.0, |(up, down, apart)| (read(up) - read(down)) / apart)
        };
        let slopes: Vec<f64> = self.pairs.iter().map(slope).collect();
        let mut variance = 0.0;
        for (i, a) in slopes.iter().enumerate() {
            for (j, b) in slopes.iter().enumerate() {
                if *a != 0.0 && *b != 0.0 {
                    variance += a * self.covariance[(i, j)] * b;
                }
            }
        }
        variance.max(0.0).sqrt()
    }
}
