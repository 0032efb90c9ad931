//! Closed-form inverse kinematics of six axes with A2 ∥ A3 and a spherical wrist (the family of
//! Brandstötter, Angerer and Hofbaur 2014), solved on the axes themselves as the robot file gives
//! them (Paden–Kahan subproblems; Murray, Li and Sastry 1994, section 3.2): signs and zeros of any
//! maker need no convention of their own.
//!
//! Three frames are laid through the axes once; in them every rotation is a point of the unit circle that
//! follows from lengths. No sine or cosine is taken: one arc tangent for each angle of the answer.

use super::chain::Chain;
use super::circle::{Circle, angle, between, circle, together, turned_back};
use super::posture::within;
pub use super::posture::{Posture, Postures, Singularity};
use crate::ground::arctangent::arctangents;
use crate::ground::spatial::{
    M3, Pose, V3, add, cross, dot, norm, product, rotate, rotate_back, scale, sub, transpose, unit,
};
use std::f64::consts::PI;

/// Lengths (m) and direction sines below this count as zero when the geometry is recognised.
const GEOMETRY: f64 = 1e-7;
/// Below this lever (m) or sine a posture is reported singular.
pub const SINGULAR: f64 = 1e-6;
/// Below this lever (m) or sine an angle is free.
const FREE: f64 = 1e-12;

/// The geometry of such a robot, recognised once. Frames, as rows: `base` (A1 along its third row, A2
/// across its second), `arm` (A2 along its third, the upper arm along its first), `hand` (A4 along its third, A5 along
/// its second), every joint at zero.
#[derive(Debug, Clone)]
pub struct SphericalWrist {
    /// A point of A1, m, base frame of the robot.
    foot: V3,
    base: M3,
    /// The wrist centre (m, from the tip) and the directions of A6 and A5 in the tool frame.
    tool: [V3; 3],
    /// Offset of the wrist along A2 from `foot`, m; sine and cosine of the angle between A1 and A2.
    offset: f64,
    across: [f64; 2],
    arm_in_base: M3,
    /// A2's point from `foot`, in the frame `arm`, m.
    shoulder: [f64; 2],
    /// Upper arm and forearm, m.
    lengths: [f64; 2],
    /// Angle of the forearm to the upper arm at zero, and its circle.
    bend: (f64, Circle),
    /// ±1: A3 turns as A2, or against it.
    sign: f64,
    hand_in_arm: M3,
    /// Angle of A6 to A4 at zero, about A5, rad.
    lean: f64,
    limits: [[f64; 2]; 6],
}

/// What one solution of A1 leaves over.
struct Shoulder {
    branch: bool,
    /// Both solutions of A3 and what is near singular so far.
    elbows: [Option<(bool, Circle)>; 2],
    singular: Singularity,
    q1: f64,
    /// Half the difference of the two angles of A3, rad.
    half: f64,
    /// From A2 to the wrist in the plane of the arm, m.
    reach: [f64; 2],
    /// A6 and A5 as the pose wants them, in the frame `arm` at A2 = A3 = 0.
    wanted: [V3; 2],
}

impl SphericalWrist {
    /// Recognises the geometry of a rigid chain; `None` if it is another one (then see
    /// [`super::numeric::solve`]). `limits`: one [low, high] per joint, rad.
    pub fn of(chain: &Chain, limits: &[[f64; 2]]) -> Option<Self> {
        let axes: Vec<V3> = chain.hinges.iter().map(|hinge| hinge.axis).collect();
        let axis: [V3; 6] = axes.try_into().ok()?;
        let points: [V3; 6] = chain.points_at_zero().try_into().ok()?;
        let limits: [[f64; 2]; 6] = limits.try_into().ok()?;
        let wrist = wrist_centre(&axis, &points)?;
        let [a1, a2, a3, a4, a5, a6] = axis;
        let across = dot(a4, a5).abs() < GEOMETRY && dot(a5, a6).abs() < GEOMETRY;
        let parallel = norm(cross(a2, a3)) < GEOMETRY && norm(cross(a1, a2)) > GEOMETRY;
        let upper = reject(sub(points[2], points[1]), a2);
        let fore = reject(sub(wrist, points[2]), a2);
        let long = norm(upper) > GEOMETRY && norm(fore) > GEOMETRY;
        if !(across && parallel && long) {
            return None;
        }
        let base = frame(a1, a2)?;
        let arm = frame(a2, upper)?;
        let hand = frame(a4, cross(a5, a4))?;
        let zero = chain.zero_pose();
        let in_tool = |v: V3| rotate_back(&zero.rotation, v);
        let at = |v: V3| [dot(arm[0], v), dot(arm[1], v)];
        let bend = angle(at(fore));
        Some(Self {
            foot: points[0],
            tool: [in_tool(sub(wrist, zero.point)), in_tool(a6), in_tool(a5)],
            offset: dot(a2, sub(wrist, points[0])),
            across: [dot(base[0], a2), dot(a1, a2)],
            arm_in_base: product(&arm, &transpose(&base)),
            shoulder: at(sub(points[1], points[0])),
            lengths: [norm(upper), norm(fore)],
            bend: (bend, circle(bend)),
            sign: dot(a3, a2).signum(),
            hand_in_arm: product(&hand, &transpose(&arm)),
            lean: angle([dot(a4, a6), dot(hand[0], a6)]),
            base,
            limits,
        })
    }

    /// Every posture that brings the tool to `pose`, up to eight; none if it is out of reach.
    /// Where an angle is free (singularity) it is taken from `seed` (rad).
    pub fn solve(&self, pose: &Pose, seed: &[f64; 6]) -> Postures {
        self.postures(pose, seed, |_, _| true)
    }

    /// [`Self::solve`] on one branch of A1 and A3 only: both hands of one arm, in a quarter of the time.
    pub fn solve_arm(&self, pose: &Pose, seed: &[f64; 6], arm: [bool; 2]) -> Postures {
        self.postures(pose, seed, |place, branch| arm[place] == branch)
    }

    /// How far the pose's wrist lies from A2 in the plane of the arm, and how far the arm reaches at
    /// least and at most, m. A2 is where the pose's own A1 puts it.
    pub fn reach(&self, pose: &Pose) -> (f64, [f64; 2]) {
        let wrist = self.in_base(pose)[0];
        let (turns, _) = self.first_turns(wrist, 0.0);
        let turn = turns[0].unwrap_or([1.0, 0.0]);
        let [x, y] = self.beyond_shoulder(turned_back(wrist, turn));
        let [upper, fore] = self.lengths;
        (x.hypot(y), [(upper - fore).abs(), upper + fore])
    }

    /// The wrist (m, from `foot`) and the directions of A6 and A5, in the frame `base`.
    #[inline(always)]
    fn in_base(&self, pose: &Pose) -> [V3; 3] {
        let [wrist, a6, a5] = self.tool.map(|v| rotate(&pose.rotation, v));
        let wrist = add(sub(pose.point, self.foot), wrist);
        [wrist, a6, a5].map(|v| rotate(&self.base, v))
    }

    #[inline(always)]
    fn postures(
        &self,
        pose: &Pose,
        seed: &[f64; 6],
        wanted: impl Fn(usize, bool) -> bool,
    ) -> Postures {
        let mut found = Postures::default();
        let [wrist, a6, a5] = self.in_base(pose);
        let (turns, free) = self.first_turns(wrist, seed[0]);
        let there = turns.into_iter().flatten().zip([false, true]);
        for (turn, branch) in there.filter(|(_, branch)| wanted(0, *branch)) {
            let to_arm = |v: V3| rotate(&self.arm_in_base, turned_back(v, turn));
            let reach = self.beyond_shoulder(turned_back(wrist, turn));
            let shoulder = self.shoulder(turn, branch, free, reach, [to_arm(a6), to_arm(a5)]);
            for (elbow, bend) in shoulder.elbows.iter().flatten() {
                if wanted(1, *elbow) {
                    self.hands(&shoulder, *elbow, *bend, seed, &mut found);
                }
            }
        }
        found
    }

    /// A1 from the wrist's distance to the plane of the arm, which A2 and A3 cannot change; and
    /// whether the wrist is near A1.
    #[inline(always)]
    fn first_turns(&self, [x, y, z]: V3, seed: f64) -> ([Option<Circle>; 2], bool) {
        let [sin, cos] = self.across;
        let offset = (self.offset - cos * z) / sin;
        let square = x * x + y * y;
        let lever = square.sqrt();
        if lever < FREE {
            let only = (offset.abs() < GEOMETRY).then(|| circle(seed));
            return ([only, None], true);
        }
        let along = (lever - offset) * (lever + offset);
        let depth = along.max(0.0).sqrt();
        let turn = |depth: f64| {
            let (c, s) = (offset * x + depth * y, offset * y - depth * x);
            let size = 1.0 / (c * c + s * s).sqrt();
            [c * size, s * size]
        };
        let first = (along >= -1e-12 * square).then(|| turn(-depth));
        let second = (along > 0.0).then(|| turn(depth));
        ([first, second], lever - offset.abs() < SINGULAR)
    }

    /// From A2 to the wrist in the plane of the arm, of a wrist in the frame `base`, m.
    #[inline(always)]
    fn beyond_shoulder(&self, wrist: V3) -> [f64; 2] {
        let [x, y] = [0, 1].map(|i| dot(self.arm_in_base[i], wrist));
        [x - self.shoulder[0], y - self.shoulder[1]]
    }

    /// A3 in the plane across it: a triangle of upper arm and forearm.
    #[inline(always)]
    fn shoulder(
        &self,
        turn: Circle,
        branch: bool,
        free: bool,
        reach: [f64; 2],
        wanted: [V3; 2],
    ) -> Shoulder {
        let [upper, fore] = self.lengths;
        let both = upper * fore;
        let far = reach[0] * reach[0] + reach[1] * reach[1];
        let along = 0.5 * (far - upper * upper - fore * fore);
        let square = (both - along) * (both + along);
        let side = square.max(0.0).sqrt();
        let size = 1.0 / (along * along + side * side).sqrt();
        let (cos, sin) = (along * size, side * size);
        let [q1, half] = arctangents([turn[1], side], [turn[0], along]);
        Shoulder {
            branch,
            elbows: [
                (square >= -1e-12 * both * both).then_some((false, [cos, sin])),
                (square > 0.0).then_some((true, [cos, -sin])),
            ],
            singular: Singularity {
                shoulder: free,
                elbow: both - along.abs() < SINGULAR * SINGULAR,
                wrist: false,
            },
            q1,
            half,
            reach,
            wanted,
        }
    }

    /// A2 from the triangle, A4, A5 and A6 from the orientation left over: both hands of one arm.
    #[inline(always)]
    fn hands(
        &self,
        shoulder: &Shoulder,
        elbow: bool,
        bent: Circle,
        seed: &[f64; 6],
        found: &mut Postures,
    ) {
        let [upper, fore] = self.lengths;
        let wrist = [upper + fore * bent[0], fore * bent[1]];
        let lift = between(wrist, shoulder.reach);
        let size = 1.0 / (lift[0] * lift[0] + lift[1] * lift[1]).sqrt();
        let lift = lift.map(|x| x * size);
        let arm = together(lift, between(self.bend.1, bent));
        let [ahead, side] = shoulder
            .wanted
            .map(|v| rotate(&self.hand_in_arm, turned_back(v, arm)));
        let across = (ahead[0] * ahead[0] + ahead[1] * ahead[1]).sqrt();
        let free = across < FREE;
        let hand = match free {
            true => circle(seed[3]),
            false => [ahead[0] / across, ahead[1] / across],
        };
        let rolled = turned_back(side, hand);
        let roll = across * rolled[2] - ahead[2] * rolled[0];
        let [q2, q4, lean, q6] = arctangents(
            [lift[1], hand[1], across, roll],
            [lift[0], hand[0], ahead[2], rolled[1]],
        );
        let q4 = if free { seed[3] } else { q4 };
        let half = if elbow { -shoulder.half } else { shoulder.half };
        let q3 = self.sign * (half - self.bend.0);
        let singular = Singularity {
            wrist: across < SINGULAR,
            ..shoulder.singular
        };
        let mut push = |hand: bool, [q4, q5, q6]: [f64; 3]| {
            let (q, reachable) = within(&[shoulder.q1, q2, q3, q4, q5, q6], seed, &self.limits);
            found.push(Posture {
                q,
                branch: [shoulder.branch, elbow, hand],
                reachable,
                singular,
            });
        };
        push(false, [q4, lean - self.lean, q6]);
        // A4 and A6 half a turn on, A5 leant the other way: the same hand, since A5 is across both
        if !free {
            push(true, [q4 + PI, -lean - self.lean, q6 + PI]);
        }
    }
}

/// A right-handed frame, as rows: the third along `along`, the first as near to `first` as can be.
fn frame(along: V3, first: V3) -> Option<M3> {
    let first = unit(reject(first, along))?;
    Some([first, cross(along, first), along])
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
