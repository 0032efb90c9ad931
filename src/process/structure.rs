//! What carries the tool.

use super::way::Moment;
use crate::cutting::cutter::Cutter;
use crate::ground::problem::Outcome;
use crate::ground::spatial::V3;

/// A stretch of time while one tooth passes (or a piece of that), or of travel beside the stock.
#[derive(Debug, Clone)]
pub struct Tick {
    /// Its begin.
    pub from: Moment,
    /// Its end.
    pub to: Moment,
}

impl Tick {
    /// Length in time, s.
    pub fn duration_s(&self) -> f64 {
        self.to.time_s - self.from.time_s
    }
}

/// What a tick brought.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bout {
    /// Mean force on the tool, N, workpiece frame.
    pub force: V3,
    /// Largest force, N.
    pub peak: f64,
    /// Mean deviation of the tool from where it was told to be, m, workpiece frame.
    pub deviation: V3,
}

/// Work in the coupled system since the start, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energy {
    /// Done on the elastic structure by the cut, the motion and the weight.
    pub work: f64,
    /// Kept in its springs and its motion, since the start.
    pub stored: f64,
    /// Taken by its dampers.
    pub damped: f64,
}

impl Energy {
    /// What is not accounted for, as a share of all that was done and damped.
    pub fn gap(&self) -> f64 {
        let size = self
            .work
            .abs()
            .max(self.damped.abs())
            .max(self.stored.abs());
        match size > 0.0 {
            true => (self.work - self.stored - self.damped).abs() / size,
            false => 0.0,
        }
    }
}

/// What carries the tool: gives its deviation, and answers the cut.
pub trait Structure {
    /// Where the tool is, less where it was told to be, m, workpiece frame.
    fn deviation(&self) -> V3;

    /// One tick in the cut, the engagement being that of its end.
    ///
    /// # Errors
    /// A pose or a load that the structure cannot have.
    fn cut(&mut self, cutter: &Cutter, tick: &Tick) -> Outcome<Bout>;

    /// One tick beside the stock.
    ///
    /// # Errors
    /// A pose that the structure cannot have.
    fn travel(&mut self, tick: &Tick) -> Outcome<Bout>;

    /// Longest tick beside the stock, s.
    fn longest_travel_s(&self) -> f64;

    /// Steps per second in the cut.
    fn steps_per_tick(&self, cutter: &Cutter) -> usize;

    /// Its energy, where it has one.
    fn energy(&self) -> Option<Energy> {
        None
    }
}
