//! What happens over time whatever the load does: drifts and jumps, zero at the start.

use super::{Family, Shapes, View};
use std::f64::consts::{PI, TAU};

/// Smooth drift.
pub const THERMAL_DRIFT: Family = Family {
    cause: "thermal_drift",
    mechanism: "time",
    suits: |_| true,
    members: drift,
};

/// A jump at a free place, or a few.
pub const SLIP: Family = Family {
    cause: "slip",
    mechanism: "time",
    suits: |_| true,
    members: slip,
};

fn drift(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    shapes.one(view, &view.t);
    shapes.one(view, &view.over_time(f64::sqrt));
    for tau in [0.05, 0.1, 0.2, 0.4, 0.8] {
        shapes.one(view, &view.over_time(|t| 1.0 - (-t / tau).exp()));
    }
    for orders in [3, 6] {
        let order = |k: usize| {
            let k = k as f64;
            view.over_time(|t| ((PI * k * t).cos() - 1.0) * k.powf(-1.5))
        };
        let orders: Vec<Vec<f64>> = (1..=orders).map(order).collect();
        shapes.free(view, &orders);
        // cosines are level at both ends: what goes on changing there needs a slope at either
        let slopes = [view.t.clone(), view.over_time(|t| t * t)].into_iter();
        shapes.free(view, &slopes.chain(orders).collect::<Vec<_>>());
    }
    // a room and a machine that warm up at two speeds: what rises may fall again
    for pair in [[0.1, 0.5], [0.1, 1.5], [0.2, 0.7], [0.2, 1.5], [0.3, 1.0]] {
        let warmed = |tau: f64| view.over_time(|t| 1.0 - (-t / tau).exp());
        shapes.free(view, &pair.map(warmed));
    }
    for periods in [0.5, 0.75, 1.0, 1.4] {
        let waves = [
            view.over_time(|t| (TAU * periods * t).sin()),
            view.over_time(|t| 1.0 - (TAU * periods * t).cos()),
        ];
        shapes.free(view, &waves);
    }
    shapes
}

/// Most places at which a jump is sought.
const PLACES: usize = 140;

fn slip(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    let n = view.rows();
    let places = PLACES.min(n.saturating_sub(6));
    for k in 0..places {
        shapes.one(view, &view.since(3 + k * (n - 6) / places.max(1)));
    }
    for at in &view.jumps.rows {
        shapes.one(view, &view.since(*at));
    }
    if let Some(twice) = view.jumps.twice {
        shapes.free(view, &twice.map(|at| view.since(at)));
    }
    let all = &view.jumps.counted;
    if all.len() > 1 && view.jumps.is_few() {
        let each = all.iter().map(|jump| view.since(jump.row));
        shapes.free(view, &each.collect::<Vec<_>>());
    }
    shapes
}
