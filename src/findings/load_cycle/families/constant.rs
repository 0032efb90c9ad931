//! A zero that is none.

use super::{Family, Shapes};

/// The same in every reading.
pub const SENSOR_OFFSET: Family = Family {
    cause: "sensor_offset",
    mechanism: "constant",
    suits: |_| true,
    members: |view| {
        let mut shapes = Shapes::none();
        shapes.one(view, &vec![1.0; view.rows()]);
        shapes
    },
};
