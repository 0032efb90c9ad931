//! The robot of a test made ready: which combinations of its bodies' uncertain numbers the FRF sees.

use super::data::Data;
use super::map::weights;
use super::nuisance::{Known, Nuisance};
use super::point::Point;
use super::prediction::Machine;
use super::structure::Structure;
use crate::ground::problem::Outcome;
use crate::ground::products::gram;
use crate::motion::uncertain::bodies;
use crate::motion::uncertain::instrument::NUMBERS as INSTRUMENT;
use crate::robot::Robot;
use nalgebra::DMatrix;
use std::sync::Mutex;

/// Combinations that move the FRF by less than this many standard deviations of its noise are left out.
const UNSEEN: f64 = 0.3;
/// At most this many are kept.
const MOST: usize = 40;

impl<'a> Machine<'a> {
    /// The machine of `robot` at `joints` (rad); `data` tells what is seen.
    ///
    /// # Errors
    /// No equilibrium, or nothing elastic.
    pub fn new(robot: &'a Robot, joints: &'a [f64], known: Known, data: &Data) -> Outcome<Self> {
        let structure = Structure::of(robot, joints)?;
        let numbers = bodies::NUMBERS * (robot.dof() + 1);
        let mut machine = Self {
            robot,
            joints,
            known,
            seen: DMatrix::identity(numbers, numbers),
            structure,
            sensor: None,
            masses: Mutex::default(),
        };
        machine.seen = machine.combinations(data)?;
        machine.masses = Mutex::default();
        Ok(machine)
    }

    /// Unit combinations of the bodies' numbers, the best seen first.
    fn combinations(&self, data: &Data) -> Outcome<DMatrix<f64>> {
        let mut point = Point::nothing();
        let nuisance: Nuisance = self.nuisance(&point)?;
        point.theta.resize(nuisance.len(), 0.0);
        let shown = self.show(&nuisance, &point, data)?;
        let columns = self.slopes(&nuisance, &point, data, &shown)?.columns;
        let mut all = columns.columns(INSTRUMENT, self.seen.nrows()).into_owned();
        let weights = weights(data);
        for mut column in all.column_iter_mut() {
            column.iter_mut().zip(&weights).for_each(|(x, w)| *x *= w);
        }
        Ok(bodies::seen(gram(&all), UNSEEN, MOST))
    }
}
