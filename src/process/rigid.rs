//! A structure that does not give way: `--rigid`.

use super::structure::{Bout, Structure, Tick};
use crate::cutting::cutter::Cutter;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, sub};

/// Nothing moves.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rigid;

impl Structure for Rigid {
    fn deviation(&self) -> V3 {
        [0.0; 3]
    }

    fn cut(&mut self, cutter: &Cutter, tick: &Tick) -> Outcome<Bout> {
        let (load, peak) = cutter.revolution(sub(tick.to.tip, tick.from.tip));
        Ok(Bout {
            force: load.force,
            peak,
            deviation: [0.0; 3],
        })
    }

    fn travel(&mut self, _: &Tick) -> Outcome<Bout> {
        Ok(Bout::default())
    }

    fn longest_travel_s(&self) -> f64 {
        0.02
    }

    fn steps_per_tick(&self, _: &Cutter) -> usize {
        1
    }
}
