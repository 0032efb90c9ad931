//! Causes whose readings follow no straight line, told by where they fit best together with all that is uncertain: the way that
//! the statement takes to them is a chord, which finds the cause and misses its size.

use super::diagnosis::Found;
use super::intervals::of_arrival;
use super::statement::{Blamed, CanBe, Experiment};
use crate::findings::answer::Cause;

/// A cause where it fits best.
pub struct Arrival {
    /// Itself, with its amounts and their covariance there.
    pub blamed: Blamed,
    /// Share of its own size by which its law may miss nature.
    pub law_error: f64,
    /// Whether it can be of a shape and amounts.
    pub can_be: CanBe,
    /// Rows that the noise is known by.
    pub rows: f64,
}

/// The same answer, parameters and intervals of what arrives anew.
pub(super) fn arrived(experiment: &dyn Experiment, mut found: Found) -> Found {
    if found.answer.causes.is_empty() {
        return found;
    }
    for arrival in experiment.arrived(&found.blamed) {
        let is_own =
            |c: &&mut Cause| c.effect == arrival.blamed.effect && c.site == arrival.blamed.site;
        if let Some(cause) = found.answer.causes.iter_mut().find(is_own) {
            cause.parameters = experiment.parameters(&arrival.blamed);
            cause.ci95 = of_arrival(experiment, &arrival);
        }
    }
    found
}
