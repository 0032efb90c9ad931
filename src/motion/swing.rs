//! Motion in time: M(q)q̈ + C(q,q̇) + G(q) = τ + Jᵀ F with τ = k·dead(θ−q, s/2) + d(θ̇−q̇)
//! (source 000, eqs. 2.1 and 2.2; the gap s from 004), and the hysteresis of the joints.
//!
//! Implicit midpoint rule with the joint torque as a discrete gradient, work over way
//! (Gonzalez 1996, eq. 16, per spring): stable at any stiffness; springs neither create nor lose
//! energy, not even at the edges of the gap, and dry contacts lose exactly what they lose.

use super::chain::Chain;
use super::dynamics::{composite, newton_euler};
use super::hinge_law::HingeLaw;
use super::kinematics::{column, place, tcp, weigh};
use super::statics::springs;
pub use super::swing_state::State;
use super::work::Work;
use crate::ground::cholesky;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, dot};
use crate::ground::stats::largest;

const ITERATIONS: usize = 40;
/// Change of speed per iteration, against the largest speed, at which a step is solved.
const SOLVED: f64 = 1e-12;
/// The same for a robot at rest, rad/s: rounding of the gravity torques.
const STILL: f64 = 1e-13;

/// Scratch space of [`step`].
#[derive(Debug, Clone)]
pub struct SwingWork {
    work: Work,
    elastic: Vec<usize>,
    laws: Vec<HingeLaw>,
    middle: [Vec<f64>; 3],
    speed: Vec<f64>,
    base: Vec<f64>,
    matrix: Vec<f64>,
    rest: Vec<f64>,
}

impl SwingWork {
    /// Scratch space for `chain`.
    pub fn new(chain: &Chain) -> Self {
        let elastic: Vec<usize> = springs(chain).map(|(i, _)| i).collect();
        let (n, m) = (chain.len(), elastic.len());
        Self {
            work: Work::new(chain),
            middle: [vec![0.0; n], vec![0.0; n], vec![0.0; n]],
            speed: vec![0.0; n],
            base: vec![0.0; m * m],
            matrix: vec![0.0; m * m],
            rest: vec![0.0; m],
            laws: springs(chain)
                .map(|(_, spring)| HingeLaw::of(spring))
                .collect(),
            elastic,
        }
    }
}

/// Energy in J; its sum stays where nothing damps and nothing drives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// Of motion.
    pub kinetic: f64,
    /// In the springs, and in contacts that stick.
    pub elastic: f64,
    /// Of height.
    pub potential: f64,
}

impl Energy {
    /// The sum.
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.potential
    }
}

/// One step of `h` seconds under `force` (N, at the tool, base frame, mean over the step) towards
/// the commands `joints` (rad, one per driven joint, at the end of the step).
///
/// # Errors
/// The step is not solved: it is too large for this motion.
pub fn step(
    chain: &Chain,
    space: &mut SwingWork,
    state: &mut State,
    h: f64,
    force: V3,
    joints: &[f64],
) -> Outcome<()> {
    let mut command = state.command.clone();
    chain
        .drives
        .iter()
        .zip(joints)
        .for_each(|(i, angle)| command[*i] = *angle);
    predict(chain, space, state, h, &command);
    prepare(chain, space, state, h);
    for _ in 0..ITERATIONS {
        let change = correct(chain, space, state, h, force, &command)?;
        if change <= SOLVED * largest(&space.speed) + STILL {
            advance(state, space, h, command);
            return Ok(());
        }
    }
    Err(too_large(h))
}

fn too_large(h: f64) -> Problem {
    Problem::new(
        format!("a time step of {h} s is not solved"),
        "choose a smaller step (`--step-s`)",
    )
}

/// Speeds at the end of the step: unchanged for elastic hinges, the command's for rigid ones.
fn predict(chain: &Chain, space: &mut SwingWork, state: &State, h: f64, command: &[f64]) {
    for (i, speed) in space.speed.iter_mut().enumerate() {
        *speed = match chain.springs[i] {
            Some(_) => state.v[i],
            None => (command[i] - state.command[i]) / h,
        };
    }
}

/// M/h + D/2 of the elastic hinges at the start of the step.
fn prepare(chain: &Chain, space: &mut SwingWork, state: &State, h: f64) {
    let (n, m) = (chain.len(), space.elastic.len());
    place(chain, &mut space.work, &state.angles());
    weigh(chain, &mut space.work);
    composite(chain, &mut space.work);
    for (row, i) in space.elastic.iter().enumerate() {
        for (other, j) in space.elastic.iter().enumerate() {
            space.base[row * m + other] = space.work.mass[i * n + j] / h;
        }
        space.base[row * m + row] += chain.springs[*i]
            .as_ref()
            .map_or(0.0, |spring| 0.5 * spring.damping);
    }
}

/// One Newton step on the speeds at the end; returns its largest change.
fn correct(
    chain: &Chain,
    space: &mut SwingWork,
    state: &State,
    h: f64,
    force: V3,
    command: &[f64],
) -> Outcome<f64> {
    middle(chain, space, state, h, command);
    let [q, v, a] = &space.middle;
    place(chain, &mut space.work, q);
    weigh(chain, &mut space.work);
    newton_euler(chain, &mut space.work, v, a);
    let at = tcp(chain, &space.work).point;
    let m = space.elastic.len();
    space.matrix.copy_from_slice(&space.base);
    for (row, i) in space.elastic.iter().enumerate() {
        let Some(spring) = &chain.springs[*i] else {
            continue;
        };
        let commanded = command[*i] - state.command[*i];
        let end = state.bend[*i] + h * v[*i] - commanded;
        let mean = space.laws[row].mean(&state.memory[row], -state.bend[*i], -end);
        let rate = commanded / h - v[*i];
        let pushed = dot(column(&space.work, *i, at).0, force);
        space.rest[row] = mean.torque + spring.damping * rate + pushed - space.work.out[*i];
        space.matrix[row * m + row] += 0.5 * h * mean.slope;
    }
    if !cholesky::factor(&mut space.matrix, m) {
        return Err(too_large(h));
    }
    cholesky::solve(&space.matrix, m, &mut space.rest);
    for (i, change) in space.elastic.iter().zip(&space.rest) {
        space.speed[*i] += change;
    }
    let largest = largest(&space.rest);
    if largest.is_finite() {
        Ok(largest)
    } else {
        Err(too_large(h))
    }
}

/// Angles, speeds and accelerations in the middle of the step.
fn middle(chain: &Chain, space: &mut SwingWork, state: &State, h: f64, command: &[f64]) {
    let [q, v, a] = &mut space.middle;
    for (i, end) in space.speed.iter().copied().enumerate() {
        let start = state.v[i];
        (v[i], q[i]) = match chain.springs[i] {
            Some(_) => (
                0.5 * (start + end),
                state.command[i] + state.bend[i] + 0.25 * h * (start + end),
            ),
            None => (end, 0.5 * (state.command[i] + command[i])),
        };
        a[i] = (end - start) / h;
    }
}

fn advance(state: &mut State, space: &SwingWork, h: f64, command: Vec<f64>) {
    for (row, i) in space.elastic.iter().enumerate() {
        let (start, commanded) = (state.bend[*i], command[*i] - state.command[*i]);
        state.bend[*i] += 0.5 * h * (state.v[*i] + space.speed[*i]) - commanded;
        space.laws[row].advance(&mut state.memory[row], -start, -state.bend[*i]);
    }
    state.v.copy_from_slice(&space.speed);
    state.command = command;
    state.time += h;
}

/// Energy of a state.
pub fn energy(chain: &Chain, space: &mut SwingWork, state: &State) -> Energy {
    let n = chain.len();
    place(chain, &mut space.work, &state.angles());
    weigh(chain, &mut space.work);
    composite(chain, &mut space.work);
    let work = &space.work;
    let momentum = |i: usize| {
        (0..n)
            .map(|j| work.mass[i * n + j] * state.v[j])
            .sum::<f64>()
    };
    let bodies = chain
        .hinges
        .iter()
        .zip(&work.inertia)
        .filter(|(hinge, _)| hinge.body.is_some());
    let height = bodies
        .map(|(_, i)| -dot(i.moment, chain.gravity) - i.mass * dot(work.reference, chain.gravity));
    Energy {
        kinetic: 0.5 * (0..n).map(|i| state.v[i] * momentum(i)).sum::<f64>(),
        elastic: space
            .laws
            .iter()
            .zip(&state.memory)
            .map(|(law, memory)| law.stored(memory))
            .sum(),
        potential: height.sum(),
    }
}

/// Displacement of the tool from where the commands alone would put it, m, base frame.
pub fn tool_offset(chain: &Chain, space: &mut SwingWork, state: &State) -> V3 {
    place(chain, &mut space.work, &state.command);
    let commanded = tcp(chain, &space.work).point;
    place(chain, &mut space.work, &state.angles());
    let actual = tcp(chain, &space.work).point;
    [0, 1, 2].map(|k| actual[k] - commanded[k])
}
