//! Closed-form inverse kinematics of six axes with A2 ∥ A3 and a spherical wrist (the family of
//! Brandstötter, Angerer and Hofbaur 2014), solved on the axes themselves as the robot file gives
//! them (Paden–Kahan subproblems; Murray, Li and Sastry 1994, section 3.2): signs and zeros of any
//! maker need no convention of their own.

use super::chain::Chain;
use crate::ground::spatial::{
    M3, Pose, V3, add, cross, dot, norm, product, rotate, rotate_back, rotation, scale, sub,
    transpose, turn,
};
use std::f64::consts::{PI, TAU};

/// Lengths (m) and direction sines below this count as zero when the geometry is recognised.
const GEOMETRY: f64 = 1e-7;
/// Below this lever (m) or sine a posture is reported singular.
pub const SINGULAR: f64 = 1e-6;

/// Which degeneracies a posture is close to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Singularity {
    /// The wrist centre lies on A1: A1 is free.
    pub shoulder: bool,
    /// The arm is stretched or folded: A2 and A3 branches meet.
    pub elbow: bool,
    /// A4 and A6 are in line: only their sum is fixed.
    pub wrist: bool,
}

impl Singularity {
    /// Whether the posture is near any singularity.
    pub fn any(&self) -> bool {
        self.shoulder || self.elbow || self.wrist
    }
}

/// One posture that reaches the pose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Posture {
    /// Joint angles, rad.
    pub q: [f64; 6],
    /// Branches taken: first or second solution for A1, A3, A5.
    pub branch: [bool; 3],
    /// Whether every joint is inside its limits.
    pub reachable: bool,
    /// Degeneracies close by.
    pub singular: Singularity,
}

/// All postures of one pose: at most eight, no heap.
#[derive(Debug, Clone, Copy, Default)]
pub struct Postures {
    list: [Posture; 8],
    len: usize,
}

impl Postures {
    /// The postures found, in the order of their branches.
    pub fn as_slice(&self) -> &[Posture] {
        &self.list[..self.len]
    }

    fn push(&mut self, posture: Posture) {
        if let Some(slot) = self.list.get_mut(self.len) {
            *slot = posture;
            self.len += 1;
        }
    }

    /// The reachable posture with the smallest largest joint step from `from` (rad).
    pub fn nearest(&self, from: &[f64; 6]) -> Option<&Posture> {
        let step = |posture: &Posture| {
            posture
                .q
                .iter()
                .zip(from)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
        };
        let reachable = self.as_slice().iter().filter(|posture| posture.reachable);
        reachable.min_by(|a, b| step(a).total_cmp(&step(b)))
    }
}

/// The geometry of such a robot, recognised once.
#[derive(Debug, Clone)]
pub struct SphericalWrist {
    axis: [V3; 6],
    point: [V3; 3],
    wrist: V3,
    zero: Pose,
    upper: V3,
    fore: V3,
    limits: [[f64; 2]; 6],
}

impl SphericalWrist {
    /// Recognises the geometry of a rigid chain; `None` if it is another one (then see
    /// [`super::numeric::solve`]). `limits`: one [low, high] per joint, rad.
    pub fn of(chain: &Chain, limits: &[[f64; 2]]) -> Option<Self> {
        let axis: [V3; 6] = chain
            .hinges
            .iter()
            .map(|hinge| hinge.axis)
            .collect::<Vec<_>>()
            .try_into()
            .ok()?;
        let points: [V3; 6] = chain.points_at_zero().try_into().ok()?;
        let limits: [[f64; 2]; 6] = limits.try_into().ok()?;
        let wrist = wrist_centre(&axis, &points)?;
        let [a1, a2, a3, a4, a5, a6] = axis;
        let across = dot(a4, a5).abs() < GEOMETRY && dot(a5, a6).abs() < GEOMETRY;
        let arm = norm(cross(a2, a3)) < GEOMETRY && norm(cross(a1, a2)) > GEOMETRY;
        let upper = reject(sub(points[2], points[1]), a2);
        let fore = reject(sub(wrist, points[2]), a2);
        let long = norm(upper) > GEOMETRY && norm(fore) > GEOMETRY;
        let point = [points[0], points[1], points[2]];
        (across && arm && long).then(|| Self {
            axis,
            point,
            wrist,
            zero: chain.zero_pose(),
            upper,
            fore,
            limits,
        })
    }

    /// Every posture that brings the tool to `pose`, up to eight; none if it is out of reach.
    /// Where an angle is free (singularity) it is taken from `seed` (rad).
    pub fn solve(&self, pose: &Pose, seed: &[f64; 6]) -> Postures {
        self.postures(pose, seed, None)
    }

    /// [`Self::solve`] on one branch of A1 and A3 only: both hands of one arm, in a quarter of the time.
    pub fn solve_arm(&self, pose: &Pose, seed: &[f64; 6], arm: [bool; 2]) -> Postures {
        self.postures(pose, seed, Some(arm))
    }

    /// How far the pose's wrist lies from A2 in the plane of the arm, and how far the arm reaches at
    /// least and at most, m. A2 is where the pose's own A1 puts it.
    pub fn reach(&self, pose: &Pose) -> (f64, [f64; 2]) {
        let wrist = self.wrist_at(pose);
        let ([first, _], _) = self.first_angles(wrist, 0.0);
        let base: M3 = rotation(self.axis[0], first.unwrap_or(0.0));
        let local = add(self.point[0], rotate_back(&base, sub(wrist, self.point[0])));
        let far = norm(reject(sub(local, self.point[1]), self.axis[1]));
        let (upper, fore) = (norm(self.upper), norm(self.fore));
        (far, [(upper - fore).abs(), upper + fore])
    }

    fn wrist_at(&self, pose: &Pose) -> V3 {
        let turned = product(&pose.rotation, &transpose(&self.zero.rotation));
        let from_tip = rotate(&turned, sub(self.wrist, self.zero.point));
        add(pose.point, from_tip)
    }

    fn postures(&self, pose: &Pose, seed: &[f64; 6], arm: Option<[bool; 2]>) -> Postures {
        let wanted = |place: usize, k: usize| arm.is_none_or(|arm| arm[place] == (k == 1));
        let mut found = Postures::default();
        let turned = product(&pose.rotation, &transpose(&self.zero.rotation));
        let wrist = self.wrist_at(pose);
        let (first, shoulder) = self.first_angles(wrist, seed[0]);
        for (k1, q1) in branches(first, |k| wanted(0, k)) {
            let base: M3 = rotation(self.axis[0], q1);
            let local = add(self.point[0], rotate_back(&base, sub(wrist, self.point[0])));
            let (arms, elbow) = self.arm_angles(local);
            for (k3, (q2, q3)) in branches(arms, |k| wanted(1, k)) {
                let arm = turn(
                    &turn(&base, self.axis[1], q2.sin_cos()),
                    self.axis[2],
                    q3.sin_cos(),
                );
                let (hands, straight) =
                    self.hand_angles(&product(&transpose(&arm), &turned), seed[3]);
                for (k5, [q4, q5, q6]) in hands.into_iter().flatten().enumerate() {
                    let singular = Singularity {
                        shoulder,
                        elbow,
                        wrist: straight,
                    };
                    let branch = [k1 == 1, k3 == 1, k5 == 1];
                    found.push(self.posture([q1, q2, q3, q4, q5, q6], seed, branch, singular));
                }
            }
        }
        found
    }

    /// A1 from the wrist's distance to the plane of the arm, which A2 and A3 cannot change.
    fn first_angles(&self, wrist: V3, seed: f64) -> ([Option<f64>; 2], bool) {
        let (a1, u) = (self.axis[0], self.axis[1]);
        let r = sub(wrist, self.point[0]);
        let offset = dot(u, sub(self.wrist, self.point[0])) - dot(a1, r) * dot(a1, u);
        let (c, s) = (dot(u, reject(r, a1)), -dot(u, cross(a1, r)));
        if norm(reject(r, a1)) < 1e-12 {
            return ([(offset.abs() < GEOMETRY).then_some(seed), None], true);
        }
        let near = norm(reject(r, a1)) - offset.abs() < SINGULAR;
        (two_angles(c, s, offset), near)
    }

    /// A2 and A3 in the plane across them: a triangle of upper arm and forearm.
    fn arm_angles(&self, wrist: V3) -> ([Option<(f64, f64)>; 2], bool) {
        let u = self.axis[1];
        let sign = dot(self.axis[2], u).signum();
        let reach = reject(sub(wrist, self.point[1]), u);
        let (l1, l2) = (self.upper, self.fore);
        let cosine = 0.5 * (dot(reach, reach) - dot(l1, l1) - dot(l2, l2));
        let elbow = two_angles(dot(l1, l2), dot(l1, cross(u, l2)), cosine);
        let near = norm(l1) * norm(l2) - cosine.abs() < SINGULAR * SINGULAR;
        let bend = |angle: f64| {
            let arm = add(l1, rotate(&rotation(u, angle), l2));
            (angle_about(u, arm, reach), sign * angle)
        };
        (elbow.map(|angle| angle.map(bend)), near)
    }

    /// A4, A5, A6 from the orientation left over.
    fn hand_angles(&self, rest: &M3, seed: f64) -> ([Option<[f64; 3]>; 2], bool) {
        let [_, _, _, a4, a5, a6] = self.axis;
        let ahead = rotate(rest, a6);
        let (along, across) = (dot(a4, ahead), norm(cross(a4, ahead)));
        let start = dot(a4, cross(a5, a6)).atan2(dot(a4, a6));
        let lean = across.atan2(along);
        let straight = across < SINGULAR;
        let complete = |q5: f64| {
            let tilted = rotate(&rotation(a5, q5), a6);
            let q4 = if across < 1e-12 {
                seed
            } else {
                angle_about(a4, tilted, ahead)
            };
            let hand = turn(&rotation(a4, q4), a5, q5.sin_cos());
            let side = rotate_back(&hand, rotate(rest, a5));
            [q4, q5, angle_about(a6, a5, side)]
        };
        // A4 and A6 half a turn on, A5 leant the other way: the same hand, since A5 is across both
        let first = complete(start + lean);
        let second = [first[0] + PI, start - lean, first[2] + PI];
        ([Some(first), (across >= 1e-12).then_some(second)], straight)
    }

    fn posture(
        &self,
        q: [f64; 6],
        seed: &[f64; 6],
        branch: [bool; 3],
        singular: Singularity,
    ) -> Posture {
        let mut posture = Posture {
            q,
            branch,
            reachable: true,
            singular,
        };
        for ((q, seed), limits) in posture.q.iter_mut().zip(seed).zip(&self.limits) {
            let (angle, inside) = within(*q, *seed, limits);
            *q = angle;
            posture.reachable &= inside;
        }
        posture
    }
}

/// The solutions of the wanted branches with their numbers, counted among those that exist.
fn branches<T>(
    all: [Option<T>; 2],
    wanted: impl Fn(usize) -> bool,
) -> impl Iterator<Item = (usize, T)> {
    let there = all.into_iter().flatten().enumerate();
    there.filter(move |(k, _)| wanted(*k))
}

/// The full turn of `q` that lies inside the limits nearest to `seed`, and whether there is one.
fn within(q: f64, seed: f64, [low, high]: &[f64; 2]) -> (f64, bool) {
    const SLACK: f64 = 1e-9;
    let nearest = q + TAU * ((seed - q) / TAU).round();
    if nearest >= low - SLACK && nearest <= high + SLACK {
        return (nearest, true);
    }
    let turns = [
        nearest - TAU,
        nearest + TAU,
        nearest - 2.0 * TAU,
        nearest + 2.0 * TAU,
    ];
    let inside = turns
        .into_iter()
        .filter(|q| *q >= low - SLACK && *q <= high + SLACK);
    let best = inside.min_by(|a, b| (a - seed).abs().total_cmp(&(b - seed).abs()));
    let wrapped = q - TAU * ((q + PI) / TAU).floor();
    best.map_or((wrapped, false), |q| (q, true))
}

/// Both angles with c·cos + s·sin = k; none if |k| exceeds the amplitude beyond rounding.
fn two_angles(c: f64, s: f64, k: f64) -> [Option<f64>; 2] {
    let amplitude = c.hypot(s);
    let square = (amplitude - k) * (amplitude + k);
    if amplitude == 0.0 || square < -1e-12 * amplitude * amplitude {
        return [None; 2];
    }
    let (middle, half) = (s.atan2(c), square.max(0.0).sqrt().atan2(k));
    [Some(middle + half), (square > 0.0).then_some(middle - half)]
}

/// Angle about the unit vector u that turns `from` into the direction of `to`, both across u.
fn angle_about(u: V3, from: V3, to: V3) -> f64 {
    let (from, to) = (reject(from, u), reject(to, u));
    dot(u, cross(from, to)).atan2(dot(from, to))
}

/// The part of v across the unit vector u.
fn reject(v: V3, u: V3) -> V3 {
    sub(v, scale(dot(v, u), u))
}

/// Where A4, A5 and A6 meet, if they do.
fn wrist_centre(axis: &[V3; 6], point: &[V3; 6]) -> Option<V3> {
    let [_, _, _, a4, a5, a6] = *axis;
    let normal = cross(a4, a5);
    let gap = sub(point[4], point[3]);
    let along = dot(cross(gap, a4), normal) / dot(normal, normal);
    let centre = add(point[4], scale(along, a5));
    let off = |axis: V3, point: V3| norm(cross(sub(centre, point), axis));
    let meets = off(a4, point[3]) < GEOMETRY && off(a6, point[5]) < GEOMETRY;
    (meets && centre.iter().all(|x| x.is_finite())).then_some(centre)
}
