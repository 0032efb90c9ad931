//! A zero that is none.

use super::{Family, Shapes};
use crate::findings::engine::LEVEL;

/// The same in every reading.
pub const SENSOR_OFFSET: Family = Family {
    cause: "sensor_offset",
    mechanism: LEVEL,
    suits: |_| true,
    members: |view| {
        let mut shapes = Shapes::none();
        shapes.one(view, &vec![1.0; view.rows()]);
        shapes
    },
};
