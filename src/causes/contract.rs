//! What a cause of the whole robot must bring, and what it gets for it.
//!
//! An [effect](crate::effects) lives in one axis and is judged by the curve of load and deflection. A
//! cause lives somewhere on the robot or its instruments and is judged by every experiment in which it
//! would show: physics changes the robot, so one file serves the workspace test, the hammer test and
//! the simulation alike; an instrument changes what one experiment reads.

use super::turns::{SIX, not_negative};
use crate::effects::Family;
use crate::experiments::drive_law::{Law, STOP};
use crate::ground::spatial::{M3, V3};
use crate::ground::stats::largest;
use crate::robot::Robot;
use nalgebra::Complex;

/// An experiment on the whole robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sight {
    /// Force steps at points of the workspace.
    Workspace,
    /// Impulse hammer at the tool.
    Hammer,
}

/// A parameter of a cause. All are zero where the cause is absent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amount {
    /// Its name.
    pub name: &'static str,
    /// Its unit as printed.
    pub unit: &'static str,
    /// The sentence the user reads about it.
    pub meaning: &'static str,
    /// Lowest and highest value.
    pub bounds: [f64; 2],
    /// Values to start a search from: the span of what is worth finding.
    pub starts: &'static [f64],
}

impl Amount {
    /// An amount with its name, unit, meaning, bounds and starts.
    pub const fn new(
        name: &'static str,
        unit: &'static str,
        meaning: &'static str,
        bounds: [f64; 2],
        starts: &'static [f64],
    ) -> Self {
        Self {
            name,
            unit,
            meaning,
            bounds,
            starts,
        }
    }
}

/// Everything about a cause that is not its equation.
#[derive(Debug, Clone, Copy)]
pub struct Card {
    /// Its name, as in `formats.md`.
    pub name: &'static str,
    /// Physics or measurement.
    pub family: Family,
    /// What it is, one sentence.
    pub summary: &'static str,
    /// Its equation, as text.
    pub equation: &'static str,
    /// Author, year, equation.
    pub source: &'static str,
    /// How it looks, experiment by experiment: where it would show at all.
    pub shows: &'static [(Sight, &'static str)],
    /// Its parameters.
    pub amounts: &'static [Amount],
}

/// One force step as an instrument sees it: what it may change before it is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepSeen {
    /// Index of the point.
    pub point: usize,
    /// Direction of the force, 0 to 2 for x, y, z of the base frame.
    pub direction: usize,
    /// Force, N.
    pub force: f64,
    /// Displacement of the tool per component, m, base frame.
    pub displacement: V3,
    /// Axes of the tool frame as columns, base frame.
    pub tool: M3,
}

/// Who is blamed first: a doubtful instrument before a doubtful number, a doubtful number before a
/// part that the model lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Blame {
    /// What reads.
    Instrument,
    /// A number of a part that the model has.
    Parameter,
    /// A part that the model lacks.
    Structure,
}

/// Accelerance of the tool at one `s`: output by input, (m/s²)/N, base frame.
pub type Accelerance = [[Complex<f64>; 3]; 3];

/// A cause: one file, one line in [`CAUSES`](super::CAUSES).
pub trait Cause: Sync {
    /// Its card.
    fn card(&self) -> &'static Card;

    /// Where on this robot it may sit: `A6`, `A6-tilt`, `base`, `link2`, `tool`, `sensor`, `sensor-x`; without another
    /// word in the sensor.
    fn sites(&self, _robot: &Robot) -> Vec<String> {
        vec!["sensor".into()]
    }

    /// The sites in a test with that many points: more than [`Cause::sites`] where a point is one.
    fn sites_at(&self, robot: &Robot, _points: usize) -> Vec<String> {
        self.sites(robot)
    }

    /// How soon it is blamed.
    fn blame(&self) -> Blame {
        match self.card().family {
            Family::Measurement => Blame::Instrument,
            Family::Physics => Blame::Parameter,
        }
    }

    /// Size that each amount has where the cause is of ordinary strength, in the units of the amounts.
    fn scale(&self, _robot: &Robot, _site: &str) -> Vec<f64> {
        let own = self.card().amounts.iter();
        own.map(|amount| largest(amount.starts)).collect()
    }

    /// The forms in which it comes: which amounts act, the others staying zero. A cause is a family
    /// of patterns; the narrow forms are what most authors and most robots have.
    fn forms(&self) -> Vec<Vec<usize>> {
        vec![(0..self.card().amounts.len()).collect()]
    }

    /// First amounts of the symmetric matrices among them, six each ([`turns`](super::turns)).
    fn matrices(&self) -> Vec<usize> {
        Vec::new()
    }

    /// The matrix that an amount is of: its first amount, and which of the six it is.
    fn matrix_of(&self, index: usize) -> Option<(usize, usize)> {
        let mut all = self.matrices().into_iter();
        let first = all.find(|first| (*first..first + SIX).contains(&index))?;
        Some((first, index - first))
    }

    /// Whether an amount is what two axes share: none alone.
    fn is_shared(&self, index: usize) -> bool {
        matches!(self.matrix_of(index), Some((_, 3..)))
    }

    /// Brings amounts to what can be: none below its bound, no matrix negative anywhere.
    fn possible(&self, amounts: &mut [f64]) {
        for (amount, card) in amounts.iter_mut().zip(self.card().amounts) {
            *amount = amount.max(card.bounds[0]);
        }
        for first in self.matrices() {
            not_negative(&mut amounts[first..first + SIX]);
        }
    }

    /// How many of its leading amounts a hammer test tells apart; the others stay zero there.
    fn heard(&self) -> usize {
        self.card().amounts.len()
    }

    /// How many of its leading amounts are along the axes of the frame, none of them shared by two: the narrow form.
    fn straight(&self) -> usize {
        let all = 0..self.heard();
        all.take_while(|k| !self.is_shared(*k)).count()
    }

    /// The places next to one, along the same part: a cause may sit anywhere between them. By number, amounts of one place being
    /// [`Cause::heard`] together.
    fn next_to(&self, _place: usize) -> Vec<usize> {
        Vec::new()
    }

    /// Whether a search scales an amount of a place with the cause; else it says how the cause acts, however large that is.
    fn is_size(&self, _index: usize) -> bool {
        true
    }

    /// Whether nobody may name it: it is sought lest another be named in its place, and told as unknown.
    fn is_outside(&self) -> bool {
        false
    }

    /// The amount that tells which share of the part's own body lies behind it, where one does: no size of the cause, but a thing of its
    /// place.
    fn behind(&self) -> Option<usize> {
        None
    }

    /// How the gaps that it opens are crossed.
    fn law(&self, _amounts: &[f64]) -> Law {
        Law::Free(STOP)
    }

    /// How much sooner than at its other sites it is blamed at this one.
    fn readiness(&self, _robot: &Robot, _site: &str) -> f64 {
        1.0
    }

    /// How much sooner than its other forms each is likely.
    fn shares(&self) -> Vec<f64> {
        vec![1.0; self.forms().len()]
    }

    /// Physics: changes the robot.
    fn alter(&self, _robot: &mut Robot, _site: &str, _amounts: &[f64]) {}

    /// Instruments of a workspace test: change one force step as it is read. `compliance` holds the
    /// displacement per newton in each direction, m/N, columns by direction.
    fn read_step(
        &self,
        _site: &str,
        _amounts: &[f64],
        _compliance: &[V3; 3],
        _step: &mut StepSeen,
    ) {
    }

    /// Instruments of a hammer test: change the accelerance at `s` (1/s).
    fn read_accelerance(
        &self,
        _site: &str,
        _amounts: &[f64],
        _s: Complex<f64>,
        _frf: &mut Accelerance,
    ) {
    }

    /// Instruments of a hammer test: the rate of an exponential window that the file does not declare,
    /// 1/s: the accelerance is then read at `s` plus this rate.
    fn undeclared_rate(&self, _amounts: &[f64]) -> f64 {
        0.0
    }

    /// What is reported: name, value SI, unit. The amounts themselves if nothing says more.
    fn said(
        &self,
        _robot: &Robot,
        _site: &str,
        amounts: &[f64],
    ) -> Vec<(&'static str, f64, &'static str)> {
        let own = self.card().amounts.iter().zip(amounts);
        own.map(|(a, v)| (a.name, *v, a.unit)).collect()
    }
}
