//! The robot at one pose as M ẍ + D ẋ + K x = Jᵀ f over its elastic coordinates (drive, two tilts
//! per axis, further virtual axes): small motions about the commanded pose.

use super::chain::Chain;
use super::dynamics::crba;
use super::kinematics::{column, tcp};
use super::statics::springs;
use super::work::Work;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, cross, dot, scale, sub};

/// M, D, K of the elastic coordinates, n×n by rows, with the tool's Jacobian.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Linear {
    /// Number of elastic coordinates.
    pub n: usize,
    /// Site name of each coordinate.
    pub names: Vec<String>,
    /// Mass matrix, kg·m².
    pub mass: Vec<f64>,
    /// Damping matrix, N·m·s/rad.
    pub damping: Vec<f64>,
    /// Stiffness matrix, N·m/rad.
    pub stiffness: Vec<f64>,
    /// Translation of the tool per coordinate, m/rad, base axes.
    pub tool: Vec<V3>,
    /// Turn of the tool per coordinate, rad/rad, base axes.
    pub turn: Vec<V3>,
}

/// Linearises at the angles `q` (n of the chain, rad) without preload: K is the diagonal of the
/// spring stiffnesses, D of their dampings. Rigid hinges stay where they are. Backlash is left out
/// (a preloaded joint). See [`gravity_stiffness`] for the term that weight adds.
///
/// # Errors
/// Nothing elastic.
pub fn linearise(chain: &Chain, work: &mut Work, q: &[f64]) -> Outcome<Linear> {
    let hinges: Vec<usize> = springs(chain).map(|(i, _)| i).collect();
    let (n, total) = (hinges.len(), chain.len());
    if n == 0 {
        return Err(Problem::new(
            "nothing in this robot is elastic",
            "give at least one joint a drive or tilt stiffness",
        ));
    }
    crba(chain, work, q);
    let entry = |i: &usize, j: &usize| work.mass[i * total + j];
    let mass = hinges
        .iter()
        .flat_map(|i| hinges.iter().map(move |j| entry(i, j)))
        .collect();
    let at = tcp(chain, work).point;
    Ok(Linear {
        n,
        names: hinges.iter().map(|i| chain.names[*i].clone()).collect(),
        mass,
        damping: diagonal(springs(chain).map(|(_, spring)| spring.damping), n),
        stiffness: diagonal(springs(chain).map(|(_, spring)| spring.stiffness), n),
        tool: hinges.iter().map(|i| column(work, *i, at).0).collect(),
        turn: hinges.iter().map(|i| column(work, *i, at).1).collect(),
    })
}

fn diagonal(values: impl Iterator<Item = f64>, n: usize) -> Vec<f64> {
    let mut matrix = vec![0.0; n * n];
    values
        .enumerate()
        .for_each(|(i, value)| matrix[i * n + i] = value);
    matrix
}

/// What weight adds to the stiffness of the elastic coordinates, ∂G/∂q (N·m/rad, n×n by rows,
/// symmetric), at the pose of the last [`linearise`]. About 0.1 % of the springs of a large robot.
///
/// For j before or at i, turning j turns everything behind i: ∂Gᵢ/∂qⱼ = aᵢ·(rᵢ × (aⱼ × f)), with rᵢ
/// from hinge i to the mass centre behind it and f its weight.
pub fn gravity_stiffness(chain: &Chain, work: &Work) -> Vec<f64> {
    let hinges: Vec<usize> = springs(chain).map(|(i, _)| i).collect();
    let n = hinges.len();
    let behind = masses_behind(chain, work);
    let mut k = vec![0.0; n * n];
    for (row, &i) in hinges.iter().enumerate() {
        let (mass, moment) = behind[i];
        let arm = sub(moment, scale(mass, sub(work.point[i], work.reference)));
        for (other, &j) in hinges.iter().enumerate().take(row + 1) {
            let turned = cross(work.screw[j].ang, chain.gravity);
            let value = dot(work.screw[i].ang, cross(arm, turned));
            k[row * n + other] = value;
            k[other * n + row] = value;
        }
    }
    k
}

/// Mass and first moment (about the reference point) of all bodies behind each hinge.
fn masses_behind(chain: &Chain, work: &Work) -> Vec<(f64, V3)> {
    let mut sum = (0.0, [0.0; 3]);
    let mut behind: Vec<(f64, V3)> = Vec::with_capacity(chain.len());
    for (hinge, inertia) in chain.hinges.iter().zip(&work.inertia).rev() {
        if hinge.body.is_some() {
            sum = (
                sum.0 + inertia.mass,
                [0, 1, 2].map(|k| sum.1[k] + inertia.moment[k]),
            );
        }
        behind.push(sum);
    }
    behind.reverse();
    behind
}
