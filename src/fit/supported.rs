//! The largest part of a model that the readings support.

use super::observation::Observation;
use super::parameter::{Identified, Status};
use super::solution::{Solution, fit, unit_of};
use crate::effects::{Composite, Effect};
use crate::measurement::load_cycle::Port;

/// A simpler model may leave so much more than the one asked for: a third of a deviation beside it.
const WORSE: f64 = 1.05;

/// The fit of the spring beside one of the model's effects, else alone: the first whose spring is fixed; `None` where it
/// never is, or not without leaving more.
pub fn simpler(fitted: &Solution, data: &Observation) -> Option<Solution> {
    let own: Vec<&'static dyn Effect> = fitted.model.effects()[1..].to_vec();
    let less = |kept: Vec<&'static dyn Effect>| fit(&Composite::new(&kept), data);
    let single = own.iter().map(|effect| vec![*effect]);
    let all = single.filter(|kept| kept.len() < own.len()).chain([vec![]]);
    let holds = |s: &Solution| s.status[0] == Status::Identified && s.rms <= WORSE * fitted.rms;
    all.map(less).find(holds)
}

/// The parameters of a model that are not in a simpler one: nothing is said of them.
pub fn unsaid(model: &Composite, simpler: &Composite, site: &str, port: Port) -> Vec<Identified> {
    let gone = |effect: &&'static dyn Effect| {
        let cause = effect.card().cause;
        simpler.effects().iter().all(|e| e.card().cause != cause)
    };
    let gone = model.effects().iter().copied().filter(gone);
    gone.flat_map(|effect| effect.card().parameters)
        .map(|p| {
            let unit = unit_of(p.scale, port);
            Identified::new(p.name, site, 0.0, unit, f64::INFINITY, p.meaning)
                .without_value(Status::NotIdentifiable)
        })
        .collect()
}
