//! The reusable scratch space of the algorithms: allocated once per chain, never in a loop.

use super::chain::Chain;
use crate::ground::dual::Scalar;
use crate::ground::spatial::{Inertia, M3, Motion, V3};

/// Scratch space for one chain and one scalar type. All vectors are in base axes.
#[derive(Debug, Clone)]
pub struct Work<S = f64> {
    /// Sine and cosine of each angle.
    pub(super) turn: Vec<(f64, f64)>,
    /// Orientation of each link.
    pub(super) rotation: Vec<M3<S>>,
    /// Point of each hinge, m, base frame.
    pub(super) point: Vec<V3<S>>,
    /// Motion per unit rate of each hinge, about the reference point.
    pub(super) screw: Vec<Motion<S>>,
    /// Inertia of each body about the reference point.
    pub(super) inertia: Vec<Inertia<S>>,
    /// Per-hinge force, 6 numbers: momenta, later joint forces.
    pub(super) force: Vec<crate::ground::spatial::Force<S>>,
    /// Articulated inertia times screw of each hinge.
    pub(super) u: Vec<[S; 6]>,
    /// Its projection on the screw, inverted, and the joint torque left over.
    pub(super) d: Vec<(S, S)>,
    /// Mass matrix, n×n by rows.
    pub(super) mass: Vec<S>,
    /// Result per hinge: torques or accelerations.
    pub(super) out: Vec<S>,
    /// Point about which inertias and screws are written, m: the last hinge's, so that the light
    /// wrist bodies lose no digits to a long lever.
    pub(super) reference: V3<S>,
}

impl<S: Scalar> Work<S> {
    /// Scratch space for `chain`.
    pub fn new(chain: &Chain) -> Self {
        let n = chain.len();
        let zero = S::constant(0.0);
        Self {
            turn: vec![(0.0, 1.0); n],
            rotation: vec![[[zero; 3]; 3]; n],
            point: vec![[zero; 3]; n],
            screw: vec![Motion::zero(); n],
            inertia: vec![Inertia::zero(); n],
            force: vec![crate::ground::spatial::Force::zero(); n],
            u: vec![[zero; 6]; n],
            d: vec![(zero, zero); n],
            mass: vec![zero; n * n],
            out: vec![zero; n],
            reference: [zero; 3],
        }
    }

    /// Mass matrix of the last [`super::crba`], n×n by rows, kg·m².
    pub fn mass_matrix(&self) -> &[S] {
        &self.mass
    }
}
