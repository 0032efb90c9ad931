//! Static, single-valued, even in the load: pull unlike push.

use super::shape::even;
use super::{Family, Shapes, View};

/// One side is softer than the other; seen only where the load takes both signs.
pub const ASYMMETRY: Family = Family {
    cause: "asymmetry",
    mechanism: "static, even",
    suits: |view| view.two_sided,
    members: asymmetry,
};

fn asymmetry(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    for p in [0.8, 1.0, 1.3, 1.6, 2.0, 2.5] {
        shapes.one(view, &view.over_load(|u| u.abs().powf(p)));
    }
    for side in [-1.0, 1.0] {
        for at in even(0.025, 0.5, 20) {
            shapes.one(view, &view.over_load(|u| (side * u - at).max(0.0)));
        }
        for p in [1.3, 1.6, 2.0, 2.5] {
            shapes.one(view, &view.over_load(|u| (side * u).max(0.0).powf(p)));
        }
    }
    shapes
}
