//! Static and single-valued: gaps and soft zones, about zero load unless a weight shifts them, springs that stiffen or soften.

use super::shape::{Sign, even, geometric};
use super::{Family, Shapes, View};

/// A gap: a step at a free place, rounded by the contact, or held by friction; a weight may hold it open when the zero is
/// set, and then the step is nought at no load.
pub const BACKLASH: Family = Family {
    cause: "backlash",
    mechanism: "static, odd",
    suits: |_| true,
    members: backlash,
};

/// A softer spring about zero load, or about another where a weight moves it there.
pub const SOFT_ZONE: Family = Family {
    cause: "soft_zone",
    mechanism: "static, odd",
    suits: |_| true,
    members: soft_zone,
};

/// Stiffness that changes with the load.
pub const CUBIC_STIFFNESS: Family = Family {
    cause: "cubic_stiffness",
    mechanism: "static, odd",
    suits: |_| true,
    members: cubic_stiffness,
};

/// Loads over which flanks come into contact, of the largest load.
const ROUNDED: [f64; 6] = [0.004, 0.008, 0.013, 0.02, 0.027, 0.035];

fn clip(u: f64, m: f64) -> f64 {
    (u / m).clamp(-1.0, 1.0)
}

fn step(u: f64, width: f64) -> f64 {
    u / u.hypot(width)
}

fn backlash(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    if !view.two_sided {
        preloaded(view, &mut shapes);
        return shapes;
    }
    for width in ROUNDED {
        shapes.positive(view, &view.over_load(|u| step(u, width)));
    }
    for place in even(-0.35, 0.35, 57) {
        for width in [0.008, 0.025] {
            let zero = step(-place, width);
            shapes.positive(view, &view.over_load(|u| step(u - place, width)));
            shapes.positive(view, &view.over_load(|u| step(u - place, width) - zero));
        }
    }
    for held in [0.015, 0.03, 0.05, 0.08, 0.12] {
        let played = view.played(held);
        for width in [0.008, 0.025] {
            let own: Vec<f64> = played.iter().map(|u| step(*u, width)).collect();
            shapes.positive(view, &own);
        }
    }
    let widths = geometric(0.006, 0.06, 6);
    let clips: Vec<Vec<f64>> = widths
        .iter()
        .map(|m| view.over_load(|u| clip(u, *m)))
        .collect();
    shapes.density(
        view,
        &clips,
        &[1.0, 1.0, 1.0, 0.7, 0.4, 0.2],
        (0.7, Sign::Positive),
    );
    shapes
}

/// A gap that a weight holds open, under loads of one sign: it shows where the load reaches it.
fn preloaded(view: &View, shapes: &mut Shapes) {
    let side = view.side();
    for place in even(0.06, 0.5, 45) {
        for width in [0.008, 0.025] {
            let zero = step(-place, width);
            shapes.positive(
                view,
                &view.over_load(|u| side * (step(side * u - place, width) - zero)),
            );
        }
    }
}

/// A soft zone that a weight moves off the zero.
fn shifted(view: &View, shapes: &mut Shapes) {
    let sides: &[f64] = if view.two_sided {
        &[-1.0, 1.0]
    } else {
        &[view.side()]
    };
    for (place, half) in [
        (0.1, 0.1),
        (0.2, 0.1),
        (0.2, 0.2),
        (0.3, 0.12),
        (0.3, 0.22),
        (0.42, 0.15),
        (0.42, 0.25),
        (0.55, 0.15),
        (0.55, 0.25),
    ] {
        for side in sides {
            let at = |u: f64| (side * u - place).clamp(-half, half);
            shapes.positive(view, &view.over_load(|u| side * (at(u) - at(0.0))));
        }
    }
}

fn soft_zone(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    shifted(view, &mut shapes);
    for m in geometric(0.07, 0.72, 22) {
        shapes.positive(view, &view.over_load(|u| clip(u, m)));
    }
    // contacts that come to bear one after the other: no edge, but nothing is left of it at the largest load
    for m in geometric(0.08, 0.4, 8) {
        shapes.positive(view, &view.over_load(|u| (u / m).tanh()));
        shapes.positive(
            view,
            &view.over_load(|u| u.signum() * (1.0 - (-u.abs() / m).exp())),
        );
    }
    for m in [0.12, 0.2, 0.32, 0.5] {
        let about: Vec<f64> = [0.6, 0.8, 1.0, 1.25, 1.55].map(|f| f * m).to_vec();
        let clips: Vec<Vec<f64>> = about
            .iter()
            .map(|m| view.over_load(|u| clip(u, *m)))
            .collect();
        shapes.density(
            view,
            &clips,
            &[0.4, 1.0, 1.5, 1.0, 0.4],
            (0.6, Sign::Positive),
        );
    }
    shapes
}

fn cubic_stiffness(view: &View) -> Shapes {
    let mut shapes = Shapes::none();
    let power = |p: f64| view.over_load(|u| u.signum() * u.abs().powf(p));
    for p in [
        0.6, 0.67, 0.75, 0.85, 1.25, 1.5, 1.75, 2.0, 2.25, 2.5, 2.75, 3.0, 3.3, 3.6, 4.0, 4.5,
    ] {
        shapes.one(view, &power(p));
    }
    for b in [1.5, 2.5, 4.0, 6.0] {
        shapes.one(view, &view.over_load(|u| (b * u).asinh()));
    }
    shapes.one(view, &view.over_load(|u| (1.1 * u).tan()));
    let widths = geometric(0.15, 0.85, 6);
    let clips: Vec<Vec<f64>> = widths
        .iter()
        .map(|m| view.over_load(|u| clip(u, *m)))
        .collect();
    shapes.density(view, &clips, &[1.0; 6], (0.5, Sign::Any));
    shapes.density(
        view,
        &[1.5, 2.0, 3.0, 5.0].map(power),
        &[1.0; 4],
        (0.5, Sign::Any),
    );
    shapes
}
