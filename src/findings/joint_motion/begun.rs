//! What friction held before the record, which nobody knows: the first branch of a loop lies anywhere between those of all
//! that its contacts can hold, and is no zero that jumps. So does a link that comes to rest in a gap.

use super::joint::Joint;
use super::{backlash, coulomb_friction, hysteresis};
use crate::findings::engine::{Blamed, Nuisance};

impl Joint {
    /// Of every friction that was found, up to all that it can hold of either sign; of a gap, of every rest.
    pub(super) fn begun(&self, about: &[Blamed]) -> Vec<Nuisance> {
        let of = |blamed: &Blamed| {
            let columns = match blamed.effect {
                dry if dry == coulomb_friction::EFFECT.name => {
                    vec![coulomb_friction::begun(self, blamed)]
                }
                held if held == hysteresis::EFFECT.name => {
                    hysteresis::begun(self, blamed).into_iter().collect()
                }
                gap if gap == backlash::EFFECT.name => backlash::rests(self),
                _ => Vec::new(),
            };
            let spread = blamed.amounts[0].abs();
            let felt = columns
                .into_iter()
                .filter(|column| column.iter().any(|c| *c != 0.0));
            felt.map(|column| Nuisance { column, spread })
                .collect::<Vec<_>>()
        };
        about.iter().flat_map(of).collect()
    }
}
