//! What a robot with a set of causes would have shown in a hammer test.

use super::data::Data;
use super::nuisance::{Known, Nuisance};
use super::point::Point;
use super::structure::Structure;
use super::{seat::Seat, suspect::Suspect};
use crate::causes::contract::Accelerance;
use crate::ground::problem::Outcome;
use crate::motion::Linear;
use crate::motion::frf::C64;
use crate::motion::receptance::{accelerance, coordinates, under_moments};
use crate::motion::uncertain::instrument::{NUMBERS as INSTRUMENT, Reading};
use crate::motion::uncertain::slopes::{Entry, Upper, of_entries, whole};
use crate::robot::Robot;
use nalgebra::DMatrix;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

/// Step of a derivative by an amount, relative to the amount or to a hundredth of its spread.
const STEP: f64 = 1e-4;

/// Coordinates by their names, and which of its places each cause of the set has.
pub type Coordinates = (Vec<String>, Vec<Seat>);

/// The robot as simulated now, at the pose of the test, with what is uncertain about it.
pub struct Machine<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// Joint angles, rad.
    pub joints: &'a [f64],
    /// What a laboratory knows.
    pub known: Known,
    /// The combinations of the bodies' numbers that the FRF sees.
    pub seen: DMatrix<f64>,
    /// Its matrices.
    pub structure: Structure,
    /// Where the sensor sits: at the tool, else on the body that this joint moves, 0 being the foot.
    pub sensor: Option<usize>,
    /// What the bodies' numbers do to the mass matrix, by the names of the coordinates.
    pub masses: Mutex<BTreeMap<Coordinates, Arc<DMatrix<f64>>>>,
}

/// Values and slopes of one point on the lines of some data, unweighted, in the order of the rows.
pub struct Slopes {
    /// Prediction.
    pub values: Vec<f64>,
    /// Per nuisance, then per amount.
    pub columns: DMatrix<f64>,
}

/// What a point shows, and what its slopes are made of.
pub struct Shown {
    linear: Linear,
    s: Vec<C64>,
    answers: Vec<[C64; 3]>,
    /// What a sensor would read that is calibrated and mounted as it should be, of forces.
    bare: Vec<Accelerance>,
    /// The same of moments on the tool.
    turned: Vec<Accelerance>,
    reading: Reading,
    /// What is read.
    pub values: Vec<Accelerance>,
}

impl Machine<'_> {
    /// The matrices with the physical causes of `point`.
    pub fn structure_of(&self, point: &Point) -> Outcome<Structure> {
        match point.is_physical() {
            true => self.structure.altered(&point.robot(self.robot)),
            false => Ok(self.structure.clone()),
        }
    }

    /// The nuisances of the structure of `point`.
    pub fn nuisance(&self, point: &Point) -> Outcome<Nuisance> {
        let structure = self.structure_of(point)?;
        let mass = self.masses(&structure, point)?;
        let known = self.known;
        Ok(Nuisance::new(self.robot, &structure.linear, mass, known))
    }

    /// Computed once per set of coordinates, with the bodies as simulated now.
    fn masses(&self, structure: &Structure, point: &Point) -> Outcome<Arc<DMatrix<f64>>> {
        let mut known = match self.masses.lock() {
            Ok(known) => known,
            Err(poisoned) => poisoned.into_inner(),
        };
        let places = point.set.iter().filter_map(Suspect::seat);
        let names = (structure.linear.names.clone(), places.collect());
        if let Some(made) = known.get(&names) {
            return Ok(Arc::clone(made));
        }
        let mut robot = point.robot(self.robot);
        robot.tool.body = self.robot.tool.body;
        let links = robot.joints.iter_mut().zip(&self.robot.joints);
        links.for_each(|(joint, own)| joint.link = own.link);
        let directions = structure.bodies(&robot, &self.known.laboratory.bodies)?;
        let made = Arc::new(&self.seen * directions);
        known.insert(names, Arc::clone(&made));
        Ok(made)
    }

    /// The predicted accelerances on the lines of `data`.
    pub fn predict(
        &self,
        nuisance: &Nuisance,
        point: &Point,
        data: &Data,
    ) -> Outcome<Vec<Accelerance>> {
        Ok(self.show(nuisance, point, data)?.values)
    }

    /// What `point` shows on the lines of `data`.
    pub fn show(&self, nuisance: &Nuisance, point: &Point, data: &Data) -> Outcome<Shown> {
        let structure = self.structure_of(point)?;
        let mut linear = nuisance.applied(&structure.linear, &point.theta);
        let s = shifted(point, data);
        let answers = coordinates(&linear, &s);
        if let Some(joint) = self.sensor {
            linear.tool = structure.sensor(&point.robot(self.robot), joint);
            // what moments on the tool move there is not told by forces on the tool: hits are where they are aimed at
            linear.turn.fill([0.0; 3]);
        }
        Ok(Shown::of(point, nuisance, linear, answers, s))
    }

    /// Prediction and slopes of a point, from what it shows; the sensor is at the tool.
    pub fn slopes(
        &self,
        nuisance: &Nuisance,
        point: &Point,
        data: &Data,
        shown: &Shown,
    ) -> Outcome<Slopes> {
        let Shown {
            linear,
            s,
            answers,
            reading,
            values,
            ..
        } = shown;
        let rows = data.rows();
        let mut columns = Vec::with_capacity(rows * (point.theta.len() + point.amounts.len()));
        let spread = &self.known.laboratory.instrument;
        for number in 0..INSTRUMENT {
            let slope = shown
                .lines()
                .map(|(both, s)| reading.slope(number, spread, s, both));
            stack(data, &slope.collect::<Vec<_>>(), &mut columns);
        }
        let each = point.each();
        for slope in nuisance.slopes(linear, answers, s) {
            stack(data, &shown.read(&each, &slope), &mut columns);
        }
        for index in 0..point.amounts.len() {
            let slope = self.amount_slope(nuisance, (point, &each), shown, index)?;
            stack(data, &slope, &mut columns);
        }
        let mut stacked = Vec::with_capacity(rows);
        stack(data, values, &mut stacked);
        let count = columns.len() / rows.max(1);
        Ok(Slopes {
            values: stacked,
            columns: DMatrix::from_vec(rows, count, columns),
        })
    }

    /// Change of what is read with an amount: of the matrices to first order, where these are all that changes.
    fn amount_slope(
        &self,
        nuisance: &Nuisance,
        (point, each): (&Point, &[(&Suspect, Vec<f64>)]),
        shown: &Shown,
        index: usize,
    ) -> Outcome<Vec<Accelerance>> {
        let mut moved = point.clone();
        let step = STEP * point.amounts[index].abs().max(0.01);
        moved.amounts[index] += step;
        let rate = moved.rate() - point.rate();
        let s: Vec<C64> = shown.s.iter().map(|s| s + rate).collect();
        let linear = nuisance.applied(&self.structure_of(&moved)?.linear, &moved.theta);
        let before = &shown.linear;
        let levers = linear.tool == before.tool && linear.turn == before.turn;
        if point.owner(index).is_some_and(Suspect::is_physical) && rate == 0.0 && levers {
            let changes = [
                changed(&linear.stiffness, &before.stiffness, linear.n, step),
                changed(&linear.damping, &before.damping, linear.n, step),
                changed(&linear.mass, &before.mass, linear.n, step),
            ];
            return Ok(shown.read(each, &shown.change(&changes)));
        }
        let is_same = rate == 0.0 && linear == *before;
        let answers = match is_same {
            true => shown.answers.clone(),
            false => coordinates(&linear, &s),
        };
        let mut after = Shown::of(&moved, nuisance, linear, answers, s).values;
        for (after, before) in after.iter_mut().zip(&shown.values) {
            for (a, b) in after.iter_mut().flatten().zip(before.iter().flatten()) {
                *a = (*a - b) / step;
            }
        }
        Ok(after)
    }
}

/// The entries in which two matrices of n coordinates differ, per `step`.
fn changed(after: &[f64], before: &[f64], n: usize, step: f64) -> Vec<Entry> {
    let each = after.iter().zip(before).enumerate();
    each.filter(|(_, (a, b))| a != b)
        .map(|(at, (a, b))| (at / n, at % n, (a - b) / step))
        .collect()
}

impl Shown {
    fn of(
        point: &Point,
        nuisance: &Nuisance,
        linear: Linear,
        answers: Vec<[C64; 3]>,
        s: Vec<C64>,
    ) -> Self {
        let bare = as_seen(accelerance, point, &linear, &answers, &s);
        let turned = as_seen(under_moments, point, &linear, &answers, &s);
        let mut shown = Self {
            reading: nuisance.reading(&point.theta),
            values: Vec::new(),
            linear,
            s,
            answers,
            bare,
            turned,
        };
        let values = shown
            .lines()
            .map(|(both, s)| shown.reading.read_all(s, both));
        shown.values = values.collect();
        shown
    }

    /// What an ideal sensor reads of forces and moments, line by line.
    fn lines(&self) -> impl Iterator<Item = ([&Accelerance; 2], C64)> {
        let both = self.bare.iter().zip(&self.turned).zip(&self.s);
        both.map(|((a, b), s)| ([a, b], *s))
    }

    /// What is read of a change of the accelerance at the tool.
    fn read(&self, each: &[(&Suspect, Vec<f64>)], change: &[Upper]) -> Vec<Accelerance> {
        let read = |(v, s): (&Upper, &C64)| {
            let mut a = whole(v);
            each.iter()
                .for_each(|(c, amounts)| c.cause.read_accelerance(&c.site, amounts, *s, &mut a));
            self.reading.read(*s, &a)
        };
        change.iter().zip(&self.s).map(read).collect()
    }

    /// Change of the accelerance at the tool with the entries of stiffness, damping and mass.
    fn change(&self, [stiffness, damping, mass]: &[Vec<Entry>; 3]) -> Vec<Upper> {
        let factors: [fn(C64) -> C64; 3] = [|_| C64::new(1.0, 0.0), |s| s, |s| s * s];
        let mut sum = vec![Upper::default(); self.s.len()];
        for (entries, factor) in [stiffness, damping, mass].into_iter().zip(factors) {
            if entries.is_empty() {
                continue;
            }
            let part = of_entries(entries, factor, (&self.answers, self.linear.n), &self.s);
            let both = sum.iter_mut().flatten().zip(part.iter().flatten());
            both.for_each(|(sum, part)| *sum += part);
        }
        sum
    }
}

fn shifted(point: &Point, data: &Data) -> Vec<C64> {
    let rate = point.rate();
    data.s.iter().map(|s| s + rate).collect()
}

/// `of` every line, through the causes that an instrument may have.
fn as_seen(
    of: impl Fn(&Linear, &[[C64; 3]], C64) -> Accelerance,
    point: &Point,
    linear: &Linear,
    answers: &[[C64; 3]],
    s: &[C64],
) -> Vec<Accelerance> {
    let each = point.each();
    let line = |(k, s): (usize, &C64)| {
        let mut a = of(linear, &answers[k * linear.n..(k + 1) * linear.n], *s);
        each.iter()
            .for_each(|(c, amounts)| c.cause.read_accelerance(&c.site, amounts, *s, &mut a));
        a
    };
    s.iter().enumerate().map(line).collect()
}

/// Appends the rows of `data`: per pair, real and imaginary part of every line.
pub fn stack(data: &Data, values: &[Accelerance], rows: &mut Vec<f64>) {
    for pair in &data.pairs {
        for a in values {
            let h = a[pair.output][pair.input];
            rows.extend([h.re, h.im]);
        }
    }
}

#[cfg(test)]
mod tests;
