//! What is known too badly to be asked about: springs within their spread, and where the target sits. A reflector is never
//! exactly at the tip that the robot file states: what the tool turns by moves it beside.

use super::field::Springs;
use super::patterns::deflection;
use crate::experiments::workspace::Response;
use crate::fit::weighing::Weighing;
use crate::ground::spatial::M3;
use crate::motion::{Work, forward_kinematics, rigid};
use crate::robot::Robot;
use nalgebra::{DMatrix, DVector};

/// The centre of the target lies so far beside the tip, m: the radius of a ball with a reflector of one and a half inches.
const BESIDE: f64 = 0.019;

impl Springs {
    /// Columns of the springs of a robot, then of the place of the target, all with the spread of the springs.
    pub fn of(weighing: &Weighing, robot: &Robot, points: &[Vec<f64>], spread: f64) -> Self {
        let response = Response::of(robot, points);
        let springs = weighing.design(&response, &response.sites);
        let target = beside(robot, points).map(|slopes| {
            let size = BESIDE / spread;
            weighing.whiten(|p, d| slopes[p][d].map(|x| size * x))
        });
        let all = springs.column_iter().map(|c| c.into_owned());
        let all: Vec<DVector<f64>> = all.chain(target).collect();
        Self {
            columns: DMatrix::from_columns(&all),
            spread,
        }
    }
}

/// Slopes per metre that the target lies beside the tip, 1/N, along the axes of the base with every joint at zero; without
/// what springs behind the last drive turn.
fn beside(robot: &Robot, points: &[Vec<f64>]) -> [Vec<M3>; 3] {
    let chain = rigid(robot);
    let zero = vec![0.0; robot.dof()];
    let tip = forward_kinematics(&chain, &mut Work::new(&chain), &chain.spread(&zero)).point;
    let read = |at| deflection(robot, points, Some((robot.dof(), at))).slopes;
    let own = read(tip);
    [0, 1, 2].map(|k| {
        let mut at = tip;
        at[k] += 1.0;
        let moved = read(at);
        let less = |(a, b): (&M3, &M3)| {
            std::array::from_fn(|d| std::array::from_fn(|c| a[d][c] - b[d][c]))
        };
        moved.iter().zip(&own).map(less).collect()
    })
}
