//! The accelerance of a linearised multibody model as hammer and sensor read it, with its derivatives by
//! analysis.

use super::frf_data::Measured;
pub use super::frf_parameter::Kind;
pub use super::frf_responses::{Responses, along};
use crate::ground::spatial::V3;
use crate::motion::Linear;
use crate::motion::frf::{C64, Response};
use crate::motion::receptance::{accelerance, coordinates, under_moments};
use crate::motion::uncertain::bodies;
use crate::motion::uncertain::instrument::{self, Reading, SHARED};
use crate::motion::uncertain::slopes::{Entry, of_entries, of_masses, whole};
use nalgebra::DMatrix;
use rustfft::num_complex::Complex64;

/// What its weight does to a robot: it sags, which turns its bodies and the directions in which its
/// joints move the tool, and weight adds stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct Weight {
    /// Change of the mass matrix (n × n).
    pub mass: DMatrix<f64>,
    /// Stiffness that weight adds (n × n).
    pub stiffness: DMatrix<f64>,
    /// Change of the Jacobian (3 × n).
    pub jacobian: DMatrix<f64>,
}

/// What is uncertain at one pose besides what is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertain {
    /// What each parameter of kind body adds to the mass matrix: one row each, its upper triangle by rows.
    pub bodies: DMatrix<f64>,
    /// How well hammer and sensor are known.
    pub instrument: instrument::Spread,
    /// Turn of the tool per coordinate, rad/rad, base axes: a hit beside its point is a moment too.
    pub turn: Vec<V3>,
    /// Which pose this is, counted from 0: each has its own parameters of kind instrument.
    pub pose: usize,
}

/// The model at one pose, in n generalised coordinates: `Z = s²M + sD + K + Σ θₚ·sᵏ·Gₚ`, Gₚ symmetric.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    /// Mass matrix M (n × n) without the tuned part.
    pub mass: DMatrix<f64>,
    /// Damping matrix D (n × n) without the tuned part.
    pub damping: DMatrix<f64>,
    /// Stiffness matrix K (n × n) without the tuned part.
    pub stiffness: DMatrix<f64>,
    /// Translation of the tool per coordinate, m (3 × n, base axes): forces act and accelerations are
    /// taken along its rows.
    pub jacobian: DMatrix<f64>,
    /// `∂(matrix)/∂θ` of every parameter (n × n) that multiplies one, in the order of the parameters;
    /// empty for the others.
    pub directions: Vec<DMatrix<f64>>,
    /// What a parameter of kind weight multiplies.
    pub weight: Option<Weight>,
    /// What parameters of the kinds body and instrument do; none: there are none.
    pub uncertain: Option<Uncertain>,
    /// What was measured here.
    pub measured: Vec<Measured>,
}

impl Pose {
    /// Accelerance of a measured pair at the values `theta`, (m/s²)/N, per line; none where the
    /// dynamic stiffness is singular.
    pub fn accelerance(
        &self,
        kinds: &[Kind],
        theta: &[f64],
        pair: &Measured,
    ) -> Option<Vec<Complex64>> {
        Some(self.responses(kinds, theta, pair)?.of(pair))
    }

    /// Accelerance and its derivatives in every parameter.
    pub fn sensitivities(
        &self,
        kinds: &[Kind],
        theta: &[f64],
        pair: &Measured,
    ) -> Option<(Vec<Complex64>, Vec<Vec<Complex64>>)> {
        let responses = self.responses(kinds, theta, pair)?;
        let slopes = self.slopes(&responses, kinds, &self.entries());
        let slopes = slopes.iter().map(|lines| along(pair, lines));
        Some((responses.of(pair), slopes.collect()))
    }

    /// The model on the lines of `pair`; none where the dynamic stiffness is singular.
    pub fn responses(&self, kinds: &[Kind], theta: &[f64], pair: &Measured) -> Option<Responses> {
        let linear = self.linear(kinds, theta);
        let s: Vec<C64> = (0..pair.frequency_hz.len()).map(|k| pair.s(k)).collect();
        let answers = coordinates(&linear, &s);
        let line = |(k, s): (usize, &C64)| {
            let own = &answers[k * linear.n..(k + 1) * linear.n];
            [accelerance, under_moments].map(|of| of(&linear, own, *s))
        };
        let bare: Vec<[Response; 2]> = s.iter().enumerate().map(line).collect();
        let finite = |[a, _]: &[Response; 2]| {
            a.iter()
                .flatten()
                .all(|x| x.re.is_finite() && x.im.is_finite())
        };
        bare.iter().all(finite).then(|| Responses {
            reading: self.reading(kinds, theta),
            linear,
            s,
            answers,
            bare,
        })
    }

    /// Change of what is read with the value of each parameter: `[parameter][line]`. `entries`:
    /// [`Pose::entries`].
    pub fn slopes(
        &self,
        responses: &Responses,
        kinds: &[Kind],
        entries: &[Vec<Entry>],
    ) -> Vec<Vec<Response>> {
        let answers = (&responses.answers[..], responses.linear.n);
        let read = |lines: Vec<_>| responses.read(lines.iter().map(whole));
        let known = self.uncertain.as_ref();
        let known = known.filter(|_| kinds.contains(&Kind::Body));
        let bodies = known.map(|known| of_masses(&known.bodies, answers, &responses.s));
        let mut bodies = bodies.into_iter().flatten();
        let mut instrument = 0..;
        let slope = |(kind, entries): (&Kind, &Vec<Entry>)| match kind {
            Kind::Weight => self.slope_of_weight(responses),
            Kind::Body => read(bodies.next().unwrap_or_default()),
            Kind::Instrument => self.slope_of_instrument(responses, instrument.next()),
            _ => read(of_entries(
                entries,
                |s| kind.factor(s),
                answers,
                &responses.s,
            )),
        };
        kinds.iter().zip(entries).map(slope).collect()
    }

    /// `∂H/∂w = s²·(ΔJY + (ΔJY)ᵀ) − s²·Yᵀ(s²ΔM + ΔK)Y`.
    fn slope_of_weight(&self, responses: &Responses) -> Vec<Response> {
        let Some(weight) = &self.weight else {
            return vec![Response::default(); responses.s.len()];
        };
        let n = responses.linear.n;
        let line = |(k, s): (usize, &C64)| {
            let y = responses.at(k);
            let mut out = Response::default();
            for i in 0..n {
                let mut force = [C64::default(); 3];
                for (j, y) in y.iter().enumerate() {
                    let z = s * s * weight.mass[(i, j)] + weight.stiffness[(i, j)];
                    force.iter_mut().zip(y).for_each(|(f, y)| *f += z * y);
                }
                for (a, row) in out.iter_mut().enumerate() {
                    for (b, entry) in row.iter_mut().enumerate() {
                        let turned =
                            y[i][b] * weight.jacobian[(a, i)] + y[i][a] * weight.jacobian[(b, i)];
                        *entry += turned - y[i][a] * force[b];
                    }
                }
            }
            out.map(|row| row.map(|x| x * s * s))
        };
        responses.read(responses.s.iter().enumerate().map(line))
    }

    /// The slope in one parameter of kind instrument: nothing where it belongs to another pose.
    fn slope_of_instrument(&self, responses: &Responses, number: Option<usize>) -> Vec<Response> {
        let lines = || responses.bare.iter().zip(&responses.s);
        let own = self.uncertain.as_ref().zip(number);
        let own = own.and_then(|(known, number)| Some((known, known.own(number)?)));
        match own {
            Some((known, number)) => lines()
                .map(|([a, b], s)| {
                    let reading = &responses.reading;
                    reading.slope(number, &known.instrument, *s, [a, b])
                })
                .collect(),
            None => vec![Response::default(); responses.s.len()],
        }
    }

    fn reading(&self, kinds: &[Kind], theta: &[f64]) -> Reading {
        let nothing = instrument::Spread::calibrated(0.0);
        let Some(uncertain) = &self.uncertain else {
            return Reading::of(std::iter::empty(), &nothing);
        };
        let mut amounts = [0.0; instrument::NUMBERS];
        for (number, value) in of_kind(kinds, theta, Kind::Instrument).enumerate() {
            if let Some(own) = uncertain.own(number) {
                amounts[own] = value;
            }
        }
        Reading::of(amounts.into_iter(), &uncertain.instrument)
    }

    /// Where each direction is not zero.
    pub fn entries(&self) -> Vec<Vec<Entry>> {
        let filled = |direction: &DMatrix<f64>| {
            let n = direction.nrows();
            let all = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
            let entry = |(i, j): (usize, usize)| (i, j, direction[(i, j)]);
            all.map(entry)
                .filter(|(_, _, value)| *value != 0.0)
                .collect()
        };
        self.directions.iter().map(filled).collect()
    }

    /// The matrices at the values `theta`.
    fn linear(&self, kinds: &[Kind], theta: &[f64]) -> Linear {
        let [mut mass, mut damping, mut stiffness] =
            [&self.mass, &self.damping, &self.stiffness].map(DMatrix::clone);
        let mut jacobian = self.jacobian.clone();
        for ((kind, value), direction) in kinds.iter().zip(theta).zip(&self.directions) {
            let matrix = match (kind, &self.weight) {
                (Kind::Mass, _) => &mut mass,
                (Kind::Damping, _) => &mut damping,
                (Kind::Stiffness, _) => &mut stiffness,
                (Kind::Weight, Some(weight)) => {
                    mass += &weight.mass * *value;
                    stiffness += &weight.stiffness * *value;
                    jacobian += &weight.jacobian * *value;
                    continue;
                }
                _ => continue,
            };
            matrix.zip_apply(direction, |entry, d| *entry += value * d);
        }
        let mut mass = rows(&mass);
        if let Some(uncertain) = &self.uncertain {
            let amounts = of_kind(kinds, theta, Kind::Body);
            bodies::add(&mut mass, &uncertain.bodies, amounts);
        }
        Linear {
            n: self.mass.nrows(),
            names: Vec::new(),
            mass,
            damping: rows(&damping),
            stiffness: rows(&stiffness),
            tool: jacobian
                .column_iter()
                .map(|c| -> V3 { [c[0], c[1], c[2]] })
                .collect(),
            turn: self
                .uncertain
                .as_ref()
                .map_or(Vec::new(), |u| u.turn.clone()),
        }
    }
}

impl Uncertain {
    /// Which number of this pose's instruments a parameter of kind instrument is.
    fn own(&self, number: usize) -> Option<usize> {
        let first = (instrument::NUMBERS - SHARED) * self.pose;
        match number < SHARED {
            true => Some(number),
            false => number
                .checked_sub(first)
                .filter(|own| (SHARED..instrument::NUMBERS).contains(own)),
        }
    }
}

/// The values of the parameters of one kind.
fn of_kind<'a>(kinds: &'a [Kind], theta: &'a [f64], kind: Kind) -> impl Iterator<Item = f64> + 'a {
    let all = kinds.iter().zip(theta);
    all.filter(move |(own, _)| **own == kind)
        .map(|(_, value)| *value)
}

fn rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}
