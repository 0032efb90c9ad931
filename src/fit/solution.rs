//! A fitted model: parameters, covariance, noise, and what the data do not fix.

use super::least_squares::{Optimum, Problem, minimise};
use super::observation::Observation;
use super::parameter::{Identified, Status, Z95};
use super::starts::starts;
use crate::effects::composite::Slot;
use crate::effects::{Composite, Scale};
use crate::ground::products::gram;
use crate::ground::stats::{difference, rms};
use crate::inference::descent::Stop;
use crate::measurement::load_cycle::Port;
use crate::signal::colour::Colour;
use nalgebra::DMatrix;

/// A fitted model.
pub struct Solution {
    /// The model.
    pub model: Composite,
    /// Parameters, SI.
    pub p: Vec<f64>,
    /// Their covariance, SI; infinite variance for what the data do not fix.
    pub covariance: DMatrix<f64>,
    /// The same as if no amplitude sat on a bound: how far from there the truth may be.
    pub reach: DMatrix<f64>,
    /// What the data say of each.
    pub status: Vec<Status>,
    /// The noise they left.
    pub colour: Colour,
    /// Reading − model, every row.
    pub residual: Vec<f64>,
    /// Root mean square of the residual.
    pub rms: f64,
}

/// Relative standard error beyond which a parameter counts as not supported by the data.
pub(super) const UNSUPPORTED: f64 = 0.5;
/// The same for shapes, in which laws are far from linear: beyond, an interval by linearisation is
/// not to be trusted.
const UNSUPPORTED_SHAPE: f64 = 0.15;

/// Fits a composite to an observation, noise colour included.
pub fn fit(model: &Composite, data: &Observation) -> Solution {
    fit_from(
        model,
        data,
        &starts(model, data, 4),
        &vec![false; data.rows()],
    )
}

/// Fits from several starts, leaving out the ignored rows.
pub fn fit_from(
    model: &Composite,
    data: &Observation,
    starts: &[Vec<f64>],
    ignored: &[bool],
) -> Solution {
    fit_until(model, data, starts, ignored, Stop::default())
}

/// The same, every descent ended by `stop`.
pub fn fit_until(
    model: &Composite,
    data: &Observation,
    starts: &[Vec<f64>],
    ignored: &[bool],
    stop: Stop,
) -> Solution {
    let mut colour = Colour::white(data.rows(), data.scene.deflection_scale * 1e-3);
    let mut starts = starts.to_vec();
    let mut optimum = None;
    for _round in 0..3 {
        let problem = Problem {
            model,
            data,
            colour: &colour,
            ignored,
        };
        let best = starts
            .iter()
            .map(|start| minimise(&problem, start, stop))
            .filter(|optimum| optimum.chi2.is_finite())
            .min_by(|a, b| a.chi2.total_cmp(&b.chi2));
        let Some(best) = best else { break };
        colour = noise_of(&problem, &best);
        starts = vec![best.p.clone()];
        optimum = Some(best);
    }
    let problem = Problem {
        model,
        data,
        colour: &colour,
        ignored,
    };
    let last = minimise(&problem, &starts[0], stop);
    conclude(&problem, optimum.map_or(last.clone(), |_| last))
}

/// Noise from the residual of an optimum, with the freedom that the fit used up put back.
pub fn noise_of(problem: &Problem, optimum: &Optimum) -> Colour {
    let mut coefficients = problem.residual(&optimum.p);
    for (c, s) in coefficients.iter_mut().zip(&problem.colour.sigma) {
        *c *= s;
    }
    let left_out = problem.ignored.iter().filter(|i| **i).count() as f64;
    let share = 1.0 - left_out / problem.ignored.len().max(1) as f64;
    let freedom: Vec<f64> = leverage(&optimum.jacobian)
        .iter()
        .map(|h| (share - h).max(0.0))
        .collect();
    Colour::estimate(&coefficients, &freedom)
}

/// Diagonal of the projection onto the columns.
fn leverage(jacobian: &DMatrix<f64>) -> Vec<f64> {
    let q = jacobian.clone().qr().q();
    (0..q.nrows())
        .map(|i| q.row(i).norm_squared().min(1.0))
        .collect()
}

/// A solution found by plain least squares, its covariance widened for noise of another colour:
/// (JᵀJ)⁻¹ JᵀSJ (JᵀJ)⁻¹ (White 1980), S the noise variance over the one assumed.
pub fn conclude_with(problem: &Problem, optimum: Optimum, colour: Colour) -> Solution {
    let mut weighed = optimum.jacobian.clone();
    for (k, (actual, assumed)) in colour.sigma.iter().zip(&problem.colour.sigma).enumerate() {
        weighed.row_mut(k).scale_mut(actual / assumed);
    }
    for (j, scale) in optimum.scale.iter().enumerate() {
        weighed.column_mut(j).scale_mut(1.0 / scale);
    }
    let score = gram(&weighed);
    let widened = |pinned: bool| {
        let narrow = covariance(problem.model, &optimum, pinned);
        &narrow * &score * &narrow
    };
    let (covariance, reach) = (widened(true), widened(false));
    let status = judge(problem.model, &optimum, &covariance);
    Solution {
        covariance,
        reach,
        status,
        colour,
        ..conclude(problem, optimum)
    }
}

fn conclude(problem: &Problem, optimum: Optimum) -> Solution {
    let predicted = problem.model.predict(&optimum.p, &problem.data.scene);
    let residual: Vec<f64> = difference(&problem.data.reading, &predicted);
    let counted: Vec<f64> = residual
        .iter()
        .zip(problem.ignored)
        .filter(|(_, i)| !**i)
        .map(|(r, _)| *r)
        .collect();
    let rms = rms(&counted);
    let pinned = covariance(problem.model, &optimum, true);
    Solution {
        model: problem.model.clone(),
        status: judge(problem.model, &optimum, &pinned),
        reach: covariance(problem.model, &optimum, false),
        covariance: pinned,
        colour: problem.colour.clone(),
        rms,
        residual,
        p: optimum.p,
    }
}

/// (JᵀJ)⁻¹ over the free parameters; directions the data do not see get infinite variance.
///
/// A shape that ended on a bound still widens the others: the truth need not lie on that bound.
/// Amplitudes on a bound are known to lie there if `pinned`.
fn covariance(model: &Composite, optimum: &Optimum, pinned: bool) -> DMatrix<f64> {
    let slots = model.slots();
    let counts = |j: &usize| !pinned || optimum.active[*j] == 0 || !slots[*j].amplitude;
    let free: Vec<usize> = (0..optimum.p.len()).filter(counts).collect();
    let n = optimum.p.len();
    let columns = optimum.jacobian.select_columns(&free);
    let mut covariance = DMatrix::zeros(n, n);
    let normal = columns.transpose() * &columns;
    if normal.is_empty() || !normal.iter().all(|v| v.is_finite()) {
        free.iter()
            .for_each(|j| covariance[(*j, *j)] = f64::INFINITY);
        return covariance;
    }
    let eigen = normal.symmetric_eigen();
    let largest = eigen.eigenvalues.iter().fold(0.0_f64, |m, v| m.max(*v));
    for (k, value) in eigen.eigenvalues.iter().enumerate() {
        let vector = eigen.eigenvectors.column(k);
        let variance = if *value > 1e-13 * largest {
            1.0 / value
        } else {
            f64::INFINITY
        };
        for (a, i) in free.iter().enumerate() {
            for (b, j) in free.iter().enumerate() {
                let weight = vector[a] * vector[b];
                if weight.abs() > 1e-9 || variance.is_finite() {
                    covariance[(*i, *j)] +=
                        weight * variance * optimum.scale[*i] * optimum.scale[*j];
                }
            }
        }
    }
    covariance
}

fn judge(model: &Composite, optimum: &Optimum, covariance: &DMatrix<f64>) -> Vec<Status> {
    let mut amplitude_lives = true;
    let mut statuses = Vec::new();
    for (j, slot) in model.slots().iter().enumerate() {
        let std = covariance[(j, j)].sqrt();
        let value = optimum.p[j];
        if slot.amplitude {
            amplitude_lives = optimum.active[j] == 0 && value.abs() > 2.0 * std;
        }
        let loose = match slot.amplitude {
            true => {
                !std.is_finite()
                    || (slot.parameter.scale == Scale::Stiffness && std > UNSUPPORTED * value.abs())
            }
            false => !std.is_finite() || std > UNSUPPORTED_SHAPE * value.abs(),
        };
        statuses.push(match () {
            () if optimum.active[j] != 0 && (slot.amplitude || amplitude_lives) => Status::AtBound,
            () if loose || !amplitude_lives && !slot.amplitude => Status::NotIdentifiable,
            () => Status::Identified,
        });
    }
    statuses
}

impl Solution {
    /// The place of a cause's amplitude among the parameters.
    pub fn amplitude_of(&self, cause: &str) -> Option<usize> {
        let is_it = |s: &Slot| s.amplitude && s.effect.card().cause == cause;
        self.model.slots().iter().position(is_it)
    }

    /// Standard error of parameter j, SI.
    pub fn stderr(&self, j: usize) -> f64 {
        self.covariance[(j, j)].sqrt()
    }

    /// Largest value of parameter j that the data allow (95 %), also where it sits on a bound.
    pub fn limit(&self, j: usize) -> f64 {
        self.p[j] + Z95 * self.reach[(j, j)].sqrt()
    }

    /// The parameters as they are reported.
    pub fn parameters(&self, site: &str, port: Port) -> Vec<Identified> {
        let slots = self.model.slots();
        let report = |(j, slot): (usize, &Slot)| {
            let unit = unit_of(slot.parameter.scale, port);
            let (name, meaning) = (slot.parameter.name, slot.parameter.meaning);
            let value = Identified::new(name, site, self.p[j], unit, self.stderr(j), meaning);
            let vanishing = slot.may_vanish() && (value.may_be_zero() || self.p[j] <= 0.0);
            match self.status[j] {
                Status::AtBound if vanishing => value.limited(Status::AtBound, self.limit(j)),
                Status::Identified if vanishing => {
                    value.limited(Status::NotIdentifiable, self.limit(j))
                }
                Status::AtBound if slot.amplitude => value.limited(Status::AtBound, 0.0),
                Status::Identified => value,
                Status::NotIdentifiable if slot.may_vanish() => {
                    value.limited(Status::NotIdentifiable, self.limit(j))
                }
                other => value.without_value(other),
            }
        };
        slots.iter().enumerate().map(report).collect()
    }
}

/// The unit of a scale at a port, as printed.
pub fn unit_of(scale: Scale, port: Port) -> &'static str {
    match scale {
        Scale::Load => port.load_unit(),
        Scale::Deflection => port.deflection_unit(),
        Scale::Stiffness => port.stiffness_unit(),
        Scale::Period | Scale::Duration => "s",
        Scale::One => "1",
    }
}
