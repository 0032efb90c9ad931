//! What friction held before the record, which nobody knows: the first branch of a loop lies anywhere between those of all
//! that its contacts can hold, and is no zero that jumps.

use super::joint::Joint;
use super::{coulomb_friction, hysteresis};
use crate::findings::engine::{Blamed, Nuisance};

impl Joint {
    /// Of every friction that was found, up to all that it can hold of either sign.
    pub(super) fn begun(&self, about: &[Blamed]) -> Vec<Nuisance> {
        let of = |blamed: &Blamed| {
            let column = match blamed.effect {
                dry if dry == coulomb_friction::EFFECT.name => {
                    coulomb_friction::begun(self, blamed)
                }
                held if held == hysteresis::EFFECT.name => hysteresis::begun(self, blamed)?,
                _ => return None,
            };
            let spread = blamed.amounts[0].abs();
            let is_felt = column.iter().any(|c| *c != 0.0);
            is_felt.then_some(Nuisance { column, spread })
        };
        about.iter().filter_map(of).collect()
    }
}
