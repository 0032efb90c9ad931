//! How stiff the robot is at its tool over a plane of its workspace.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, Pose, V3, norm, sub};
use crate::motion::inverse::SphericalWrist;
use crate::motion::kinematics::{forward_kinematics, place};
use crate::motion::skeleton::skeleton;
use crate::motion::{Chain, Work, elastic, numeric, rigid, statics};
use crate::robot::Robot;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::significant;
use nalgebra::{Matrix3, SymmetricEigen};
use std::collections::{BTreeMap, VecDeque};

/// Most cells of a map.
const MOST: usize = 250_000;
/// Classes of a map.
const CLASSES: usize = 6;
const MICROMETRE: f64 = 1e-6;

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

/// The places of a map: the plane through the tool, cells counted from the axis of the base.
struct Places<'a> {
    goal: Pose,
    asked: &'a Asked,
    count: i64,
}

impl Places<'_> {
    fn at(&self, [i, j]: [i64; 2]) -> V3 {
        let mut at = self.goal.point;
        at[self.asked.plane[0]] = i as f64 * self.asked.step;
        at[self.asked.plane[1]] = j as f64 * self.asked.step;
        at
    }

    fn pose(&self, cell: [i64; 2]) -> Pose {
        Pose {
            rotation: self.goal.rotation,
            point: self.at(cell),
        }
    }

    fn all(&self) -> impl Iterator<Item = [i64; 2]> + '_ {
        let row = |j| (-self.count..=self.count).map(move |i| [i, j]);
        (-self.count..=self.count).flat_map(row)
    }
}

/// By the closed form, with the arm as in the given posture.
fn closed(wrist: &SphericalWrist, places: &Places) -> Vec<(V3, Vec<f64>)> {
    let Ok(seed) = <[f64; 6]>::try_from(&places.asked.joints[..]) else {
        return Vec::new();
    };
    let own = wrist.solve(&places.goal, &seed);
    let apart = |q: &[f64; 6]| {
        q.iter()
            .zip(&seed)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max)
    };
    let nearest = own
        .as_slice()
        .iter()
        .min_by(|a, b| apart(&a.q).total_cmp(&apart(&b.q)));
    let Some(arm) = nearest.map(|posture| [posture.branch[0], posture.branch[1]]) else {
        return Vec::new();
    };
    let reached = |cell: [i64; 2]| {
        let pose = places.pose(cell);
        let found = wrist.solve_arm(&pose, &seed, arm);
        let posture = found.nearest(&seed)?;
        Some((pose.point, posture.q.to_vec()))
    };
    places.all().filter_map(reached).collect()
}

/// By Newton's method from place to place, where no closed form is known.
fn walked(chain: &Chain, limits: &[[f64; 2]], places: &Places) -> Vec<(V3, Vec<f64>)> {
    let mut work = Work::new(chain);
    let index =
        |k: usize| (places.goal.point[places.asked.plane[k]] / places.asked.step).round() as i64;
    let inside = |q: &[f64]| {
        q.iter()
            .zip(limits)
            .all(|(q, [low, high])| (*low..=*high).contains(q))
    };
    let mut found: BTreeMap<[i64; 2], Vec<f64>> = BTreeMap::new();
    let mut queue = VecDeque::from([([index(0), index(1)], places.asked.joints.clone())]);
    while let Some((at, seed)) = queue.pop_front() {
        let outside = at.iter().any(|k| k.abs() > places.count);
        let key = [at[1], at[0]];
        if outside || found.contains_key(&key) {
            continue;
        }
        let solved = numeric::solve(chain, &mut work, &places.pose(at), &seed);
        let Some(q) = solved.ok().filter(|q| inside(q)) else {
            continue;
        };
        for [di, dj] in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
            queue.push_back(([at[0] + di, at[1] + dj], q.clone()));
        }
        found.insert(key, q);
    }
    let cells = found.into_iter();
    cells.map(|([j, i], q)| (places.at([i, j]), q)).collect()
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

    /// A map of one quantity (N/m) with the robot in it.
    pub fn chart(
        &self,
        robot: &Robot,
        name: &str,
        title: &str,
        of: impl Fn(&Cell) -> f64,
    ) -> Chart {
        let [a, b] = self.asked.plane;
        let axis = |k: usize| Axis::new(["x", "y", "z"][k], "m");
        let values: Vec<f64> = self
            .cells
            .iter()
            .map(|cell| MICROMETRE * of(cell))
            .collect();
        let edges = edges(&values);
        let side = [self.asked.step; 2];
        let mut panel = Panel::new(axis(a), axis(b)).equal_axes();
        for pair in edges.windows(2) {
            let inside =
                |v: f64| v >= pair[0] && (v < pair[1] || pair[1] == edges[edges.len() - 1]);
            let cells = self.cells.iter().zip(&values).filter(|(_, v)| inside(**v));
            let places = cells.map(|(cell, _)| [cell.at[a], cell.at[b]]).collect();
            let name = format!("{} to {}", significant(pair[0], 2), significant(pair[1], 2));
            panel = panel.with(Series::cells(name, places, side));
        }
        let line = skeleton(robot, &self.asked.joints).line;
        let line: Vec<[f64; 2]> = line.iter().map(|p| [p[a], p[b]]).collect();
        let tool = line.last().copied().unwrap_or_default();
        panel = panel
            .with(Series::line("robot", line.clone()).emphasised())
            .with(Series::points("joints and tool", line))
            .named(tool, "tool")
            .noted("stiffness in N/µm");
        let caption = "Tool orientation and arm as drawn; blank: not reached so, inside the limits of the joints. Springs without gaps, bodies rigid.";
        Chart::new(name, title, caption).with(panel)
    }
}

/// Edges of classes with about as many cells in each, on round numbers.
fn edges(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len() - 1;
    let mut edges = vec![round(sorted[0], f64::floor)];
    for k in 1..CLASSES {
        edges.push(round(sorted[k * last / CLASSES], f64::round));
    }
    edges.push(round(sorted[last], f64::ceil));
    edges.dedup_by(|a, b| *a <= *b);
    if let [alone] = edges[..] {
        edges.push(1.1 * alone);
    }
    edges
}

/// Two digits.
fn round(value: f64, how: fn(f64) -> f64) -> f64 {
    let unit = 10f64.powf(value.abs().max(1e-12).log10().floor() - 1.0);
    how(value / unit) * unit
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

    #[test]
    fn classes_have_round_edges_that_rise() {
        let values: Vec<f64> = (0..100).map(|k| 0.123 + 0.01 * f64::from(k)).collect();
        let found = edges(&values);
        assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "{found:?}");
        assert!(found[0] <= 0.123 && found[found.len() - 1] >= 1.113);
        assert_eq!(edges(&[2.0]).len(), 2);
    }
}
