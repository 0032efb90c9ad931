//! Forward dynamics: accelerations from torques.

use super::chain::Chain;
use super::dynamics::{base_acceleration, inertial_force};
use super::kinematics::{place, weigh};
use super::work::Work;
use crate::ground::dual::Scalar;
use crate::ground::spatial::{Force, Inertia, Motion};

/// Accelerations (n, rad/s²) for angles, speeds and torques: articulated bodies (Featherstone 2008,
/// table 7.1) in one inertial frame, where they need no coordinate changes and beat a factorised
/// mass matrix at 6 as at 18 hinges. Weight and velocity products go in as body forces first, so
/// that only M q̈ = τ − C − G is left to the recursion.
pub fn aba<'w, S: Scalar>(
    chain: &Chain,
    work: &'w mut Work<S>,
    q: &[S],
    v: &[S],
    torque: &[S],
) -> &'w [S] {
    place(chain, work, q);
    weigh(chain, work);
    body_forces(chain, work, v);
    articulate(chain, work, torque);
    accelerate(chain, work);
    &work.out
}

/// Force of each body at zero joint accelerations.
fn body_forces<S: Scalar>(chain: &Chain, work: &mut Work<S>, v: &[S]) {
    let (mut speed, mut rate) = (Motion::zero(), base_acceleration(chain));
    for (i, joint) in v.iter().enumerate().take(chain.len()) {
        let screw = work.screw[i];
        speed = speed.plus(*joint, &screw);
        rate = rate.plus(*joint, &speed.cross(&screw));
        if chain.hinges[i].body.is_some() {
            work.force[i] = inertial_force(&work.inertia[i], &speed, &rate);
        }
    }
}

/// Articulated inertia and force, from the tip to the base.
fn articulate<S: Scalar>(chain: &Chain, work: &mut Work<S>, torque: &[S]) {
    let zero = S::constant(0.0);
    let (mut inertia, mut force) = ([[zero; 6]; 6], [zero; 6]);
    for i in (0..chain.len()).rev() {
        if chain.hinges[i].body.is_some() {
            add_body(&mut inertia, &work.inertia[i]);
            let own = six_force(&work.force[i]);
            (0..6).for_each(|k| force[k] += own[k]);
        }
        let screw = six(&work.screw[i]);
        let u = times(&inertia, &screw);
        let d = S::constant(1.0) / dot6(&u, &screw);
        let rest = torque[i] - dot6(&force, &screw);
        (work.u[i], work.d[i]) = (u, (d, rest));
        release(&mut inertia, &u, d);
        let share = d * rest;
        (0..6).for_each(|k| force[k] += u[k] * share);
    }
}

/// I − u uᵀ/d: what the outboard part feels like through a free hinge.
#[inline(always)]
fn release<S: Scalar>(inertia: &mut [[S; 6]; 6], u: &[S; 6], d: S) {
    for (row, left) in inertia.iter_mut().zip(u) {
        let scaled = *left * d;
        (0..6).for_each(|k| row[k] -= scaled * u[k]);
    }
}

/// Accelerations from the base to the tip.
fn accelerate<S: Scalar>(chain: &Chain, work: &mut Work<S>) {
    let mut rate = Motion::zero();
    for i in 0..chain.len() {
        let (d, rest) = work.d[i];
        work.out[i] = d * (rest - dot6(&work.u[i], &six(&rate)));
        rate = rate.plus(work.out[i], &work.screw[i]);
    }
}

#[inline(always)]
fn six<S: Scalar>(m: &Motion<S>) -> [S; 6] {
    [m.ang[0], m.ang[1], m.ang[2], m.lin[0], m.lin[1], m.lin[2]]
}

#[inline(always)]
fn six_force<S: Scalar>(f: &Force<S>) -> [S; 6] {
    [f.mom[0], f.mom[1], f.mom[2], f.lin[0], f.lin[1], f.lin[2]]
}

#[inline(always)]
fn dot6<S: Scalar>(a: &[S; 6], b: &[S; 6]) -> S {
    (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
}

#[inline(always)]
fn times<S: Scalar>(m: &[[S; 6]; 6], v: &[S; 6]) -> [S; 6] {
    [
        dot6(&m[0], v),
        dot6(&m[1], v),
        dot6(&m[2], v),
        dot6(&m[3], v),
        dot6(&m[4], v),
        dot6(&m[5], v),
    ]
}

/// Adds [[I, h×], [−h×, m]] of a rigid body.
#[inline(always)]
fn add_body<S: Scalar>(inertia: &mut [[S; 6]; 6], body: &Inertia<S>) {
    let [xx, yy, zz, xy, xz, yz] = body.tensor;
    let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let [x, y, z] = body.moment;
    for i in 0..3 {
        (0..3).for_each(|j| inertia[i][j] += rows[i][j]);
        inertia[3 + i][3 + i] += body.mass;
    }
    for (i, j, h) in [(0, 1, z), (1, 2, x), (2, 0, y)] {
        inertia[i][3 + j] -= h;
        inertia[j][3 + i] += h;
        inertia[3 + j][i] -= h;
        inertia[3 + i][j] += h;
    }
}
