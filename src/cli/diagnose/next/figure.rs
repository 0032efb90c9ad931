//! The poses of a plan, from the side and from above.

use crate::findings::next_setups::{Plan, Skeleton};
use crate::ground::spatial::V3;
use crate::measurement::workspace_test::DIRECTIONS;
use crate::robot::Robot;
use crate::sheet::chart::{Axis, Chart, Panel, Series};

/// More poses would cover each other.
const SHOWN: usize = 5;
/// Length of the line that shows the load, m.
const LOAD: f64 = 0.5;
/// Lifts the pen between two lines of one series.
const GAP: [f64; 2] = [f64::NAN, f64::NAN];

/// The figure.
pub fn poses(robot: &Robot, plan: &Plan, synthetic: bool) -> Chart {
    let shown = plan.chosen.len().min(SHOWN);
    let which = match plan.chosen.len() {
        n if n > SHOWN => format!("The first {SHOWN} of {n} set-ups"),
        _ => "The set-ups".into(),
    };
    let caption = format!(
        "{which} as lines from the foot over the joints to where the force acts, with their rank there: from \
         the side above, from above below. Dashed: direction of the load. Large markers: place of the sensor."
    );
    let poses: Vec<(String, Skeleton, usize)> = (0..shown)
        .map(|i| {
            let setting = &plan.chosen[i].setting;
            let (load, seat) = (DIRECTIONS[setting.direction], setting.seat.name());
            let name = format!("{}: load {load}, sensor {seat}", i + 1);
            (name, Skeleton::of(robot, setting), setting.direction)
        })
        .collect();
    Chart::new("next-setups", "Poses to measure next", caption)
        .with(view(&poses, [0, 2], "Seen from the side, against y"))
        .with(view(&poses, [0, 1], "Seen from above"))
        .synthetic(synthetic)
}

fn view(poses: &[(String, Skeleton, usize)], [h, v]: [usize; 2], note: &str) -> Panel {
    let seen = |p: &V3| [p[h], p[v]];
    let axis = |k: usize| Axis::new(DIRECTIONS[k], "m");
    let mut panel = Panel::new(axis(h), axis(v)).noted(note).equal_axes();
    for (name, skeleton, _) in poses {
        let line = skeleton.line.iter().map(seen).collect();
        panel = panel.with(Series::line(name, line).emphasised());
    }
    for (rank, (_, skeleton, _)) in poses.iter().enumerate() {
        panel = panel.named(seen(&skeleton.tip()), (rank + 1).to_string());
    }
    let joints = poses.iter().flat_map(|(_, skeleton, _)| &skeleton.line);
    let loads = poses.iter().flat_map(|(_, skeleton, direction)| {
        let mut end = skeleton.tip();
        end[*direction] += LOAD;
        [seen(&skeleton.tip()), seen(&end), GAP]
    });
    let sensors = poses.iter().map(|(_, skeleton, _)| seen(&skeleton.sensor));
    panel
        .with(Series::points("joints", joints.map(seen).collect()))
        .with(Series::dashed("direction of the load", loads.collect()))
        .with(Series::points("sensor", sensors.collect()).emphasised())
}
