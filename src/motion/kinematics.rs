//! Where everything is: link frames, tool pose, Jacobian.

use super::chain::Chain;
use super::work::Work;
use crate::ground::dual::Scalar;
use crate::ground::spatial::{
    IDENTITY, Inertia, M3, Motion, Pose, V3, add, cross, lift, lift_matrix, product,
    rotate_constant, rotate_tensor, sub, turn,
};
use crate::ground::trig;

/// Places every link for the angles `q` (n, rad): orientation, hinge point, screw.
pub fn place<S: Scalar>(chain: &Chain, work: &mut Work<S>, q: &[S]) {
    trig::sines_cosines(q.iter().map(|q| q.value()), &mut work.turn);
    let mut rotation = lift_matrix(IDENTITY);
    let mut point = lift([0.0; 3]);
    let links = work
        .rotation
        .iter_mut()
        .zip(&mut work.point)
        .zip(&mut work.screw);
    let angles = q.iter().zip(&work.turn);
    for ((hinge, (q, (sin, cos))), ((frame, at), screw)) in
        chain.hinges.iter().zip(angles).zip(links)
    {
        point = add(point, rotate_constant(&rotation, hinge.offset));
        screw.ang = rotate_constant(&rotation, hinge.axis);
        rotation = turn(
            &rotation,
            hinge.axis,
            (q.chain(*sin, *cos), q.chain(*cos, -*sin)),
        );
        (*frame, *at) = (rotation, point);
    }
    refer(work, point);
}

/// Writes every screw about `reference`.
fn refer<S: Scalar>(work: &mut Work<S>, reference: V3<S>) {
    work.reference = reference;
    for (screw, point) in work.screw.iter_mut().zip(&work.point) {
        *screw = Motion::about(screw.ang, sub(*point, reference));
    }
}

/// Inertias of all bodies in base axes about the reference point; needs [`place`].
pub(super) fn weigh<S: Scalar>(chain: &Chain, work: &mut Work<S>) {
    let frames = work.rotation.iter().zip(&work.point);
    for ((hinge, (rotation, point)), inertia) in
        chain.hinges.iter().zip(frames).zip(&mut work.inertia)
    {
        if let Some(body) = &hinge.body {
            let centre = add(
                sub(*point, work.reference),
                rotate_constant(rotation, body.com),
            );
            *inertia =
                Inertia::about_reference(body.mass, centre, rotate_tensor(rotation, &body.inertia));
        }
    }
}

/// Tool pose after [`place`].
pub fn tcp<S: Scalar>(chain: &Chain, work: &Work<S>) -> Pose<S> {
    let (Some(rotation), Some(point)) = (work.rotation.last(), work.point.last()) else {
        let zero = chain.zero_pose();
        return Pose {
            rotation: lift_matrix(zero.rotation),
            point: lift(zero.point),
        };
    };
    Pose {
        rotation: product(rotation, &lift_matrix(chain.tip_rotation)),
        point: add(*point, rotate_constant(rotation, chain.tip)),
    }
}

/// Tool pose for the angles `q` (n, rad).
pub fn forward_kinematics<S: Scalar>(chain: &Chain, work: &mut Work<S>, q: &[S]) -> Pose<S> {
    place(chain, work, q);
    tcp(chain, work)
}

/// The point of hinge i after [`place`], m, base frame.
pub fn hinge_point<S: Scalar>(work: &Work<S>, i: usize) -> V3<S> {
    work.point[i]
}

/// Orientation of the body behind hinge i after [`place`]: its axes at zero, turned, as columns.
pub fn hinge_rotation<S: Scalar>(work: &Work<S>, i: usize) -> M3<S> {
    work.rotation[i]
}

/// Column i of the Jacobian at `point` (base frame, m) after [`place`]: velocity of the point (m/s)
/// and of the tool (rad/s), base axes, per rad/s of hinge i.
#[inline]
pub fn column<S: Scalar>(work: &Work<S>, i: usize, point: V3<S>) -> (V3<S>, V3<S>) {
    let axis = work.screw[i].ang;
    (cross(axis, sub(point, work.point[i])), axis)
}

/// Jacobian at the tool centre point, 6×n: one array per hinge, rows v (m/rad) then ω, base axes.
/// Needs [`place`].
pub fn jacobian<S: Scalar>(chain: &Chain, work: &Work<S>) -> Vec<[S; 6]> {
    let at = tcp(chain, work).point;
    let columns = (0..chain.len()).map(|i| column(work, i, at));
    columns
        .map(|(v, w)| [v[0], v[1], v[2], w[0], w[1], w[2]])
        .collect()
}
