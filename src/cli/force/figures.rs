//! The figures of `ident force`: wave forms measured and fitted, what is left, mean force over feed.

use super::Found;
use crate::cutting::wave::Side;
use crate::fit::cut_force::CutFit;
use crate::ground::spatial::V3;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use std::f64::consts::TAU;

const NAMES: [&str; 3] = ["Fx", "Fy", "Fz"];
/// Revolutions that are drawn.
const TURNS: f64 = 2.0;

/// Wave forms of one cut over the angle of tooth 1, measured and fitted, and what is left.
pub fn wave(found: &Found, number: usize) -> Chart {
    let cut = &found.account.cuts[number];
    let c = &cut.data.scene.cut;
    let caption = format!(
        "Force on the tool over the first revolutions. {:?}, {:.2} mm deep, {:.2} mm wide, {:.4} mm per tooth at {:.0} rev/min. Below: measured less fitted; what is left should look like noise.",
        c.side,
        1e3 * c.depth_m,
        1e3 * c.width_m,
        1e3 * c.feed_per_tooth(cut.data.scene.tool.teeth),
        c.spindle_rad_s * 60.0 / TAU,
    );
    let chart = Chart::new(
        format!("force-cut{}", number + 1),
        format!("Cut {}: measured and fitted", number + 1),
        caption,
    );
    let panels = (0..3).map(|k| panel(cut, k));
    let chart = panels.fold(chart, Chart::with);
    chart.with(rest(cut)).synthetic(found.synthetic())
}

fn turns() -> Axis {
    Axis::new("Revolutions of the spindle", "")
}

fn drawn(cut: &CutFit) -> impl Iterator<Item = (usize, f64)> + '_ {
    let rate = cut.data.scene.cut.spindle_rad_s / TAU;
    let time = cut.data.scene.time.iter().enumerate();
    time.map(move |(i, t)| (i, rate * t))
        .take_while(|(_, turn)| *turn <= TURNS)
}

fn panel(cut: &CutFit, k: usize) -> Panel {
    let measured = drawn(cut).map(|(i, t)| [t, cut.data.force[i][k]]).collect();
    let fitted = drawn(cut).map(|(i, t)| [t, cut.data.force[i][k] - cut.residual[i][k]]);
    Panel::new(turns(), Axis::new(NAMES[k], "N"))
        .with(Series::points("measured", measured))
        .with(Series::line("fitted", fitted.collect()))
}

fn rest(cut: &CutFit) -> Panel {
    let of = |k: usize| drawn(cut).map(|(i, t)| [t, cut.residual[i][k]]).collect();
    Panel::new(turns(), Axis::new("Left over", "N"))
        .with(Series::line("left in x", of(0)))
        .with(Series::dashed("left in y", of(1)))
        .with(Series::dotted("left in z", of(2)))
}

/// Mean force of a cut over its record: measured, fitted, N.
pub fn means(cut: &CutFit) -> (V3, V3) {
    let n = cut.data.force.len().max(1) as f64;
    let sum = |of: &[V3], k: usize| of.iter().map(|v| v[k]).sum::<f64>() / n;
    let measured: V3 = std::array::from_fn(|k| sum(&cut.data.force, k));
    let fitted = std::array::from_fn(|k| measured[k] - sum(&cut.residual, k));
    (measured, fitted)
}

/// Mean force per depth over the feed per tooth, by the side of the stock.
pub fn over_feed(found: &Found) -> Chart {
    let chart = Chart::new(
        "force-means",
        "Mean force over the feed per tooth",
        "Mean force per millimetre of depth, measured (markers) and fitted (lines) for each kind of cut. Where a line meets feed 0 the edge rubs without a chip.",
    );
    let panels = (0..3).map(|k| {
        let y = Axis::new(format!("mean {}", NAMES[k]), "N/mm");
        let panel = Panel::new(Axis::new("Feed per tooth", "mm"), y);
        let sides = [(Side::Slot, "slot"), (Side::Up, "up"), (Side::Down, "down")];
        sides.iter().fold(panel, |panel, (side, name)| {
            let (measured, fitted) = points(found, *side, k);
            match measured.is_empty() {
                true => panel,
                false => panel
                    .with(Series::line(format!("{name}, fitted"), fitted))
                    .with(Series::points(format!("{name}, measured"), measured)),
            }
        })
    });
    panels.fold(chart, Chart::with).synthetic(found.synthetic())
}

fn points(found: &Found, side: Side, k: usize) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let cuts = found.account.cuts.iter();
    let own = cuts.filter(|c| c.data.scene.cut.side == side);
    let mut rows: Vec<[f64; 3]> = own
        .map(|c| {
            let cut = &c.data.scene.cut;
            let feed = 1e3 * cut.feed_per_tooth(c.data.scene.tool.teeth);
            let (measured, fitted) = means(c);
            let depth = 1e3 * cut.depth_m;
            [feed, measured[k] / depth, fitted[k] / depth]
        })
        .collect();
    rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let of = |i: usize| rows.iter().map(|r| [r[0], r[i]]).collect();
    (of(1), of(2))
}
