//! The elastic robot at one pose, seen from the workpiece.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, V3, add, rotate_back, scale};
use crate::motion::modes::{Modal, modal};
use crate::motion::statics::springs;
use crate::motion::{Chain, Linear, Work, gravity_torque, linearise, rnea};

/// The robot that carries the tool.
#[derive(Debug, Clone)]
pub struct Carrier {
    /// Driven joints and virtual axes.
    pub chain: Chain,
    /// Axes of the workpiece as columns, base frame.
    pub workpiece: M3,
    work: Work,
}

/// The robot at a pose.
#[derive(Debug, Clone)]
pub struct Held {
    /// M, D, K; the tool's motion in workpiece axes.
    pub linear: Linear,
    /// Torque of the weight on each elastic coordinate, N·m.
    pub weight: Vec<f64>,
}

impl Carrier {
    /// The elastic robot, the workpiece standing with its axes along the columns of `workpiece`.
    pub fn new(chain: Chain, workpiece: M3) -> Self {
        let work = Work::new(&chain);
        Self {
            chain,
            workpiece,
            work,
        }
    }

    /// The robot at these joint angles, rad.
    ///
    /// # Errors
    /// Nothing in it is elastic.
    pub fn held(&mut self, joints: &[f64]) -> Outcome<Held> {
        let q = self.chain.spread(joints);
        let mut linear = linearise(&self.chain, &mut self.work, &q)?;
        for column in &mut linear.tool {
            *column = rotate_back(&self.workpiece, *column);
        }
        let torque = gravity_torque(&self.chain, &mut self.work, &q).to_vec();
        let weight = springs(&self.chain).map(|(i, _)| torque[i]).collect();
        Ok(Held { linear, weight })
    }

    /// Torque on each elastic coordinate that weight and programmed motion ask for, N·m.
    pub fn carried(&mut self, joints: &[f64], speeds: &[f64], accelerations: &[f64]) -> Vec<f64> {
        let [q, v, a] = [joints, speeds, accelerations].map(|x| self.chain.spread(x));
        let torque = rnea(&self.chain, &mut self.work, &q, &v, &a).to_vec();
        springs(&self.chain).map(|(i, _)| torque[i]).collect()
    }
}

impl Held {
    /// Compliance of the tool, m/N, workpiece axes.
    pub fn compliance(&self) -> M3 {
        let mut c = [[0.0; 3]; 3];
        for (i, v) in self.linear.tool.iter().enumerate() {
            let k = self.linear.stiffness[i * self.linear.n + i];
            for (row, x) in c.iter_mut().zip(v) {
                (0..3).for_each(|l| row[l] += x * v[l] / k);
            }
        }
        c
    }

    /// Where the weight alone moves the tool, m, workpiece axes.
    pub fn sag(&self) -> V3 {
        self.moved(&self.bent())
    }

    /// How far the weight alone bends each elastic coordinate, rad.
    pub fn bent(&self) -> Vec<f64> {
        let n = self.linear.n;
        let own = self.weight.iter().enumerate();
        own.map(|(i, w)| -w / self.linear.stiffness[i * n + i])
            .collect()
    }

    /// Where elastic coordinates that are bent so (rad) move the tool, m, workpiece axes.
    pub fn moved(&self, bent: &[f64]) -> V3 {
        let columns = self.linear.tool.iter().zip(bent);
        columns.fold([0.0; 3], |sum, (v, b)| add(sum, scale(*b, *v)))
    }

    /// Its modes.
    ///
    /// # Errors
    /// A spring without stiffness.
    pub fn modal(&self) -> Outcome<Modal> {
        modal(&self.linear)
    }
}

/// a / b for 3×3: solves a x = b.
///
/// # Errors
/// A singular matrix: the cut pulls the tool harder than the springs hold it.
pub fn solve3(a: &M3, b: V3) -> Outcome<V3> {
    let det = crate::ground::spatial::determinant(a);
    if det.abs() < 1e-9 || !det.is_finite() {
        return Err(Problem::new(
            "the cut pulls the tool harder than the springs of the robot hold it",
            "lower the depth or the width of cut, or check the stiffnesses",
        ));
    }
    let column = |k: usize| {
        let mut m = *a;
        (0..3).for_each(|i| m[i][k] = b[i]);
        crate::ground::spatial::determinant(&m) / det
    };
    Ok([column(0), column(1), column(2)])
}

/// 1 − a b
pub fn one_less(a: &M3, b: &M3) -> M3 {
    let ab = crate::ground::spatial::product(a, b);
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| f64::from(u8::from(i == j)) - ab[i][j]))
}
