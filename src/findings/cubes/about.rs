//! Readings about what was found: springs as far off as they are, causes of the robot in it, the load turned and
//! multiplied, loose cubes that follow. Together these are far from linear.

use super::rows::model;
use super::{Case, floor, force_gain, load_misalignment, loose_cube, softer};
use crate::causes::CAUSES;
use crate::causes::places::soften;
use crate::experiments::cubes::{AddedAxes, Setup};
use crate::findings::engine::{Blamed, Member, Statement};
use crate::findings::physics;
use crate::ground::spatial::{V3, norm, rotate, rotation, scale};
use crate::ground::stats::difference;
use crate::robot::Robot;

/// What was found.
#[derive(Debug, Clone, Default)]
pub struct About {
    /// The causes.
    pub causes: Vec<Blamed>,
    /// Excess of the compliance of every spring that is merely uncertain.
    pub springs: Vec<(String, f64)>,
    /// Whether cubes of the foundation sit on the floor, not on the foot that a soft foundation lets move.
    pub is_floor: bool,
}

/// A cause of the robot with its amounts as [`crate::causes::Cause`] takes them.
pub type Altered<'a> = (&'a str, &'a str, Vec<f64>);

impl About {
    /// What a load is multiplied by.
    pub fn gain(&self) -> f64 {
        let own = self
            .causes
            .iter()
            .filter(|b| b.effect == force_gain::EFFECT.name);
        1.0 + own.map(|b| b.amounts[0]).sum::<f64>()
    }

    /// Rotation vector of the load.
    pub fn turn(&self) -> V3 {
        let mut turn = [0.0; 3];
        for own in self
            .causes
            .iter()
            .filter(|b| b.effect == load_misalignment::EFFECT.name)
        {
            match own.shape[0] as usize {
                axis @ 0..3 => turn[axis] += own.amounts[0],
                _ => turn.iter_mut().zip(&own.amounts).for_each(|(t, a)| *t += a),
            }
        }
        turn
    }

    /// Excess of the compliance of an elastic axis that a cause of this kind found.
    pub fn softer(&self, site: &str) -> f64 {
        let own = self
            .causes
            .iter()
            .filter(|b| softer::is_one(b) && b.site == site);
        own.map(|b| b.amounts[0]).sum()
    }
}

impl Case {
    /// The same about what was found.
    pub fn beside(&self, causes: &[Blamed], uncertain: &[f64]) -> Self {
        let springs = self.springs.iter().cloned().zip(uncertain.iter().copied());
        let mut case = self.with(About {
            is_floor: causes.iter().any(floor::is_one),
            causes: causes.to_vec(),
            springs: springs.collect(),
        });
        let robot = case.altered(None, None);
        case.fixed = case.fixed(&robot, case.about.gain(), case.about.turn());
        case.simulated = case.loosened(&case.fixed);
        case.missed = case.less();
        case
    }

    /// The same with other things found; what it shows is still that of this one.
    pub fn with(&self, about: About) -> Self {
        Self {
            about,
            springs: self.springs.clone(),
            robot: self.robot.clone(),
            setup: self.setup.clone(),
            rows: self.rows.clone(),
            test: self.test.clone(),
            fixed: self.fixed.clone(),
            simulated: self.simulated.clone(),
            missed: self.missed.clone(),
            ..*self
        }
    }

    fn less(&self) -> Vec<f64> {
        let each = self.rows.iter().zip(&self.simulated);
        each.map(|(row, s)| row.measured - s).collect()
    }

    /// Adds to the readings of a statement about something what it is about: amounts are totals.
    pub fn whole(&self, statement: &mut Statement) {
        let add = |reading: &mut Vec<f64>, column: &[f64], amount: f64| {
            reading
                .iter_mut()
                .zip(column)
                .for_each(|(r, c)| *r += amount * c);
        };
        for (nuisance, (_, amount)) in statement.nuisances.iter().zip(&self.about.springs) {
            add(&mut statement.reading, &nuisance.column, *amount);
        }
        for cause in self.about.causes.iter().filter(|b| is_in_place(b)) {
            let mut own = statement
                .suspects
                .iter()
                .filter(|s| s.effect == cause.effect && s.site == cause.site);
            let same =
                |m: &&Member| m.shape == cause.shape && m.columns.len() == cause.amounts.len();
            let member = own.next().and_then(|s| s.members.iter().find(same));
            for (column, amount) in member
                .iter()
                .flat_map(|m| m.columns.iter().zip(&cause.amounts))
            {
                add(&mut statement.reading, column, *amount);
            }
        }
    }

    /// The robot with what was found, one elastic axis softer by some excess more, or one cause by some amounts.
    pub fn altered(&self, softer: Option<(&str, f64)>, more: Option<Altered>) -> Robot {
        let mut robot = self.robot.clone();
        let sites: Vec<String> = robot.springs().map(|(site, _)| site).collect();
        for site in sites {
            let uncertain = self
                .about
                .springs
                .iter()
                .find(|s| s.0 == site)
                .map_or(0.0, |s| s.1);
            let more = softer.filter(|(own, _)| *own == site).map_or(0.0, |s| s.1);
            soften(&mut robot, &site, uncertain + more);
            soften(&mut robot, &site, self.about.softer(&site));
        }
        let mut left = more;
        for cause in &self.about.causes {
            let Some((law, mut amounts)) = physics::amounts(self, cause) else {
                continue;
            };
            if let Some((_, _, extra)) = left.take_if(|m| m.0 == cause.effect && m.1 == cause.site)
            {
                amounts.iter_mut().zip(extra).for_each(|(a, e)| *a += e);
            }
            law.alter(&mut robot, &cause.site, &amounts);
        }
        if let Some((effect, site, amounts)) = left {
            let law = CAUSES.iter().find(|c| c.card().name == effect);
            law.iter()
                .for_each(|law| law.alter(&mut robot, site, &amounts));
        }
        robot
    }

    /// What cubes that sit fast show of a robot under the load multiplied and turned; empty where the robot does not stand.
    pub fn fixed(&self, robot: &Robot, gain: f64, turn: V3) -> Vec<f64> {
        let added = AddedAxes {
            first: self.robot.elastic.len(),
            is_floor: self.about.is_floor,
        };
        let Ok(setup) = Setup::bending(&self.test, robot, added) else {
            return Vec::new();
        };
        let angle = norm(turn);
        let axis = if angle > 0.0 {
            scale(angle.recip(), turn)
        } else {
            [1.0, 0.0, 0.0]
        };
        let turned = rotation(axis, angle);
        model(&setup, &self.test, &self.rows, self.arm, |mut load| {
            load.force = scale(gain, rotate(&turned, load.force));
            load.moment = scale(gain, rotate(&turned, load.moment));
            load
        })
    }

    /// The same where cubes that were found loose follow others.
    pub fn loosened(&self, fixed: &[f64]) -> Vec<f64> {
        let mut shown = fixed.to_vec();
        for cause in self.about.causes.iter().filter(|b| loose_cube::follows(b)) {
            let cube = self
                .test
                .facts
                .cubes
                .iter()
                .position(|c| c.name == cause.site);
            let target =
                cube.map(|cube| loose_cube::target(self, cube, cause.shape[0] as usize, fixed));
            let each = shown.iter_mut().zip(target.into_iter().flatten());
            each.for_each(|(s, t)| *s += cause.amounts[0] * t);
        }
        shown
    }

    /// What a load that is multiplied and turned otherwise would show more.
    pub fn under(&self, gain: f64, turn: V3) -> Vec<f64> {
        let robot = self.altered(None, None);
        let there = self.loosened(&self.fixed(&robot, gain, turn));
        difference(&there, &self.simulated)
    }
}

/// Whether a cause is in the simulation, and not only added to it.
fn is_in_place(blamed: &Blamed) -> bool {
    let load = [force_gain::EFFECT.name, load_misalignment::EFFECT.name].contains(&blamed.effect);
    let physics = CAUSES.iter().any(|c| c.card().name == blamed.effect);
    load || physics || softer::is_one(blamed) || loose_cube::follows(blamed)
}
