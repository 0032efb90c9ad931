//! Hammer and accelerometer: calibration of both, the mounting of the sensor, the angle and the place of the hits,
//! the delay between the channels. A reading is `S·(A·F + B·P)·(1 − sτ)`: S gains and mounting of the sensor, A the
//! accelerance, F the directions of the hits with the gain of the hammer, B the acceleration under moments
//! ([`crate::motion::receptance::under_moments`]), P the moments of hits beside the tool's point.

use crate::ground::units::DEGREE;
use crate::motion::frf::{C64, Response};
use std::ops::Range;

/// Uncertain numbers that all tests with one set of instruments share: three gains of the sensor, the gain
/// of the hammer, the delay.
pub const SHARED: usize = 5;
/// All numbers of one test: those, then three angles of the sensor, then two angles of the hits along each
/// direction, then the two places of these hits across it.
pub const NUMBERS: usize = PLACES + 6;
/// Where the places of the hits begin.
const PLACES: usize = SHARED + 9;

/// How well instruments are known: one standard deviation each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Calibration of each axis of the sensor, relative.
    pub sensor: f64,
    /// Calibration of the hammer, relative.
    pub hammer: f64,
    /// Mounting of the sensor, rad.
    pub mounting_rad: f64,
    /// Angle of the hits, rad.
    pub hit_rad: f64,
    /// Place of the hits across their direction, m.
    pub place_m: f64,
    /// Delay of the acceleration against the force, s.
    pub delay_s: f64,
}

/// A real 3×3 matrix.
type Matrix = [[f64; 3]; 3];

const ONE: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// What instruments make of an accelerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    sensor: Matrix,
    force: Matrix,
    moment: Matrix,
    delay_s: f64,
}

/// One number alone: what one standard deviation of it adds.
enum Part {
    Sensor(Matrix),
    Force(Matrix),
    Moment(Matrix),
    Delay(f64),
}

impl Spread {
    /// A spread with the calibration of hammer and sensor at `gain` (relative): a stud on a casting and a
    /// hand with a hammer are right to half a degree, the hand to five millimetres, clocks of one recorder to a
    /// fiftieth of a millisecond.
    pub fn calibrated(gain: f64) -> Self {
        Self {
            sensor: gain,
            hammer: gain,
            mounting_rad: 0.008,
            hit_rad: 0.006,
            place_m: 0.005,
            delay_s: 2e-5,
        }
    }

    /// The numbers of the hits: two angles, then two places for each direction.
    pub const HITS: Range<usize> = SHARED + 3..NUMBERS;

    /// One of them, `amount` standard deviations of it, in words.
    pub fn hits_in_words(&self, number: usize, amount: f64) -> String {
        let axis = |k: usize| ["x", "y", "z"][k];
        let size = amount.abs();
        match number {
            PLACES.. => {
                let (input, other) = across(number - PLACES);
                let mm = 1e3 * size * self.place_m;
                format!(
                    "hits along {} {mm:.0} mm beside the tool's point along {}",
                    axis(input),
                    axis(other)
                )
            }
            _ => {
                let (input, other) = across(number - Self::HITS.start);
                let degrees = size * self.hit_rad / DEGREE;
                format!(
                    "hits along {} turned by {degrees:.0}° towards {}",
                    axis(input),
                    axis(other)
                )
            }
        }
    }

    fn part(&self, number: usize) -> Part {
        let mut matrix = Matrix::default();
        match number {
            0..=2 => {
                matrix[number][number] = self.sensor;
                Part::Sensor(matrix)
            }
            3 => {
                (0..3).for_each(|i| matrix[i][i] = self.hammer);
                Part::Force(matrix)
            }
            4 => Part::Delay(self.delay_s),
            5..=7 => {
                let (i, j) = ((number - 4) % 3, (number - 3) % 3);
                (matrix[i][j], matrix[j][i]) = (self.mounting_rad, -self.mounting_rad);
                Part::Sensor(matrix)
            }
            8..PLACES => {
                let (input, other) = across(number - 8);
                matrix[other][input] = self.hit_rad;
                Part::Force(matrix)
            }
            _ => {
                // e_other × e_input is the third axis, either way
                let (input, other) = across(number - PLACES);
                let sign = if (other + 1) % 3 == input { 1.0 } else { -1.0 };
                matrix[3 - input - other][input] = sign * self.place_m;
                Part::Moment(matrix)
            }
        }
    }
}

impl Reading {
    /// With the numbers `amounts` (standard deviations), in the order of [`NUMBERS`].
    pub fn of(amounts: impl Iterator<Item = f64>, spread: &Spread) -> Self {
        let mut all = Self {
            sensor: ONE,
            force: ONE,
            moment: Matrix::default(),
            delay_s: 0.0,
        };
        for (number, amount) in amounts.enumerate() {
            match spread.part(number) {
                Part::Sensor(part) => add(&mut all.sensor, &part, amount),
                Part::Force(part) => add(&mut all.force, &part, amount),
                Part::Moment(part) => add(&mut all.moment, &part, amount),
                Part::Delay(part) => all.delay_s += amount * part,
            }
        }
        all
    }

    /// What is read of a change of the accelerance `a` at `s`, the hits where they are aimed at.
    pub fn read(&self, s: C64, a: &Response) -> Response {
        let late = C64::new(1.0, 0.0) - s * self.delay_s;
        through(&self.sensor, a, &self.force).map(|row| row.map(|x| x * late))
    }

    /// What is read at `s` of the accelerance `a`, with the acceleration `b` under moments.
    pub fn read_all(&self, s: C64, both: [&Response; 2]) -> Response {
        let late = C64::new(1.0, 0.0) - s * self.delay_s;
        self.in_time(&self.sensor, both)
            .map(|row| row.map(|x| x * late))
    }

    /// The same without the delay.
    fn in_time(&self, sensor: &Matrix, [a, b]: [&Response; 2]) -> Response {
        let forces = through(sensor, a, &self.force);
        let moments = through(sensor, b, &self.moment);
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| forces[i][j] + moments[i][j]))
    }

    /// Change of what is read of `a` and `b` with one of the numbers, per standard deviation.
    pub fn slope(
        &self,
        number: usize,
        spread: &Spread,
        s: C64,
        [a, b]: [&Response; 2],
    ) -> Response {
        let late = C64::new(1.0, 0.0) - s * self.delay_s;
        let (out, factor) = match spread.part(number) {
            Part::Sensor(part) => (self.in_time(&part, [a, b]), late),
            Part::Force(part) => (through(&self.sensor, a, &part), late),
            Part::Moment(part) => (through(&self.sensor, b, &part), late),
            Part::Delay(part) => (self.in_time(&self.sensor, [a, b]), -s * part),
        };
        out.map(|row| row.map(|x| x * factor))
    }
}

/// The direction of the hits, and one across it, of a number that counts two for each direction.
fn across(number: usize) -> (usize, usize) {
    let input = number / 2;
    (input, (input + 1 + number % 2) % 3)
}

fn add(sum: &mut Matrix, part: &Matrix, amount: f64) {
    let entries = sum.iter_mut().flatten().zip(part.iter().flatten());
    entries.for_each(|(sum, part)| *sum += amount * part);
}

/// `left · a · right`.
fn through(left: &Matrix, a: &Response, right: &Matrix) -> Response {
    let (mut half, mut out) = (Response::default(), Response::default());
    for i in 0..3 {
        for k in 0..3 {
            for j in 0..3 {
                half[i][j] += a[k][j] * left[i][k];
            }
        }
        for k in 0..3 {
            for j in 0..3 {
                out[i][j] += half[i][k] * right[k][j];
            }
        }
    }
    out
}
