//! How the tip follows a commanded motion of the soft robot, and what to command so that it goes where it
//! should: learning beyond the pace at which springs alone follow.
//!
//! With the elastic coordinates x of the robot at a pose, M ẍ + D ẋ + K x = −M_q q̈ while the drives move
//! by q, the tip moves by r + J x: T(ω) = 1 + ω² J (K + jωD − ω²M)⁻¹ M_q J_q⁻¹. What is left is passed
//! through the regularised inverse of T below the pace at which the controller can still command.
//!
//! Where a mode answers thirty times and more, its inverse is right only where its frequency is: half a hertz beside it the
//! tip answers with the other sign, and learning drives the swing that it should take away. The inverse is the one that
//! leaves least on average over how well frequencies are known, `L = (E[TᴴT] + c)⁻¹ E[T]ᴴ`: whatever the frequency, E|1 − TL|² is below 1.

use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, rotate};
use crate::motion::kinematics::{jacobian, place};
use crate::motion::{Chain, Work};
use crate::process::setup::Setup;
use crate::process::way::Way;
use nalgebra::{Complex, DMatrix, Matrix3, Matrix6, Vector3};
use rayon::prelude::*;
use rustfft::FftPlanner;
use std::f64::consts::{PI, TAU};

type C = Complex<f64>;

/// Step of the learned signal, s.
pub const STEP_S: f64 = 4e-3;
/// Samples of one piece of the motion; pieces overlap by half, each with the robot at its middle.
const PIECE: usize = 256;
/// Samples of its spectrum: what it answers before and after has room.
const PADDED: usize = 1024;
/// Frequency up to which everything is learned, and from which on nothing is, Hz: a controller that
/// interpolates every 12 ms commands no more.
const LEARNED_HZ: [f64; 2] = [14.0, 26.0];
/// What the inverse of T gives away to stay calm where the tip hardly answers.
const CALM: f64 = 0.05;
/// Relative standard deviation of a frequency of the robot at a place: modes move by a hundredth or two within a piece, and the
/// cut holds the tool. With none, learning without taking anything back diverges on the example's first square (0.65, 0.40,
/// 0.59, 1.2, 2.7 mm), with 0.01 it stays, with 0.02 it falls to 0.16 mm; 0.04 learns too slowly.
const DETUNED: f64 = 0.02;
/// Places, in standard deviations, at which the average over frequencies is taken.
const NODES: [f64; 9] = [-2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0];

/// How a robot answers along a motion, inverted: one list of inverses, bin by bin, per piece of it.
pub struct Answers {
    pieces: Vec<Vec<Matrix3<C>>>,
    /// Samples of the motion.
    samples: usize,
}

impl Answers {
    /// Along the motion of a job.
    ///
    /// # Errors
    /// A robot in which nothing is elastic.
    pub fn of(setup: &Setup, chain: &Chain) -> Outcome<Self> {
        let ([begin, end], samples) = (setup.way.span(), samples(&setup.way));
        let of_piece = |i: usize| {
            let middle = begin + STEP_S * (first(i) as f64 + 0.5 * PIECE as f64);
            let joints = setup.way.at(middle.clamp(begin, end)).joints;
            inverses(setup, chain, &joints)
        };
        let pieces: Vec<_> = (0..count(samples)).into_par_iter().map(of_piece).collect();
        Ok(Self {
            pieces: pieces.into_iter().collect::<Outcome<_>>()?,
            samples,
        })
    }

    /// What to command so that the tip answers with `wanted` (one vector per [`STEP_S`] from the begin of the
    /// motion, m, workpiece frame). The motion may be a little longer or shorter than the one that this is of.
    pub fn command(&self, wanted: &[V3]) -> Vec<V3> {
        let pieces = count(wanted.len());
        let answer = |i: usize| {
            let own: Vec<V3> = (0..PIECE)
                .map(|k| {
                    let window = (PI * (k as f64 + 0.5) / PIECE as f64).sin().powi(2);
                    let at = usize::try_from(first(i) + k as i64).ok();
                    let value = at.and_then(|at| wanted.get(at)).copied();
                    value.unwrap_or_default().map(|x| window * x)
                })
                .collect();
            let still = own.iter().flatten().all(|x| *x == 0.0);
            let there = there(i, self.samples, wanted.len());
            (!still).then(|| piece(&self.pieces[there.min(self.pieces.len() - 1)], &own))
        };
        let answers: Vec<_> = (0..pieces).into_par_iter().map(answer).collect();
        let mut sum = vec![[0.0; 3]; wanted.len()];
        for (i, answer) in answers.into_iter().enumerate() {
            let begin = first(i) - ((PADDED - PIECE) / 2) as i64;
            for (k, value) in answer.into_iter().flatten().enumerate() {
                let at = usize::try_from(begin + k as i64).ok();
                if let Some(place) = at.and_then(|at| sum.get_mut(at)) {
                    (0..3).for_each(|c| place[c] += value[c]);
                }
            }
        }
        sum
    }
}

/// The piece of a motion of `samples` whose middle is nearest to that of a piece of the same motion in `now` samples.
fn there(piece: usize, samples: usize, now: usize) -> usize {
    (piece as f64 * samples as f64 / now.max(1) as f64).round() as usize
}

/// Samples of a motion, one per [`STEP_S`] from its begin.
pub fn samples(way: &Way) -> usize {
    let [begin, end] = way.span();
    ((end - begin) / STEP_S).ceil() as usize + 1
}

/// Pieces of a motion of so many samples.
fn count(samples: usize) -> usize {
    samples.div_ceil(PIECE / 2) + 1
}

/// First sample of a piece: half of the first one lies before the motion.
fn first(piece: usize) -> i64 {
    (piece * PIECE / 2) as i64 - (PIECE / 2) as i64
}

/// One piece, padded to both sides.
fn piece(inverses: &[Matrix3<C>], own: &[V3]) -> Vec<V3> {
    let mut planner = FftPlanner::new();
    let (forth, back) = (
        planner.plan_fft_forward(PADDED),
        planner.plan_fft_inverse(PADDED),
    );
    let lead = (PADDED - PIECE) / 2;
    let mut signals: [Vec<C>; 3] = std::array::from_fn(|c| {
        let mut signal = vec![C::new(0.0, 0.0); PADDED];
        own.iter()
            .enumerate()
            .for_each(|(k, v)| signal[lead + k].re = v[c]);
        forth.process(&mut signal);
        signal
    });
    let answered = |bin: usize| {
        let mirrored = bin > PADDED / 2;
        let positive = if mirrored { PADDED - bin } else { bin };
        let value = Vector3::from_fn(|c, _| signals[c][bin]);
        match inverses.get(positive) {
            Some(inverse) if mirrored => inverse.map(|x| x.conj()) * value,
            Some(inverse) => inverse * value,
            None => Vector3::zeros(),
        }
    };
    let answers: Vec<Vector3<C>> = (0..PADDED).map(answered).collect();
    for (c, signal) in signals.iter_mut().enumerate() {
        signal.iter_mut().zip(&answers).for_each(|(s, a)| *s = a[c]);
    }
    for signal in &mut signals {
        back.process(signal);
    }
    let scale = 1.0 / PADDED as f64;
    (0..PADDED)
        .map(|k| [0, 1, 2].map(|c| scale * signals[c][k].re))
        .collect()
}

/// Low-passed regularised inverses of T, bin by bin, at joint angles.
fn inverses(setup: &Setup, chain: &Chain, joints: &[f64]) -> Outcome<Vec<Matrix3<C>>> {
    let robot = Commanded::of(setup, chain, joints)?;
    let bins = (LEARNED_HZ[1] * STEP_S * PADDED as f64).floor() as usize;
    let inverse = |bin: usize| {
        let hz = bin as f64 / (STEP_S * PADDED as f64);
        let (mean, square) = detuned(&robot, TAU * hz);
        let square = square + Matrix3::identity() * C::from(CALM * share(hz));
        let solved = square.try_inverse().map(|s| s * mean.adjoint());
        solved.unwrap_or_else(Matrix3::identity) * C::from(passed(hz))
    };
    Ok((0..=bins).map(inverse).collect())
}

/// E[T] and E[TᴴT] over how well frequencies are known.
fn detuned(robot: &Commanded, omega: f64) -> (Matrix3<C>, Matrix3<C>) {
    let weights = NODES.map(|z| (-0.5 * z * z).exp());
    let all: f64 = weights.iter().sum();
    let (mut mean, mut square) = (Matrix3::zeros(), Matrix3::zeros());
    for (z, weight) in NODES.into_iter().zip(weights) {
        let own = robot.transfer(omega * (1.0 + DETUNED * z));
        let weight = C::from(weight / all);
        mean += own * weight;
        square += own.adjoint() * own * weight;
    }
    (mean, square)
}

/// Regularised only where masses matter.
fn share(hz: f64) -> f64 {
    (hz / LEARNED_HZ[0]).min(1.0).powi(2)
}

fn passed(hz: f64) -> f64 {
    let [full, none] = LEARNED_HZ;
    let x = ((hz - full) / (none - full)).clamp(0.0, 1.0);
    0.5 * (1.0 + (PI * x).cos())
}

/// The robot at a pose, as its drives command it.
struct Commanded {
    mass: DMatrix<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    /// Tip per elastic coordinate, 3×n.
    tip: DMatrix<f64>,
    /// Load on the elastic coordinates per acceleration of the commanded tip, n×3.
    moved: DMatrix<f64>,
}

impl Commanded {
    fn of(setup: &Setup, chain: &Chain, joints: &[f64]) -> Outcome<Self> {
        let mut carrier = setup.carrier();
        let linear = carrier.held(joints)?.linear;
        let n = linear.n;
        let square = |values: &[f64]| DMatrix::from_row_slice(n, n, values);
        let still = vec![0.0; joints.len()];
        let weight = carrier.carried(joints, &still, &still);
        let column = |k: usize| {
            let mut unit = still.clone();
            unit[k] = 1.0;
            carrier.carried(joints, &still, &unit)
        };
        let loads: Vec<Vec<f64>> = (0..joints.len()).map(column).collect();
        let per_joint = DMatrix::from_fn(n, joints.len(), |i, k| loads[k][i] - weight[i]);
        let driven = driven(setup, chain, joints);
        Ok(Self {
            mass: square(&linear.mass),
            damping: square(&linear.damping),
            stiffness: square(&linear.stiffness),
            tip: DMatrix::from_fn(3, n, |c, i| linear.tool[i][c]),
            moved: per_joint * driven,
        })
    }

    /// T at ω, rad/s.
    fn transfer(&self, omega: f64) -> Matrix3<C> {
        let complex = |m: &DMatrix<f64>, factor: C| m.map(|x| factor * x);
        let dynamic = complex(&self.stiffness, C::new(1.0, 0.0))
            + complex(&self.damping, C::new(0.0, omega))
            - complex(&self.mass, C::new(omega * omega, 0.0));
        let loads = complex(&self.moved, C::new(omega * omega, 0.0));
        let bent = dynamic.lu().solve(&loads);
        let tip = bent.map(|bent| complex(&self.tip, C::new(1.0, 0.0)) * bent);
        let mut t = Matrix3::identity();
        if let Some(tip) = tip {
            for r in 0..3 {
                for c in 0..3 {
                    t[(r, c)] += tip[(r, c)];
                }
            }
        }
        t
    }
}

/// Joint motion per motion of the tip, the hand held: 6×3, rad/m, workpiece axes.
fn driven(setup: &Setup, chain: &Chain, joints: &[f64]) -> DMatrix<f64> {
    /// Damping of the inverse at a singular pose, m²/rad².
    const SINGULAR: f64 = 1e-6;
    let mut work = Work::new(chain);
    place(chain, &mut work, joints);
    let columns = jacobian(chain, &work);
    let full = Matrix6::from_fn(|r, c| columns.get(c).map_or(0.0, |column| column[r]));
    let square = full.transpose() * full + Matrix6::identity() * SINGULAR;
    let inverse = square.try_inverse().map(|s| s * full.transpose());
    let inverse = inverse.unwrap_or_else(Matrix6::zeros);
    let axes: [V3; 3] = std::array::from_fn(|k| {
        let unit = [0, 1, 2].map(|i| f64::from(u8::from(i == k)));
        rotate(&setup.workpiece, unit)
    });
    DMatrix::from_fn(joints.len(), 3, |joint, k| {
        (0..3).map(|r| inverse[(joint, r)] * axes[k][r]).sum()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_finds_the_pose_that_it_is_at_in_a_longer_motion_too() {
        assert!((0..count(1280)).all(|i| there(i, 1280, 1280) == i));
        assert!((0..count(1281)).all(|i| there(i, 1280, 1281) == i));
        assert_eq!(there(50, 6400, 6528), 49);
        assert_eq!(there(0, 1, 0), 0);
    }
}
