//! The figures of `ident mill`.

use super::super::part_map::{classes, thinned};
use super::Result;
use crate::ground::spatial::norm;
use crate::process::run::Cut;
use crate::process::setup::Support;
use crate::sheet::chart::{Axis, Chart, Panel, Series};

/// Most points of one line.
const POINTS: usize = 2000;
/// Most points of a map.
const PLACES: usize = 6000;

/// Force and deviation over the path.
pub fn course(result: &Result) -> Chart {
    let cuts = thinned(&result.milled.course, POINTS, |cut| norm(cut.deviation));
    let way = Axis::new("Path", "mm");
    let over = |value: &dyn Fn(&Cut) -> f64| {
        cuts.iter()
            .map(|cut| [1e3 * cut.s_m, value(cut)])
            .collect::<Vec<_>>()
    };
    let mut force = Panel::new(way.clone(), Axis::new("Force", "N"));
    for (k, name) in ["x", "y", "z"].iter().enumerate() {
        force = force.with(Series::line(*name, over(&|cut| cut.force[k])));
    }
    let chart = Chart::new(
        "mill-course",
        "Force and deviation over the path",
        "Force on the tool and deviation of its tip, workpiece frame, each averaged over a revolution.",
    )
    .with(force)
    .synthetic(result.planned.job.synthetic);
    if result.support == Support::Rigid {
        return chart;
    }
    let mut deviation = Panel::new(way, Axis::new("Deviation", "mm"));
    for (k, name) in ["x", "y", "z"].iter().enumerate() {
        deviation = deviation.with(Series::line(*name, over(&|cut| 1e3 * cut.deviation[k])));
    }
    chart.with(deviation)
}

/// The deviation where it arises, in classes.
pub fn map(result: &Result) -> Chart {
    let cutting: Vec<Cut> = result
        .milled
        .course
        .iter()
        .filter(|c| c.cutting)
        .copied()
        .collect();
    let size = |cut: &Cut| 1e3 * norm(cut.normal());
    let cuts = thinned(&cutting, PLACES, size);
    let place = |cut: &Cut| [1e3 * cut.tip[0], 1e3 * cut.tip[1]];
    let chart = Chart::new(
        "mill-map",
        "Where the part will be wrong",
        "Deviation normal to the feed at the tip, seen along z of the workpiece.",
    );
    let top = cuts.iter().map(size).fold(0.0, f64::max);
    chart
        .with(classes(&cuts, place, size, top, "mm off"))
        .synthetic(result.planned.job.synthetic)
}

/// The surface that is left, in classes of depth below the top.
pub fn left(result: &Result) -> Chart {
    let all = result.left.stock().relief(2);
    let depth = |place: &([f64; 3], f64)| 1e3 * place.1;
    let places = thinned(&all, PLACES, depth);
    let at = |place: &([f64; 3], f64)| [1e3 * place.0[0], 1e3 * place.0[1]];
    let top = places.iter().map(depth).fold(0.0, f64::max);
    Chart::new(
        "mill-left",
        "The surface left behind",
        "Depth of the surface below the top of the stock, seen along z of the workpiece.",
    )
    .with(classes(&places, at, depth, top, "mm deep"))
    .synthetic(result.planned.job.synthetic)
}
