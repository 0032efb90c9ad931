//! How stiff the robot is at its tool over a plane of its workspace.

mod chart;
mod places;

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, V3, norm, sub};
use crate::motion::inverse::SphericalWrist;
use crate::motion::kinematics::{forward_kinematics, place};
use crate::motion::skeleton::skeleton;
use crate::motion::{Chain, Work, elastic, rigid, statics};
use crate::robot::Robot;
use nalgebra::{Matrix3, SymmetricEigen};
use places::{Places, closed, walked};

/// Most cells of a map.
const MOST: usize = 250_000;

/// What is mapped.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// Joint angles that give orientation, plane and posture of the arm, rad.
    pub joints: Vec<f64>,
    /// The base axes that span the plane: 0, 1, 2.
    pub plane: [usize; 2],
    /// Side of a cell, m.
    pub step: f64,
}

/// One place.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The tool, m, base frame.
    pub at: V3,
    /// Joint angles, rad.
    pub joints: Vec<f64>,
    /// Least and greatest stiffness over all directions of a force, N/m.
    pub least_greatest: [f64; 2],
    /// Direction of the least, unit vector, base axes.
    pub softest: V3,
    /// Force over deflection along itself for forces along x, y, z, N/m.
    pub along: V3,
}

/// The places that the tool reaches in the given orientation.
#[derive(Debug, Clone, PartialEq)]
pub struct StiffnessMap {
    /// What was asked.
    pub asked: Asked,
    /// The reachable places, row by row.
    pub cells: Vec<Cell>,
    /// How many places were tried and not reached.
    pub blank: usize,
}

/// Maps the robot.
///
/// # Errors
/// Too many cells, or none that is reached.
pub fn map(robot: &Robot, asked: &Asked) -> Outcome<StiffnessMap> {
    let chain = rigid(robot);
    let goal = forward_kinematics(&chain, &mut Work::new(&chain), &asked.joints);
    let half = reach(robot, asked) / asked.step;
    let count = half.ceil() as usize;
    if !(half.is_finite() && (2 * count + 1).pow(2) <= MOST) {
        let what = format!("is too fine for a reach of {:.1} m", half * asked.step);
        return Err(Problem::new(what, "give a greater step").in_column("--step-mm"));
    }
    let limits: Vec<[f64; 2]> = robot.joints.iter().map(|joint| joint.limits).collect();
    let places = Places {
        goal,
        asked,
        count: count as i64,
    };
    let found = match SphericalWrist::of(&chain, &limits) {
        Some(wrist) => closed(&wrist, &places),
        None => walked(&chain, &limits, &places),
    };
    if found.is_empty() {
        return Err(Problem::new(
            "the tool reaches no place of this plane in this orientation",
            "give joint angles inside their limits: `ident robot show` lists these",
        )
        .in_column("--joints-deg"));
    }
    let elastic = elastic(robot);
    let mut work = Work::new(&elastic);
    let cells: Vec<Cell> = found
        .into_iter()
        .map(|(at, joints)| cell(&elastic, &mut work, at, joints))
        .collect();
    Ok(StiffnessMap {
        blank: (2 * count + 1).pow(2) - cells.len(),
        asked: asked.clone(),
        cells,
    })
}

/// The farthest that a stretched robot could hold its tool from where it stands, m.
fn reach(robot: &Robot, asked: &Asked) -> f64 {
    let line = skeleton(robot, &asked.joints).line;
    let long: f64 = line
        .windows(2)
        .map(|pair| norm(sub(pair[1], pair[0])))
        .sum();
    long + asked.step
}

fn cell(chain: &Chain, work: &mut Work, at: V3, joints: Vec<f64>) -> Cell {
    place(chain, work, &chain.spread(&joints));
    let compliance = statics::compliance(chain, work);
    let (least_greatest, softest) = principal(&compliance);
    Cell {
        at,
        joints,
        least_greatest,
        softest,
        along: [0, 1, 2].map(|k| 1.0 / compliance[k][k]),
    }
}

/// Least and greatest stiffness, N/m, and the direction of the least.
fn principal(compliance: &M3) -> ([f64; 2], V3) {
    let matrix = Matrix3::from_fn(|i, j| compliance[i][j]);
    let eigen = SymmetricEigen::new(matrix);
    let order = |a: &usize, b: &usize| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]);
    let most = (0..3).max_by(order).unwrap_or(0);
    let least = (0..3).min_by(order).unwrap_or(0);
    let along = eigen.eigenvectors.column(most);
    let largest = (0..3)
        .max_by(|a, b| along[*a].abs().total_cmp(&along[*b].abs()))
        .unwrap_or(0);
    let sign = along[largest].signum();
    let stiffness = [most, least].map(|k| 1.0 / eigen.eigenvalues[k]);
    (
        stiffness,
        [along[0] * sign, along[1] * sign, along[2] * sign],
    )
}

impl StiffnessMap {
    /// The softest and the stiffest place, by the least stiffness there.
    pub fn ends(&self) -> [&Cell; 2] {
        let least = |cell: &&Cell| cell.least_greatest[0];
        let order = |a: &&Cell, b: &&Cell| least(a).total_cmp(&least(b));
        let low = self.cells.iter().min_by(order).unwrap_or(&self.cells[0]);
        [low, self.cells.iter().max_by(order).unwrap_or(low)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::load::load;

    /// Force over deflection by the statics of large deflections, which solve an equilibrium, at small forces.
    #[test]
    fn the_map_agrees_with_the_equilibrium_of_its_springs() {
        let robot = load("kr210", None).unwrap().robot;
        let joints = [0.0, -60.0, 80.0, 0.0, 60.0, 0.0]
            .map(f64::to_radians)
            .to_vec();
        let asked = Asked {
            joints,
            plane: [0, 2],
            step: 0.4,
        };
        let map = map(&robot, &asked).unwrap();
        assert!(map.cells.len() > 10 && map.blank > 10);
        let chain = elastic(&robot);
        let mut work = Work::new(&chain);
        for cell in map.cells.iter().step_by(5) {
            let q = chain.spread(&cell.joints);
            let here = forward_kinematics(&chain, &mut work, &q).point;
            assert!(
                norm(sub(here, cell.at)) < 1e-9,
                "the tool is where the map says"
            );
            let weight = statics::Weight::Balanced;
            let mut deflection = |force: V3| {
                statics::large_deflection(&chain, &mut work, &q, force, weight)
                    .unwrap()
                    .displacement
            };
            let soft = deflection(cell.softest);
            assert!((norm(soft) * cell.least_greatest[0] - 1.0).abs() < 1e-3);
            for axis in 0..3 {
                let mut force = [0.0; 3];
                force[axis] = 1.0;
                let moved = deflection(force);
                assert!((moved[axis] * cell.along[axis] - 1.0).abs() < 1e-3);
                let k = 1.0 / norm(moved);
                let [least, greatest] = cell.least_greatest;
                assert!(k > 0.999 * least && k < 1.001 * greatest);
            }
        }
    }
}
