//! A body that moves along a line: a turn about an axis so far away that it is none.

use crate::ground::spatial::{V3, normals, scale};
use crate::robot::Spring;
use crate::robot::model::ElasticAxis;

/// Distance of that axis, m: what moves a metre beside the line moves 0.2 mrad off its direction.
pub(super) const FAR: f64 = 5000.0;

/// Motion behind joint `after` along a unit vector (base frame, every joint at zero). The spring is that of the turn: a
/// metre along the line is 1/[`FAR`] rad.
pub(super) fn slide(name: String, after: usize, line: V3, spring: Spring) -> ElasticAxis {
    let (axis, away) = normals(line);
    ElasticAxis {
        name,
        after,
        axis,
        point: scale(FAR, away),
        spring,
        body: None,
    }
}
