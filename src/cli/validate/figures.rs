//! The figures of `ident validate`, in the manner of the thesis (source 000, Figs. 3.5 and 3.6).

use super::Validated;
use crate::experiments::robot_picture::scene;
use crate::fit::validation::Comparison;
use crate::ground::spatial::V3;
use crate::measurement::workspace_test::DIRECTIONS;
use crate::motion::skeleton::{Skeleton, mean_shares, skeleton};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::scene::Scene;

/// Bars of measured, simulated and simulated stiffness without tilt, one panel per direction.
pub fn stiffness(validated: &Validated) -> Chart {
    let chart = Chart::new(
        "validate-stiffness",
        "Stiffness at the points: measured and simulated",
        "Force over displacement along the same direction, with the 95 % interval of the measurement. The distance between the second and the third bar is what the tilt axes do.",
    );
    let panels = (0..3).filter_map(|d| panel(validated, d));
    panels
        .fold(chart, Chart::with)
        .synthetic(validated.test.facts.synthetic)
}

fn panel(validated: &Validated, direction: usize) -> Option<Panel> {
    let own = validated
        .found
        .comparisons
        .iter()
        .filter(|c| c.setup.direction == direction);
    let own: Vec<&Comparison> = own.collect();
    if own.is_empty() {
        return None;
    }
    let value = |c: &&Comparison| 1e-3 * c.measured.value.unwrap_or(0.0);
    let ends = |c: &&Comparison| c.measured.ci95.unwrap_or([0.0; 2]).map(|k| 1e-3 * k);
    let of =
        |pick: fn(&Comparison) -> f64| own.iter().map(|c| 1e-3 * pick(c)).collect::<Vec<f64>>();
    let measured = Series::bars("measured", &own.iter().map(value).collect::<Vec<_>>());
    let y = Axis::new(format!("Stiffness in {}", DIRECTIONS[direction]), "N/mm");
    let panel = Panel::new(Axis::new("Point", ""), y)
        .over(own.iter().map(|c| format!("P{}", c.setup.point + 1)))
        .with(measured.between(own.iter().map(ends).collect()))
        .with(Series::bars("simulated", &of(|c| c.simulated)))
        .with(Series::bars(
            "simulated without tilt",
            &of(|c| c.without_tilt),
        ));
    Some(panel)
}

/// Error of every point in percent, with tilt and after re-identification.
pub fn errors(validated: &Validated) -> Chart {
    let found = &validated.found.comparisons;
    let bars = |pick: fn(&Comparison) -> f64| {
        let error = |c: &Comparison| c.error_percent(pick(c)).unwrap_or(0.0);
        found.iter().map(error).collect::<Vec<f64>>()
    };
    let mm = |pick: fn(&Comparison) -> f64| {
        let error = |c: &Comparison| 1e3 * c.error_m(pick(c)).unwrap_or(0.0);
        found.iter().map(error).collect::<Vec<f64>>()
    };
    let names = || found.iter().map(Comparison::name);
    let of = |y: Axis, bars: &dyn Fn(fn(&Comparison) -> f64) -> Vec<f64>| {
        Panel::new(Axis::new("Point and direction", ""), y)
            .over(names())
            .with(Series::bars("simulated", &bars(|c| c.simulated)))
            .with(Series::bars("re-identified", &bars(|c| c.refitted)))
    };
    Chart::new(
        "validate-errors",
        "Error of the simulation at every point",
        "Above: simulated over measured stiffness. Below: simulated less measured deflection under 750 N. What re-identification cannot remove is scatter of the set-ups, or bends in a way that the model does not have.",
    )
    .with(of(Axis::new("Stiffness error", "%"), &bars))
    .with(of(Axis::new("Deflection error at 750 N", "mm"), &mm))
    .synthetic(validated.test.facts.synthetic)
}

/// The points on the robot, from the side and from above.
pub fn map(validated: &Validated) -> Chart {
    let postures = validated.test.facts.joint_angles.iter();
    let lines: Vec<Vec<V3>> = postures
        .map(|q| skeleton(&validated.robot, q).line)
        .collect();
    let view = |name: &str, across: usize, up: usize| {
        let axis = |k: usize| Axis::new(DIRECTIONS[k], "m");
        let flat = |p: &V3| [p[across], p[up]];
        // a point that is not finite lifts the pen between two postures
        let apart = |line: &Vec<V3>| {
            line.iter()
                .map(flat)
                .chain([[f64::NAN; 2]])
                .collect::<Vec<_>>()
        };
        let links = Series::line("links", lines.iter().flat_map(apart).collect());
        let panel = Panel::new(axis(across), axis(up)).noted(name).with(links);
        let tips = lines.iter().filter_map(|line| line.last()).map(flat);
        panel.with(Series::points("points", tips.collect()).emphasised())
    };
    let place = |(i, line): (usize, &Vec<V3>)| {
        let [x, y, z] = line.last().copied().unwrap_or_default();
        format!("P{} ({x:.2}, {y:.2}, {z:.2})", i + 1)
    };
    let places: Vec<String> = lines.iter().enumerate().map(place).collect();
    Chart::new(
        "validate-map",
        "Points on the robot",
        format!(
            "Links from the base to the tool in every posture. Tool centre points in m: {}.",
            places.join(", ")
        ),
    )
    .with(view("from the side", 0, 2))
    .with(view("from above", 0, 1))
    .synthetic(validated.test.facts.synthetic)
}

/// The same in space: the first posture with the share that each joint has in the deflection there, the
/// mean over the directions, and the others thin.
pub fn space(validated: &Validated) -> Option<Scene> {
    let (first, others) = validated.test.facts.joint_angles.split_first()?;
    let robot = skeleton(&validated.robot, first);
    let others: Vec<Skeleton> = others
        .iter()
        .map(|q| skeleton(&validated.robot, q))
        .collect();
    let shares = mean_shares(&validated.robot, first);
    Some(scene(
        "The robot at point 1 and, thin, at the others",
        &robot,
        &shares,
        &others,
    ))
}
