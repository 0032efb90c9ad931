//! Numeric inverse kinematics for any chain: damped Newton (Levenberg 1944; Wampler 1986).

use super::chain::Chain;
use super::kinematics::{forward_kinematics, jacobian};
use super::work::Work;
use crate::ground::cholesky;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{Pose, norm, product, rotation_vector, sub, transpose};
use crate::ground::stats::length;

/// Residual below which a pose counts as reached: m and rad.
const REACHED: f64 = 1e-12;
const STEPS: usize = 200;

/// Angles (n, rad) near `seed` that bring the tool to `pose`.
///
/// # Errors
/// The pose is not reached from this seed to within 1e-9 m and rad.
pub fn solve(chain: &Chain, work: &mut Work, pose: &Pose, seed: &[f64]) -> Outcome<Vec<f64>> {
    let mut q = seed.to_vec();
    let mut miss = error(&forward_kinematics(chain, work, &q), pose);
    let mut damping = 1e-3;
    for _ in 0..STEPS {
        if length(&miss) < REACHED || damping > 1e12 {
            break;
        }
        let trial = step(chain, work, &q, &miss, damping);
        let gap = error(&forward_kinematics(chain, work, &trial), pose);
        if length(&gap) < length(&miss) {
            (q, miss, damping) = (trial, gap, (damping * 0.1).max(1e-15));
        } else {
            damping *= 10.0;
            forward_kinematics(chain, work, &q);
        }
    }
    match length(&miss) < 1e-9 {
        true => Ok(q),
        false => Err(Problem::new(
            format!(
                "the pose is not reached: {:.3e} m, {:.3e} rad are left",
                norm([miss[0], miss[1], miss[2]]),
                norm([miss[3], miss[4], miss[5]])
            ),
            "start nearer to the goal, or check that it lies in the workspace",
        )),
    }
}

/// Displacement and rotation vector from `at` to `goal`, base axes: m, rad.
pub fn error(at: &Pose, goal: &Pose) -> [f64; 6] {
    let p = sub(goal.point, at.point);
    let w = rotation_vector(&product(&goal.rotation, &transpose(&at.rotation)));
    [p[0], p[1], p[2], w[0], w[1], w[2]]
}

/// q + (JᵀJ + λ1)⁻¹ Jᵀ e; the chain is placed at q.
fn step(chain: &Chain, work: &Work, q: &[f64], miss: &[f64; 6], damping: f64) -> Vec<f64> {
    let columns = jacobian(chain, work);
    let n = columns.len();
    let product = |a: &[f64; 6], b: &[f64; 6]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut normal: Vec<f64> = columns
        .iter()
        .flat_map(|a| columns.iter().map(move |b| product(a, b)))
        .collect();
    (0..n).for_each(|i| normal[i * n + i] += damping);
    let mut change: Vec<f64> = columns.iter().map(|column| product(column, miss)).collect();
    if cholesky::factor(&mut normal, n) {
        cholesky::solve(&normal, n, &mut change);
    }
    q.iter().zip(&change).map(|(q, d)| q + d).collect()
}
