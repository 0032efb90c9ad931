//! The figures of `ident mill`.

use super::Result;
use crate::ground::spatial::norm;
use crate::process::run::Cut;
use crate::process::setup::Support;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::significant;

/// Most points of one line.
const POINTS: usize = 2000;
/// Most points of a map.
const PLACES: usize = 6000;

/// Force and deviation over the path.
pub fn course(result: &Result) -> Chart {
    let cuts = thinned(&result.milled.course, POINTS);
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

/// Every n-th.
fn thinned<T: Copy>(all: &[T], most: usize) -> Vec<T> {
    all.iter()
        .step_by(all.len().div_ceil(most).max(1))
        .copied()
        .collect()
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
    let cuts = thinned(&cutting, PLACES);
    let size = |cut: &Cut| 1e3 * norm(cut.normal());
    let place = |cut: &Cut| [1e3 * cut.tip[0], 1e3 * cut.tip[1]];
    let chart = Chart::new(
        "mill-map",
        "Where the part will be wrong",
        "Deviation normal to the feed at the tip, seen along z of the workpiece.",
    );
    chart
        .with(classes(&cuts, place, size, "mm off"))
        .synthetic(result.planned.job.synthetic)
}

/// The surface that is left, in classes of depth below the top.
pub fn left(result: &Result) -> Chart {
    let all = result.left.stock().relief(2);
    let places = thinned(&all, PLACES);
    let depth = |place: &([f64; 3], f64)| 1e3 * place.1;
    let at = |place: &([f64; 3], f64)| [1e3 * place.0[0], 1e3 * place.0[1]];
    Chart::new(
        "mill-left",
        "The surface left behind",
        "Depth of the surface below the top of the stock, seen along z of the workpiece.",
    )
    .with(classes(&places, at, depth, "mm deep"))
    .synthetic(result.planned.job.synthetic)
}

/// Number of classes of a map.
const CLASSES: usize = 5;

/// Points on a map, sorted into classes of equal width.
fn classes<T>(
    all: &[T],
    place: impl Fn(&T) -> [f64; 2],
    size: impl Fn(&T) -> f64,
    unit: &str,
) -> Panel {
    let panel = Panel::new(Axis::new("x", "mm"), Axis::new("y", "mm")).equal_axes();
    let top = all.iter().map(&size).fold(0.0, f64::max);
    if top <= 0.0 {
        return panel.with(Series::points(
            format!("0 {unit}"),
            all.iter().map(place).collect(),
        ));
    }
    let class = |x: f64| ((x / top * CLASSES as f64) as usize).min(CLASSES - 1);
    let end = |i: usize| significant(top * i as f64 / CLASSES as f64, 2);
    (0..CLASSES).fold(panel, |panel, i| {
        let inside = all
            .iter()
            .filter(|t| class(size(t)) == i)
            .map(&place)
            .collect::<Vec<_>>();
        let name = format!("{} to {} {unit}", end(i), end(i + 1));
        if inside.is_empty() {
            panel
        } else {
            panel.with(Series::points(name, inside))
        }
    })
}
