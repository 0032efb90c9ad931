//! Joint angles along a path: one branch, without jumps.

use super::cell::{Cell, JOINTS};
use crate::ground::arctangent::whole_turns;
use crate::ground::spatial::{Pose, norm};
use crate::motion::inverse::{Posture, Postures};
use crate::motion::{Work, numeric};
use std::f64::consts::TAU;

/// A pose that the robot cannot reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Miss {
    /// Distance of the wrist from A2 in the plane of the arm, m (of the tool from the base, if the
    /// robot has no spherical wrist).
    pub needed: f64,
    /// The least and the largest distance that the arm reaches, m, if known.
    pub reach: Option<[f64; 2]>,
}

/// Follows poses one after the other.
pub struct Follower<'a> {
    cell: &'a Cell,
    work: Work,
    arm: Option<[bool; 2]>,
    last: [f64; JOINTS],
    step: [f64; JOINTS],
}

impl<'a> Follower<'a> {
    /// Before the first pose, which will be reached on the branch nearest to the start angles.
    pub fn new(cell: &'a Cell) -> Self {
        Self {
            work: Work::new(&cell.chain),
            arm: None,
            last: cell.start,
            step: [0.0; JOINTS],
            cell,
        }
    }

    /// On the branch of `arm` from the angles `q` on (rad).
    pub fn from(cell: &'a Cell, arm: Option<[bool; 2]>, q: [f64; JOINTS]) -> Self {
        Self {
            arm,
            last: q,
            ..Self::new(cell)
        }
    }

    /// The branch of A1 and A3 that it is on.
    pub fn arm(&self) -> Option<[bool; 2]> {
        self.arm
    }

    /// Angles (rad) for the next pose: those nearest to where the joints would go by themselves, so
    /// that a straight passage through the wrist's singularity changes the sign of A5.
    ///
    /// # Errors
    /// The pose is out of reach.
    pub fn next(&mut self, pose: &Pose) -> Result<[f64; JOINTS], Miss> {
        let first = self.arm.is_none();
        let q = match &self.cell.wrist {
            Some(_) if first => self.begin(pose)?,
            Some(wrist) => {
                let ahead: [f64; JOINTS] = std::array::from_fn(|i| self.last[i] + self.step[i]);
                let arm = self.arm.unwrap_or_default();
                let postures = wrist.solve_arm(pose, &ahead, arm);
                nearest(&postures, &ahead).ok_or_else(|| self.miss(pose))?
            }
            None => {
                let found = numeric::solve(&self.cell.chain, &mut self.work, pose, &self.last);
                let q = found.map_err(|_| self.miss(pose))?;
                q.try_into().map_err(|_| self.miss(pose))?
            }
        };
        if !first {
            self.step = std::array::from_fn(|i| q[i] - self.last[i]);
        }
        self.last = q;
        Ok(q)
    }

    /// The branch with the least sum of squares from the start angles, inside the limits if one is.
    fn begin(&mut self, pose: &Pose) -> Result<[f64; JOINTS], Miss> {
        let wrist = self.cell.wrist.as_ref().ok_or_else(|| self.miss(pose))?;
        let postures = wrist.solve(pose, &self.last);
        let apart = |posture: &&Posture| squares(&posture.q, &self.last);
        let best = |inside: bool| {
            let fitting = postures.as_slice().iter();
            let fitting = fitting.filter(|posture| posture.reachable || !inside);
            fitting.min_by(|a, b| apart(a).total_cmp(&apart(b)))
        };
        let chosen = best(true).or_else(|| best(false));
        let chosen = chosen.ok_or_else(|| self.miss(pose))?;
        self.arm = Some([chosen.branch[0], chosen.branch[1]]);
        Ok(match chosen.reachable {
            true => chosen.q,
            false => carried_on(&chosen.q, &self.last),
        })
    }

    fn miss(&self, pose: &Pose) -> Miss {
        match &self.cell.wrist {
            Some(wrist) => {
                let (needed, reach) = wrist.reach(pose);
                let reach = Some(reach);
                Miss { needed, reach }
            }
            None => Miss {
                needed: norm(pose.point),
                reach: None,
            },
        }
    }
}

fn nearest(postures: &Postures, to: &[f64; JOINTS]) -> Option<[f64; JOINTS]> {
    let all = postures.as_slice().iter();
    all.map(|posture| carried_on(&posture.q, to))
        .min_by(|a, b| squares(a, to).total_cmp(&squares(b, to)))
}

/// The same posture by the full turns nearest to `to`.
fn carried_on(q: &[f64; JOINTS], to: &[f64; JOINTS]) -> [f64; JOINTS] {
    std::array::from_fn(|i| q[i] + TAU * whole_turns(to[i] - q[i]))
}

/// Sum of squared differences, rad².
pub fn squares(a: &[f64; JOINTS], b: &[f64; JOINTS]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}
