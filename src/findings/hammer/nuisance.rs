//! What is uncertain although nothing is wrong: stiffnesses, dampings, bodies, the sensor's mounting,
//! the angle of the hits. Each is counted in its own standard deviations.

use crate::causes::places::ADDED_DAMPING;
use crate::motion::Linear;
use crate::motion::frf::C64;
use crate::motion::uncertain::instrument::{NUMBERS as INSTRUMENT, Reading};
use crate::motion::uncertain::slopes::{Entry, Upper, of_entries, of_masses};
use crate::motion::uncertain::{self, bodies as numbers};
use crate::robot::Robot;
use nalgebra::DMatrix;
use std::sync::Arc;

/// Standard deviations of what a laboratory knows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// Relative, of a stiffness.
    pub stiffness: f64,
    /// Of the logarithm of a damping.
    pub damping: f64,
    /// Of the bodies and the instruments.
    pub laboratory: uncertain::Known,
}

/// Standard deviation of the logarithm of a damping nobody stated: that of an axis which a cause adds.
const ADDED: f64 = 1.0;
/// The layout of the nuisances of one structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Nuisance {
    /// Per site of the robot as simulated now: name.
    pub sites: Vec<String>,
    /// Coordinates of each site, then of each added axis.
    coordinates: Vec<Vec<usize>>,
    /// Directions of the mass matrix per standard deviation: upper triangle by rows.
    pub mass: Arc<DMatrix<f64>>,
    known: Known,
}

impl Nuisance {
    /// The nuisances of `linear`, whose first axes are those of `robot`.
    pub fn new(robot: &Robot, linear: &Linear, mass: Arc<DMatrix<f64>>, known: Known) -> Self {
        let mut sites: Vec<String> = robot.springs().map(|(site, _)| site).collect();
        let own = sites.len();
        for name in &linear.names {
            if !sites.contains(name) {
                sites.push(name.clone());
            }
        }
        let of = |site: &String| {
            (0..linear.n)
                .filter(|i| linear.names[*i] == *site)
                .collect()
        };
        let coordinates = sites.iter().map(of).collect();
        sites.truncate(own);
        Self {
            sites,
            coordinates,
            mass,
            known,
        }
    }

    /// How many numbers.
    pub fn len(&self) -> usize {
        self.sites.len() + self.coordinates.len() + self.mass.nrows() + INSTRUMENT
    }

    /// Whether nothing is uncertain: never.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Where the parts start: instrument, bodies, stiffnesses, dampings. Added axes come last, so
    /// that the numbers of one structure start another.
    fn starts(&self) -> [usize; 3] {
        let bodies = INSTRUMENT;
        let stiffness = bodies + self.mass.nrows();
        [bodies, stiffness, stiffness + self.sites.len()]
    }

    fn damping_std(&self, site: usize) -> f64 {
        match site < self.sites.len() {
            true => self.known.damping,
            false => ADDED,
        }
    }

    /// What hammer and sensor make of an accelerance with the nuisances `theta`.
    pub fn reading(&self, theta: &[f64]) -> Reading {
        let own = theta.iter().copied().take(INSTRUMENT);
        Reading::of(own, &self.known.laboratory.instrument)
    }

    /// The matrices with the nuisances `theta` in them.
    pub fn applied(&self, linear: &Linear, theta: &[f64]) -> Linear {
        let mut out = linear.clone();
        let n = linear.n;
        let [bodies, stiffness, damping] = self.starts();
        let amounts = theta[bodies..stiffness].iter().copied();
        numbers::add(&mut out.mass, &self.mass, amounts);
        for (site, own) in self.coordinates.iter().enumerate() {
            let soft = match site < self.sites.len() {
                true => (self.known.stiffness * theta[stiffness + site]).exp(),
                false => 1.0,
            };
            let damp = (self.damping_std(site) * theta[damping + site]).exp();
            for i in own {
                let at = i * n + i;
                out.stiffness[at] *= soft;
                out.damping[at] = floor(linear, at) * damp;
            }
        }
        out
    }

    /// Changes of the accelerance with every number of the structure, in the order of `theta` behind
    /// the instrument's: `[number][line][pair of directions as in upper]`.
    pub fn slopes(&self, linear: &Linear, answers: &[[C64; 3]], s: &[C64]) -> Vec<Vec<Upper>> {
        let n = linear.n;
        let mut out = of_masses(&self.mass, (answers, n), s);
        let unit = |site: &Vec<usize>| -> Vec<Upper> {
            let entries: Vec<Entry> = site.iter().map(|i| (*i, *i, 1.0)).collect();
            of_entries(&entries, |_| C64::new(1.0, 0.0), (answers, n), s)
        };
        let scaled = |unit: &[Upper], factor: &dyn Fn(C64) -> C64| -> Vec<Upper> {
            let lines = unit.iter().zip(s);
            lines.map(|(v, s)| v.map(|x| factor(*s) * x)).collect()
        };
        let all: Vec<Vec<Upper>> = self.coordinates.iter().map(unit).collect();
        for (site, own) in self.coordinates.iter().enumerate().take(self.sites.len()) {
            let k = own.first().map_or(0.0, |i| linear.stiffness[i * n + i]);
            let k = C64::new(self.known.stiffness * k, 0.0);
            out.push(scaled(&all[site], &|_| k));
        }
        for (site, own) in self.coordinates.iter().enumerate() {
            let d = own.first().map_or(0.0, |i| linear.damping[i * n + i]);
            let d = self.damping_std(site) * d;
            out.push(scaled(&all[site], &|s| s * d));
        }
        out
    }
}

/// A damping of zero cannot be scaled: it starts as that of an added spring.
fn floor(linear: &Linear, at: usize) -> f64 {
    match linear.damping[at] > 0.0 {
        true => linear.damping[at],
        false => ADDED_DAMPING * linear.stiffness[at],
    }
}
