//! A gap that does not lie at zero load: the law of a gap about zero would give a wrong size, and the spring beside it the rest.

use super::comparison::{nats, price};
use super::observation::Observation;
use super::parameter::Status;
use super::solution::{Solution, fit_from};
use crate::effects::{Composite, Effect, OFFSET_GAP};
use crate::signal::smooth::noise;

/// The law of a gap about zero load.
const CENTRED: &str = "backlash";
/// Loads at which a gap is sought, of the largest.
const PLACES: [f64; 4] = [-0.2, -0.06, 0.06, 0.2];
/// Sharpness of the contact from which it is sought: that of the law about zero.
const EDGE: f64 = 2.0;
/// Parameters that it has more.
const MORE: f64 = 2.0;

/// What a model leaves, over the scatter of neighbours, above which a gap elsewhere is sought where there is none about zero,
/// and below which it must bring it.
const LEFT: f64 = 1.12;
/// Share of the larger load that the smaller must reach for a load to count as two-sided: a gap is seen where it is crossed.
const OTHER_SIDE: f64 = 0.2;

/// The fit with the gap at any load and its contact of any sharpness in place of the one about zero, where the readings demand
/// it: the likelihood grows by more than half the logarithm of the rows for each parameter (Schwarz 1978). Where there is no
/// gap about zero, nothing may be left beside the other.
pub fn off_centre(centred: &Solution, data: &Observation) -> Option<Solution> {
    let slots = centred.model.slots();
    let gap = slots
        .iter()
        .position(|s| s.amplitude && s.effect.card().name == CENTRED)?;
    let (low, high) = data.load_range();
    let is_there = centred.status[gap] == Status::Identified;
    let is_left = |s: &Solution| s.rms > LEFT * noise(&s.residual);
    if high.min(-low) < OTHER_SIDE * high.max(-low) || !is_there && !is_left(centred) {
        return None;
    }
    let others = centred.model.effects().iter().copied();
    let kept: Vec<&'static dyn Effect> = others
        .filter(|e| e.card().name != CENTRED)
        .chain([OFFSET_GAP])
        .collect();
    let model = Composite::new(&kept);
    let start = |place: f64| -> Vec<f64> {
        let value = |name: &str, own: &str| {
            let found = slots
                .iter()
                .position(|s| s.effect.card().name == own && s.parameter.name == name);
            found.map(|j| centred.p[j])
        };
        let least = 0.5 * OFFSET_GAP.card().parameters[0].grid[0] * data.scene.deflection_scale;
        let each = model.slots().into_iter().map(|slot| {
            let own = slot.effect.card().name;
            let (is_gap, name) = (own == OFFSET_GAP.card().name, slot.parameter.name);
            let own = if is_gap { CENTRED } else { own };
            let before = value(name, own).unwrap_or(match name {
                "centre" => place * data.scene.load_scale,
                _ => EDGE,
            });
            match is_gap && slot.amplitude {
                true => before.max(least),
                false => before,
            }
        });
        each.collect()
    };
    let starts: Vec<Vec<f64>> = PLACES.iter().map(|place| start(*place)).collect();
    let found = fit_from(&model, data, &starts, &vec![false; data.rows()]);
    let gained = nats(&centred.colour, &found.colour);
    let is_worth_it = gained > price(MORE, data.rows());
    (is_worth_it && (is_there || !is_left(&found))).then_some(found)
}
