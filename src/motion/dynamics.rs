//! Inverse dynamics, gravity and mass matrix: M(q)q̈ + C(q,q̇) + G(q) = τ (source 000, eq. 2.1).
//!
//! Featherstone 2008, tables 5.1 and 6.2, written in one inertial frame: no coordinate changes, so
//! both recursions are running sums.

use super::chain::Chain;
use super::kinematics::{place, weigh};
use super::work::Work;
use crate::ground::dual::Scalar;
use crate::ground::spatial::{Force, Inertia, Motion, lift, scale};

/// Acceleration of the base that acts like gravity.
#[inline(always)]
pub(super) fn base_acceleration<S: Scalar>(chain: &Chain) -> Motion<S> {
    Motion {
        ang: lift([0.0; 3]),
        lin: lift(scale(-1.0, chain.gravity)),
    }
}

/// Torques (n, N·m) for angles `q`, speeds `v` and accelerations `a` (rad, rad/s, rad/s²), gravity
/// included: recursive Newton–Euler.
pub fn rnea<'w, S: Scalar>(
    chain: &Chain,
    work: &'w mut Work<S>,
    q: &[S],
    v: &[S],
    a: &[S],
) -> &'w [S] {
    place(chain, work, q);
    weigh(chain, work);
    newton_euler(chain, work, v, a);
    &work.out
}

/// The recursion of [`rnea`] after `place` and `weigh`.
pub(super) fn newton_euler<S: Scalar>(chain: &Chain, work: &mut Work<S>, v: &[S], a: &[S]) {
    let (mut speed, mut rate) = (Motion::zero(), base_acceleration(chain));
    for i in 0..chain.len() {
        let screw = work.screw[i];
        speed = speed.plus(v[i], &screw);
        rate = rate.plus(a[i], &screw).plus(v[i], &speed.cross(&screw));
        work.force[i] = match chain.hinges[i].body {
            Some(_) => inertial_force(&work.inertia[i], &speed, &rate),
            None => Force::zero(),
        };
    }
    project(work);
}

/// I a + v ×* I v
#[inline(always)]
pub(super) fn inertial_force<S: Scalar>(
    inertia: &Inertia<S>,
    speed: &Motion<S>,
    rate: &Motion<S>,
) -> Force<S> {
    let momentum = inertia.times(speed);
    inertia.times(rate).plus(&speed.cross_force(&momentum))
}

/// Sums forces from the tip and projects them on the screws.
fn project<S: Scalar>(work: &mut Work<S>) {
    let mut sum = Force::zero();
    let hinges = work.force.iter().zip(&work.screw).zip(&mut work.out);
    for ((force, screw), torque) in hinges.rev() {
        sum = sum.plus(force);
        *torque = screw.dot(&sum);
    }
}

/// Torques (n, N·m) that hold the robot against gravity at `q`.
pub fn gravity_torque<'w, S: Scalar>(chain: &Chain, work: &'w mut Work<S>, q: &[S]) -> &'w [S] {
    place(chain, work, q);
    weigh(chain, work);
    let still = base_acceleration(chain);
    for i in 0..chain.len() {
        work.force[i] = match chain.hinges[i].body {
            Some(_) => work.inertia[i].times(&still),
            None => Force::zero(),
        };
    }
    project(work);
    &work.out
}

/// Mass matrix (n×n by rows, kg·m²) at `q`: composite rigid bodies.
pub fn crba<'w, S: Scalar>(chain: &Chain, work: &'w mut Work<S>, q: &[S]) -> &'w [S] {
    place(chain, work, q);
    weigh(chain, work);
    composite(chain, work);
    &work.mass
}

/// The recursion of [`crba`] after `place` and `weigh`.
pub(super) fn composite<S: Scalar>(chain: &Chain, work: &mut Work<S>) {
    let n = chain.len();
    let mut sum = Inertia::zero();
    for i in (0..n).rev() {
        if chain.hinges[i].body.is_some() {
            sum = sum.plus(&work.inertia[i]);
        }
        let force = sum.times(&work.screw[i]);
        for j in 0..=i {
            let entry = work.screw[j].dot(&force);
            work.mass[i * n + j] = entry;
            work.mass[j * n + i] = entry;
        }
    }
}
