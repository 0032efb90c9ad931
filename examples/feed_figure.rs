//! Draws `docs/feed.svg`: the feed on a blend if its parameter runs evenly (source 000, eq. 4.10), beside the
//! feed by true arc length. `cargo run --release --example feed_figure`.

use ident::ground::vector::norm;
use ident::path::arc_length::{ArcLength, Parametric};
use ident::path::bezier::{Bezier, End};
use ident::report::svg;
use ident::sheet::chart::{Axis, Chart, Panel, Series};

const STEPS: usize = 200;

/// The blend of a corner of so many degrees that begins 2 mm from it.
fn blend(degrees: f64) -> Bezier {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let end = |point, tangent| End {
        point,
        tangent,
        curvature: [0.0; 3],
    };
    Bezier::between(
        &end([-2e-3, 0.0, 0.0], [1.0, 0.0, 0.0]),
        &end([2e-3 * cos, 2e-3 * sin, 0.0], [cos, sin, 0.0]),
    )
}

/// Share of the way (%) and feed against the asked one (%), the parameter running evenly.
fn uneven(degrees: f64) -> Vec<[f64; 2]> {
    let curve = blend(degrees);
    let table = ArcLength::of(&curve, &[0.0, 1.0]);
    let at = |i: usize| {
        let u = i as f64 / STEPS as f64;
        let share = table.to(&curve, u) / table.total();
        [
            100.0 * share,
            100.0 * norm(curve.velocity(u)) / table.total(),
        ]
    };
    (0..=STEPS).map(at).collect()
}

fn main() {
    let panel = Panel::new(
        Axis::new("Way through the blend", "%"),
        Axis::new("Feed", "% of the asked"),
    )
    .with(Series::line(
        "even parameter, corner of 90 degrees",
        uneven(90.0),
    ))
    .with(Series::line(
        "even parameter, corner of 150 degrees",
        uneven(150.0),
    ))
    .with(Series::dashed(
        "by true arc length",
        vec![[0.0, 100.0], [100.0, 100.0]],
    ));
    let chart = Chart::new(
        "feed",
        "Feed on a blend",
        "A quintic blend run with an even step of its parameter, and by its arc length.",
    )
    .with(panel);
    let ink = svg::ink(&chart).expect("a chart of three series");
    std::fs::write("docs/feed.svg", ink).expect("docs/feed.svg can be written");
    for degrees in [90.0, 150.0] {
        let feeds: Vec<f64> = uneven(degrees).iter().map(|point| point[1]).collect();
        let (low, high) = feeds
            .iter()
            .fold((f64::MAX, 0.0_f64), |(l, h), f| (l.min(*f), h.max(*f)));
        println!("{degrees} degrees: {low:.2} to {high:.2} % of the asked feed");
    }
}
