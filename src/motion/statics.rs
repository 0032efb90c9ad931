//! How the robot gives way to forces: linear compliance, and large deflection with the change of
//! geometry under the load.

use super::chain::Chain;
use super::dynamics::gravity_torque;
use super::kinematics::{column, forward_kinematics, place, tcp};
use super::work::Work;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, V3, dot, rotate, scale, sub};
use crate::robot::Spring;

/// A 6×6 matrix by rows, translations before rotations.
pub type M6 = [[f64; 6]; 6];

/// Compliance of the tool centre point (m/N, symmetric, base axes) at the angles of [`place`]:
/// C = Σ Jᵥᵢ Jᵥᵢᵀ / kᵢ over all springs (Abele et al. 2008; source 002, eqs. 5 to 9, linearised).
/// Linear in every 1/kᵢ; backlash is left out.
pub fn compliance(chain: &Chain, work: &Work) -> M3 {
    let at = tcp(chain, work).point;
    let mut sum = [0.0; 6];
    for (i, spring) in springs(chain) {
        let (v, _) = column(work, i, at);
        let [x, y, z] = scale(1.0 / spring.stiffness, v);
        let own = [x * v[0], y * v[1], z * v[2], x * v[1], x * v[2], y * v[2]];
        (0..6).for_each(|k| sum[k] += own[k]);
    }
    let [xx, yy, zz, xy, xz, yz] = sum;
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// Compliance for forces and moments at the tool centre point: (m, rad) per (N, N·m), base axes.
/// Needs [`place`].
pub fn compliance6(chain: &Chain, work: &Work) -> M6 {
    let at = tcp(chain, work).point;
    let mut c = [[0.0; 6]; 6];
    for (i, spring) in springs(chain) {
        let (v, w) = column(work, i, at);
        let j = [v[0], v[1], v[2], w[0], w[1], w[2]];
        for (row, x) in c.iter_mut().zip(j) {
            (0..6).for_each(|k| row[k] += x * j[k] / spring.stiffness);
        }
    }
    c
}

/// Every elastic hinge with its spring.
pub fn springs(chain: &Chain) -> impl Iterator<Item = (usize, &Spring)> {
    chain
        .springs
        .iter()
        .enumerate()
        .filter_map(|(i, spring)| Some((i, spring.as_ref()?)))
}

/// Displacement of the tool (m) under `force` (N, base frame, at the tool), small deflections.
/// Needs [`place`].
pub fn displacement(chain: &Chain, work: &Work, force: V3) -> V3 {
    rotate(&compliance(chain, work), force)
}

/// Which loads bend the robot besides the force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// Gravity is balanced in the commanded pose: the deflection is what the force adds.
    Balanced,
    /// Own weight bends the springs too.
    Acting,
}

/// A static equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// Deflection of every hinge, rad, zero where it is rigid.
    pub deflection: Vec<f64>,
    /// Displacement of the tool from the commanded pose, m, base frame.
    pub displacement: V3,
    /// Fixed-point steps used.
    pub steps: usize,
}

/// Equilibrium k δ = J(q+δ)ᵀF − G of all springs under `force` (N, base frame, fixed in direction,
/// acting at the moving tool): the change of geometry under the load is included by iteration.
///
/// # Errors
/// No equilibrium within 100 steps: the force is beyond what the springs can carry.
pub fn large_deflection(
    chain: &Chain,
    work: &mut Work,
    q: &[f64],
    force: V3,
    weight: Weight,
) -> Outcome<Equilibrium> {
    equilibrium(chain, work, q, &vec![0.0; chain.len()], force, weight)
}

/// [`large_deflection`] with every hinge moved by `play` (rad) inside its gap before the springs act.
///
/// # Errors
/// As [`large_deflection`].
pub fn equilibrium(
    chain: &Chain,
    work: &mut Work,
    q: &[f64],
    play: &[f64],
    force: V3,
    weight: Weight,
) -> Outcome<Equilibrium> {
    const STEPS: usize = 100;
    let start = forward_kinematics(chain, work, q).point;
    let held = loads(chain, work, q, [0.0; 3]);
    let mut delta = vec![0.0; chain.len()];
    for steps in 1..=STEPS {
        let bent: Vec<f64> = (0..q.len()).map(|i| q[i] + play[i] + delta[i]).collect();
        let mut load = loads(chain, work, &bent, force);
        if weight == Weight::Balanced {
            load.iter_mut()
                .zip(&held)
                .for_each(|(load, held)| *load -= held);
        }
        let change = relax(chain, &mut delta, &load);
        if change < 1e-14 {
            let displacement = sub(forward_kinematics(chain, work, &bent).point, start);
            return Ok(Equilibrium {
                deflection: delta,
                displacement,
                steps,
            });
        }
    }
    Err(Problem::new(
        "the robot finds no equilibrium under this force",
        "the force bends the springs beyond their validity: reduce it or check the stiffness values",
    ))
}

/// Torque on every hinge from the force at the tool and the weight, N·m.
fn loads(chain: &Chain, work: &mut Work, q: &[f64], force: V3) -> Vec<f64> {
    let weight = gravity_torque(chain, work, q).to_vec();
    let at = tcp(chain, work).point;
    let torque = |i: usize| dot(column(work, i, at).0, force) - weight[i];
    (0..chain.len()).map(torque).collect()
}

/// δ = load/k for all springs; largest change, rad.
fn relax(chain: &Chain, delta: &mut [f64], load: &[f64]) -> f64 {
    let mut change = 0.0_f64;
    for (i, spring) in springs(chain) {
        let next = load[i] / spring.stiffness;
        change = change.max((next - delta[i]).abs());
        delta[i] = next;
    }
    change
}

/// Places the chain and gives compliance and displacement in one go: (m/N, m).
pub fn deflect(chain: &Chain, work: &mut Work, q: &[f64], force: V3) -> (M3, V3) {
    place(chain, work, q);
    let c = compliance(chain, work);
    (c, rotate(&c, force))
}
