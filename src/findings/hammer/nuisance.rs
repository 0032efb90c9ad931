//! What is uncertain although nothing is wrong: stiffnesses, dampings, bodies, the sensor's mounting,
//! the angle of the hits. Each is counted in its own standard deviations.

use super::structure::triangle;
use crate::causes::places::ADDED_DAMPING;
use crate::motion::Linear;
use crate::motion::frf::C64;
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
}

/// Standard deviation of the logarithm of a damping nobody stated: that of an axis which a cause adds.
const ADDED: f64 = 1.0;
/// Sensor gain (relative), its mounting (rad), angle of the hits (rad), skew (s).
const GAIN: f64 = 0.005;
const MOUNTING: f64 = 0.008;
const HIT: f64 = 0.006;
const SKEW: f64 = 2e-5;

/// Instrument numbers: three gains, three angles, six angles of hits, one skew.
pub const INSTRUMENT: usize = 13;

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

    /// The matrices with the nuisances `theta` in them.
    pub fn applied(&self, linear: &Linear, theta: &[f64]) -> Linear {
        let mut out = linear.clone();
        let n = linear.n;
        let [bodies, stiffness, damping] = self.starts();
        for (place, (i, j)) in triangle(n).enumerate() {
            let rows = 0..self.mass.nrows();
            let more: f64 = rows
                .map(|r| theta[bodies + r] * self.mass[(r, place)])
                .sum();
            out.mass[i * n + j] += more;
            if i != j {
                out.mass[j * n + i] += more;
            }
        }
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
    pub fn slopes(&self, linear: &Linear, answers: &[[C64; 3]], s: &[C64]) -> Vec<Vec<[C64; 6]>> {
        let n = linear.n;
        let mut out = self.mass_slopes(n, answers, s);
        let squares = |site: &Vec<usize>| -> Vec<[C64; 6]> {
            let line = |k: usize| {
                let mut sum = [C64::default(); 6];
                for i in site {
                    let y = &answers[k * n + i];
                    for (entry, (a, b)) in sum.iter_mut().zip(UPPER) {
                        *entry += y[a] * y[b];
                    }
                }
                sum
            };
            (0..s.len()).map(line).collect()
        };
        let scaled = |squares: &[[C64; 6]], factor: &dyn Fn(C64) -> C64| -> Vec<[C64; 6]> {
            let lines = squares.iter().zip(s);
            lines
                .map(|(v, s)| v.map(|x| -*s * *s * factor(*s) * x))
                .collect()
        };
        let all: Vec<Vec<[C64; 6]>> = self.coordinates.iter().map(squares).collect();
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

    /// −s⁴ yᵀ G y of every direction G: one product of matrices for all lines.
    fn mass_slopes(&self, n: usize, answers: &[[C64; 3]], s: &[C64]) -> Vec<Vec<[C64; 6]>> {
        let places = n * (n + 1) / 2;
        let mut products = DMatrix::zeros(places, 12 * s.len());
        for (k, s) in s.iter().enumerate() {
            let y = &answers[k * n..(k + 1) * n];
            let factor = -(s * s) * (s * s);
            for (p, (a, b)) in UPPER.into_iter().enumerate() {
                let column = 12 * k + 2 * p;
                for (place, (i, j)) in triangle(n).enumerate() {
                    let both = match i == j {
                        true => y[i][a] * y[i][b],
                        false => y[i][a] * y[j][b] + y[j][a] * y[i][b],
                    };
                    let both = both * factor;
                    products[(place, column)] = both.re;
                    products[(place, column + 1)] = both.im;
                }
            }
        }
        let all = self.mass.as_ref() * products;
        let line = |row: usize, k: usize| {
            std::array::from_fn(|p| {
                C64::new(all[(row, 12 * k + 2 * p)], all[(row, 12 * k + 2 * p + 1)])
            })
        };
        (0..self.mass.nrows())
            .map(|row| (0..s.len()).map(|k| line(row, k)).collect())
            .collect()
    }
}

/// A damping of zero cannot be scaled: it starts as that of an added spring.
fn floor(linear: &Linear, at: usize) -> f64 {
    match linear.damping[at] > 0.0 {
        true => linear.damping[at],
        false => ADDED_DAMPING * linear.stiffness[at],
    }
}

/// Pairs of directions of a symmetric 3×3 matrix.
pub const UPPER: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// An accelerance as it is read with the instrument's numbers `theta`.
pub fn read(theta: &[f64], s: C64, a: &mut [[C64; 3]; 3]) {
    let mut change = [[C64::default(); 3]; 3];
    for (number, value) in theta.iter().enumerate().take(INSTRUMENT) {
        let slope = instrument_slope(number, s, a);
        for (sum, row) in change.iter_mut().flatten().zip(slope.iter().flatten()) {
            *sum += row * *value;
        }
    }
    for (entry, change) in a.iter_mut().flatten().zip(change.iter().flatten()) {
        *entry += change;
    }
}

/// Change of the reading with one of the instrument's numbers.
pub fn instrument_slope(number: usize, s: C64, a: &[[C64; 3]; 3]) -> [[C64; 3]; 3] {
    let mut out = [[C64::default(); 3]; 3];
    match number {
        0..=2 => out[number] = a[number].map(|x| x * GAIN),
        3..=5 => {
            let (i, j) = ((number - 2) % 3, (number - 1) % 3);
            out[i] = a[j].map(|x| x * MOUNTING);
            out[j] = a[i].map(|x| x * -MOUNTING);
        }
        6..=11 => {
            let input = (number - 6) / 2;
            let other = (input + 1 + (number - 6) % 2) % 3;
            for (row, line) in out.iter_mut().zip(a) {
                row[input] = line[other] * HIT;
            }
        }
        _ => out = a.map(|row| row.map(|x| -x * s * SKEW)),
    }
    out
}
