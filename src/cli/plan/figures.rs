//! The figures of `ident plan`.

use super::Planned;
use crate::ground::spatial::{V3, add, rotate, scale};
use crate::ground::units::DEGREE;
use crate::path::build::{Part, Piece};
use crate::planning::exceeded::JointUse;
use crate::planning::plan::Row;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::scene::{Scene, Strand};

/// Rows drawn at most.
const ROWS: usize = 6000;
/// Pieces drawn one by one at most; longer paths are drawn through every n-th.
const PIECES: usize = 3000;
/// Points drawn along a curved piece.
const ALONG: usize = 24;
/// Tool axes drawn.
const AXES: usize = 60;

/// What the kinds of pieces are called.
const KINDS: [&str; 4] = ["lines", "arcs and curves", "blends", "rapid motions"];

/// The path seen from the front, the right and above, with lines and blends told apart.
pub fn path(planned: &Planned) -> Chart {
    let flat = |points: &Vec<V3>| points.iter().map(|p| seen(*p)).collect::<Vec<_>>();
    let panel = Panel::new(Axis::new("To the right", "mm"), Axis::new("Up", "mm")).equal_axes();
    let marks = [Series::line, Series::line, Series::line, Series::dashed];
    let kinds = kinds(planned);
    let all = KINDS.into_iter().zip(&kinds).zip(marks);
    let panel = all
        .filter(|((_, points), _)| !points.is_empty())
        .fold(panel, |panel, ((name, points), mark)| {
            panel.with(mark(name, flat(points)))
        });
    let panel = panel.with(Series::dotted("tool axes", flat(&axes(planned))));
    chart(
        planned,
        "path",
        "The path",
        "Seen from the front, the right and above: x to the lower right, y to the upper right, z up.",
    )
    .with(panel)
}

/// The same in space.
pub fn scene(planned: &Planned) -> Scene {
    let strand = |name: &str, points: Vec<V3>, thin: bool| Strand {
        name: name.into(),
        points: points.into_iter().map(|p| p.map(|x| x * 1e3)).collect(),
        thin,
        ..Strand::default()
    };
    let kinds = KINDS.into_iter().zip(kinds(planned));
    let mut strands: Vec<Strand> = kinds
        .map(|(name, points)| strand(name, points, false))
        .collect();
    strands.push(strand("tool axes", axes(planned), true));
    Scene {
        title: "The path in space".into(),
        unit: "mm".into(),
        strands,
    }
}

/// The pieces of every kind as lines in the workpiece frame, m.
fn kinds(planned: &Planned) -> [Vec<V3>; 4] {
    let plan = &planned.plan;
    let mut kinds = [const { Vec::new() }; 4];
    let stride = plan.path.pieces.len().div_ceil(PIECES).max(1);
    for piece in plan.path.pieces.iter().step_by(stride) {
        let kind = &mut kinds[kind(planned, piece)];
        kind.extend(drawn(planned, piece));
        kind.push([f64::NAN; 3]);
    }
    kinds
}

fn chart(planned: &Planned, name: &str, title: &str, caption: &str) -> Chart {
    Chart::new(name, title, caption).synthetic(planned.toolpath.synthetic || planned.job.synthetic)
}

fn kind(planned: &Planned, piece: &Piece) -> usize {
    let elements = &planned.plan.path.programme.elements;
    match piece.part {
        Part::Element(k, _) if elements[k].rapid => 3,
        Part::Element(k, _) if elements[k].curve.is_line() => 0,
        Part::Element(..) => 1,
        Part::Blend(..) => 2,
    }
}

fn drawn(planned: &Planned, piece: &Piece) -> Vec<V3> {
    let elements = &planned.plan.path.programme.elements;
    let straight = matches!(piece.part, Part::Element(k, _) if elements[k].curve.is_line());
    let count = if straight { 1 } else { ALONG };
    let at = |i: usize| piece.begin + piece.length * i as f64 / count as f64;
    (0..=count).map(|i| piece.point(at(i), elements)).collect()
}

/// Parallel projection, mm.
fn seen(p: V3) -> [f64; 2] {
    let [x, y, z] = p.map(|x| x * 1e3);
    let (wide, flat) = (0.75_f64.sqrt(), 0.35);
    [wide * (x + y), z + flat * (y - x)]
}

/// Needles along the spindle, m.
fn axes(planned: &Planned) -> Vec<V3> {
    let plan = &planned.plan;
    let stride = plan.rows.len().div_ceil(AXES).max(1);
    let long = (0.06 * extent(&plan.rows)).max(0.005);
    let needle = |row: &Row| {
        let axis = rotate(&row.orientation.matrix(), plan.cell.spindle);
        let tip = add(row.point, scale(long, axis));
        [row.point, tip, [f64::NAN; 3]]
    };
    plan.rows.iter().step_by(stride).flat_map(needle).collect()
}

/// Largest side of the box around the path, m.
fn extent(rows: &[Row]) -> f64 {
    let side = |i: usize| {
        let along = || rows.iter().map(move |row| row.point[i]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(side).fold(0.0, f64::max)
}

/// Feed and its components over time (source 000, figure 4.8).
pub fn feed(planned: &Planned) -> Chart {
    let plan = &planned.plan;
    let stride = plan.rows.len().div_ceil(ROWS).max(1);
    let pairs: Vec<&[Row]> = plan.rows.windows(2).step_by(stride).collect();
    let whole = pairs.iter().map(|pair| [pair[0].t, pair[0].feed * 1e3]);
    let component = |i: usize| {
        let speed = move |pair: &&[Row]| {
            let gone = pair[1].point[i] - pair[0].point[i];
            [pair[0].t, gone / plan.cycle * 1e3]
        };
        pairs.iter().map(speed).collect::<Vec<_>>()
    };
    let time = || Axis::new("Time", "s");
    let feed =
        Panel::new(time(), Axis::new("Feed", "mm/s")).with(Series::line("feed", whole.collect()));
    let speeds = Panel::new(time(), Axis::new("Components", "mm/s"))
        .with(Series::line("x", component(0)))
        .with(Series::line("y", component(1)))
        .with(Series::line("z", component(2)));
    chart(
        planned,
        "feed",
        "Feed over time",
        "The feed along the path, and its components along the axes of the workpiece.",
    )
    .with(feed)
    .with(speeds)
}

/// How much of its range and speed every joint uses.
pub fn joints(planned: &Planned) -> Chart {
    let joints = &planned.plan.joints;
    let sites: Vec<String> = joints.iter().map(|joint| joint.site.clone()).collect();
    let speed =
        |joint: &JointUse| 100.0 * joint.max_speed / joint.speed_limit.unwrap_or(f64::INFINITY);
    let range = |joint: &JointUse| {
        let [low, high] = joint.limits;
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let far = joint.range.map(|q| (q - middle).abs());
        100.0 * far[0].max(far[1]) / half
    };
    let bars = |of: &dyn Fn(&JointUse) -> f64| joints.iter().map(of).collect::<Vec<f64>>();
    let panel = Panel::new(Axis::new("Joint", ""), Axis::new("Used", "%"))
        .over(sites)
        .with(Series::bars("range from its middle", &bars(&range)))
        .with(Series::bars("speed", &bars(&speed)));
    chart(
        planned,
        "joints",
        "Use of the joints",
        "Farthest from the middle of the range, and fastest, in percent of the limit.",
    )
    .with(panel)
}

/// Joint angles over time.
pub fn angles(planned: &Planned) -> Chart {
    let plan = &planned.plan;
    let stride = plan.rows.len().div_ceil(ROWS / 2).max(1);
    let series = |(i, joint): (usize, &JointUse)| {
        let rows = plan.rows.iter().step_by(stride);
        let points = rows.map(|row| [row.t, row.q[i] / DEGREE]).collect();
        Series::line(joint.site.clone(), points)
    };
    let panel = Panel::new(Axis::new("Time", "s"), Axis::new("Angle", "deg"));
    let panel = plan
        .joints
        .iter()
        .enumerate()
        .map(series)
        .fold(panel, Panel::with);
    chart(
        planned,
        "angles",
        "Joint angles",
        "Over time, without jumps of 360 degrees.",
    )
    .with(panel)
}
