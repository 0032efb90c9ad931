//! On which side of the hinges of its link a cube sits.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, dot, sub};
use crate::measurement::cubes::Cube;
use crate::motion::kinematics::hinge_point;
use crate::motion::{Chain, Work};
use crate::robot::Robot;
use crate::robot::model::ElasticAxis;

/// Hinges before a cube: those up to the drive of its link, and the elastic axes of the link up to the one
/// it lies beyond.
pub(super) fn before(
    (elastic, dof): (&[ElasticAxis], usize),
    chain: &Chain,
    cube: &Cube,
) -> Outcome<usize> {
    let refuse = |what: String, remedy: String| {
        Problem::new(format!("cube `{}` {what}", cube.name), remedy).in_column("cubes")
    };
    let own: Vec<&str> = elastic
        .iter()
        .filter(|axis| axis.after == cube.after)
        .map(|axis| axis.name.as_str())
        .collect();
    let start = match cube.after {
        0 => 0,
        n => {
            1 + *chain.drives.get(n - 1).ok_or_else(|| {
                refuse(
                    format!("sits after axis {n}"),
                    format!("`after` goes from 0 to {dof}"),
                )
            })?
        }
    };
    match &cube.beyond {
        None => Ok(start),
        Some(name) => match own.iter().position(|known| known == name) {
            Some(i) => Ok(start + i + 1),
            None => Err(refuse(
                format!(
                    "lies beyond `{name}`, which is no elastic axis of link {}",
                    cube.after
                ),
                format!(
                    "leave `beyond` out, or name one of: {}",
                    if own.is_empty() {
                        "none there".into()
                    } else {
                        own.join(", ")
                    }
                ),
            )),
        },
    }
}

/// Elastic axes that are no part of the robot file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AddedAxes {
    /// Index of the first among those of the robot.
    pub first: usize,
    /// Whether cubes of the foundation (`after` 0) sit on the floor, not on the foot that it lets move.
    pub is_floor: bool,
}

/// Share of the way from the flange to the tool centre point beyond which a cube sits on the tool: no robot file without a spring
/// there has a name for `beyond`. Half way: a choice.
const ON_TOOL: f64 = 0.5;

/// Bends within the link of a cube that lie nearer along the link than it, where they are no part of the robot file.
/// A cube before an axis of the file lies before them too. Cubes of the foundation have all of its own before them, or none;
/// those of the tool sit behind its bends. `tcp`: the tool centre point, base frame, m.
pub(super) fn bends_before(
    (robot, added): (&Robot, AddedAxes),
    chain: &Chain,
    (work, tcp): (&Work, V3),
    (cube, from): (&Cube, usize),
) -> usize {
    let own = |axes: &[ElasticAxis]| axes.iter().filter(|a| a.after == cube.after).count();
    let (known, unknown) = robot.elastic.split_at(added.first);
    if cube.after == 0 {
        let moves = !added.is_floor && from >= own(known);
        return if moves { own(unknown) } else { 0 };
    }
    let bends = own(unknown);
    let place = |hinge: usize| hinge_point(work, hinge);
    let (near, way, least) = match chain.drives.get(cube.after - 1..) {
        Some([near, far, ..]) => (near, sub(place(*far), place(*near)), 0.0),
        Some([near]) if bends > 0 => {
            let way = sub(tcp, place(from));
            let least = if own(known) > 0 { 0.0 } else { ON_TOOL };
            (near, way, least * dot(way, way))
        }
        _ => return 0,
    };
    if from <= *near + own(known) {
        return 0;
    }
    let is_behind = |hinge: &usize| dot(way, sub(cube.centre, place(*hinge))) > least;
    (from..from + bends).take_while(is_behind).count()
}
