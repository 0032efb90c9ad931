//! The places of a map that the tool reaches.

use super::Asked;
use crate::ground::spatial::{Pose, V3};
use crate::motion::inverse::SphericalWrist;
use crate::motion::{Chain, Work, numeric};
use std::collections::{BTreeMap, VecDeque};

/// The places of a map: the plane through the tool, cells counted from the axis of the base.
pub(super) struct Places<'a> {
    /// The tool as asked.
    pub(super) goal: Pose,
    /// What is mapped.
    pub(super) asked: &'a Asked,
    /// Cells to either side.
    pub(super) count: i64,
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
pub(super) fn closed(wrist: &SphericalWrist, places: &Places) -> Vec<(V3, Vec<f64>)> {
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
pub(super) fn walked(chain: &Chain, limits: &[[f64; 2]], places: &Places) -> Vec<(V3, Vec<f64>)> {
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
