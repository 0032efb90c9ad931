//! What an amount of a cause does to the force steps: one pattern over points, directions and levels.

use crate::causes::contract::{Cause, StepSeen};
use crate::causes::places::number_in;
use crate::causes::turns::PLACES;
use crate::effects::Family;
use crate::experiments::drive_law::{Law, STOP};
use crate::experiments::workspace::Deflection;
use crate::fit::force_shapes::Shapes;
use crate::ground::spatial::{M3, V3};
use crate::motion::{Work, forward_kinematics, rigid};
use crate::robot::Robot;
use rayon::prelude::*;

/// Change of the readings per unit of an amount.
#[derive(Debug, Clone)]
pub struct Pattern {
    /// Of the slopes.
    pub slopes: Slopes,
    /// Of what the lines leave, in standard deviations; empty where force and displacement stay in
    /// proportion.
    pub left: Vec<f64>,
}

/// Slopes, m/N, by direction of the force at every point.
#[derive(Debug, Clone)]
pub enum Slopes {
    /// At all points.
    Everywhere(Vec<M3>),
    /// At one point, and none elsewhere.
    At(usize, M3),
}

impl Slopes {
    /// Those at a point.
    pub fn at(&self, point: usize) -> M3 {
        match self {
            Self::Everywhere(all) => all[point],
            Self::At(own, slopes) if *own == point => *slopes,
            Self::At(..) => [[0.0; 3]; 3],
        }
    }
}

/// What patterns are taken about.
pub struct Scene<'a> {
    /// The robot as it is simulated.
    pub robot: &'a Robot,
    /// Its joint angles at the points, rad.
    pub points: &'a [Vec<f64>],
    /// Its force steps.
    pub base: Deflection,
    /// The slopes that instruments act upon, m/N: close to what was measured.
    pub reference: Vec<M3>,
    /// Axes of the tool at the points, base frame, as columns.
    pub tool: Vec<M3>,
    /// Where the displacement is read if not at the tool: behind which joint, and where at zero.
    sensor: Option<(usize, V3)>,
}

impl<'a> Scene<'a> {
    /// Of a robot, with the simulated slopes as reference.
    pub fn of(robot: &'a Robot, points: &'a [Vec<f64>]) -> Self {
        Self::seen_at(robot, points, None)
    }

    /// The same with the displacement read elsewhere.
    pub fn seen_at(robot: &'a Robot, points: &'a [Vec<f64>], sensor: Option<(usize, V3)>) -> Self {
        let base = deflection(robot, points, sensor);
        let chain = rigid(robot);
        let mut work = Work::new(&chain);
        let mut pose = |q: &Vec<f64>| forward_kinematics(&chain, &mut work, &chain.spread(q));
        Self {
            robot,
            points,
            reference: base.slopes.clone(),
            tool: points.iter().map(|q| pose(q).rotation).collect(),
            base,
            sensor,
        }
    }

    /// The pattern of one amount, per unit; `step` is an ordinary size of it.
    pub fn pattern(
        &self,
        cause: &dyn Cause,
        site: &str,
        (index, step): (usize, f64),
        shapes: &Shapes,
    ) -> Pattern {
        let mut amounts = vec![0.0; cause.card().amounts.len()];
        amounts[index] = step;
        match cause.card().family {
            Family::Measurement => self.read(cause, site, &amounts, step),
            Family::Physics => self.altered(cause, site, &amounts, step, shapes),
        }
    }

    fn altered(
        &self,
        cause: &dyn Cause,
        site: &str,
        amounts: &[f64],
        step: f64,
        shapes: &Shapes,
    ) -> Pattern {
        let mut robot = self.robot.clone();
        let beside = beside(cause, amounts);
        let sum = amounts.iter().zip(&beside).map(|(a, b)| a + b);
        cause.alter(&mut robot, site, &sum.collect::<Vec<f64>>());
        let moved = deflection(&robot, self.points, self.sensor);
        let from = beside.iter().any(|b| *b != 0.0).then(|| {
            let mut robot = self.robot.clone();
            cause.alter(&mut robot, site, &beside);
            deflection(&robot, self.points, self.sensor).slopes
        });
        let pairs = moved
            .slopes
            .iter()
            .zip(from.as_ref().unwrap_or(&self.base.slopes));
        let slopes: Vec<M3> = pairs.map(|(a, b)| difference(a, b, step)).collect();
        let left = Vec::new();
        match moved.is_linear() {
            true => Pattern {
                slopes: Slopes::Everywhere(slopes),
                left,
            },
            false => self.bent(&moved, (cause.law(amounts), &[]), slopes, step, shapes),
        }
    }

    /// The pattern of a drive that `moved` follows after a law, its weight larger by `more` N·m at
    /// every point (none: as the model says), on top of slopes.
    fn bent(
        &self,
        moved: &Deflection,
        (law, more): (Law, &[f64]),
        mut slopes: Vec<M3>,
        step: f64,
        shapes: &Shapes,
    ) -> Pattern {
        let (lines, left) = shapes.seen(|p, d, forces| {
            let more = more.get(p).copied().unwrap_or(0.0);
            let moved = moved.jumps((p, d), forces, (law, more));
            let base = self.base.jumps((p, d), forces, (Law::Free(STOP), 0.0));
            let change = |(a, b): (V3, V3)| std::array::from_fn(|k| (a[k] - b[k]) / step);
            moved.into_iter().zip(base).map(change).collect()
        });
        for (setup, line) in shapes.setups.iter().zip(&lines) {
            let own = &mut slopes[setup.point][setup.direction];
            (0..3).for_each(|k| own[k] += line[k].unwrap_or(0.0));
        }
        let slopes = Slopes::Everywhere(slopes);
        Pattern { slopes, left }
    }

    /// The patterns of a gap where the weight is larger by each of `mores`, N·m at every point, than the model
    /// says.
    pub fn heavier(
        &self,
        cause: &dyn Cause,
        site: &str,
        (index, step): (usize, f64),
        mores: &[Vec<f64>],
        shapes: &Shapes,
    ) -> Vec<Pattern> {
        let mut amounts = vec![0.0; cause.card().amounts.len()];
        amounts[index] = step;
        let mut robot = self.robot.clone();
        cause.alter(&mut robot, site, &amounts);
        let moved = deflection(&robot, self.points, self.sensor);
        let law = cause.law(&amounts);
        let of = |more: &Vec<f64>| {
            let slopes = vec![[[0.0; 3]; 3]; self.points.len()];
            self.bent(&moved, (law, more), slopes, step, shapes)
        };
        mores.par_iter().map(of).collect()
    }

    /// Instruments act in proportion: one newton shows everything.
    fn read(&self, cause: &dyn Cause, site: &str, amounts: &[f64], step: f64) -> Pattern {
        let seen = |point: usize, direction: usize| -> V3 {
            let displacement = self.reference[point][direction];
            let mut read = StepSeen {
                point,
                direction,
                force: 1.0,
                displacement,
                tool: self.tool[point],
            };
            cause.read_step(site, amounts, &self.reference[point], &mut read);
            std::array::from_fn(|k| (read.displacement[k] - displacement[k]) / step)
        };
        let of = |point: usize| [0, 1, 2].map(|direction| seen(point, direction));
        let own = number_in(site, "point").and_then(|n| n.checked_sub(1));
        let slopes = match own.filter(|own| *own < self.points.len()) {
            Some(own) => Slopes::At(own, of(own)),
            None => Slopes::Everywhere((0..self.points.len()).map(of).collect()),
        };
        let left = Vec::new();
        Pattern { slopes, left }
    }
}

/// What must be there for amounts to be possible: no compliance shares more of two axes than they have.
fn beside(cause: &dyn Cause, amounts: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0; amounts.len()];
    for (index, amount) in amounts.iter().enumerate().filter(|(_, a)| **a != 0.0) {
        if let Some((first, place @ 3..)) = cause.matrix_of(index) {
            let (i, j) = PLACES[place];
            [i, j].iter().for_each(|k| all[first + k] = amount.abs());
        }
    }
    all
}

pub(super) fn deflection(
    robot: &Robot,
    points: &[Vec<f64>],
    sensor: Option<(usize, V3)>,
) -> Deflection {
    match sensor {
        None => Deflection::of(robot, points),
        Some((after, at)) => Deflection::seen_at(robot, points, after, at),
    }
}

fn difference(a: &M3, b: &M3, step: f64) -> M3 {
    std::array::from_fn(|i| std::array::from_fn(|k| (a[i][k] - b[i][k]) / step))
}

impl Pattern {
    /// Multiplies what it does at every point.
    pub fn scale_points(&mut self, factor: impl Fn(usize) -> f64) {
        let scaled = |p: usize, slopes: &mut M3| {
            let factor = factor(p);
            slopes.iter_mut().flatten().for_each(|s| *s *= factor);
        };
        match &mut self.slopes {
            Slopes::Everywhere(all) => {
                let all = all.iter_mut().enumerate();
                all.for_each(|(p, slopes)| scaled(p, slopes));
            }
            Slopes::At(p, slopes) => scaled(*p, slopes),
        }
    }
}
