//! The figures of a diagnosed workspace test.

use super::workspace::Workspace;
use crate::fit::force_steps::Setup;
use crate::fit::parameter::Z95;
use crate::ground::spatial::M3;
use crate::measurement::workspace_test::DIRECTIONS;
use crate::sheet::chart::{Axis, Chart, Panel, Series};

/// Stiffness along the force, and every component of the displacement.
pub fn before_and_after(result: &Workspace) -> Vec<Chart> {
    vec![stiffness(result), components(result)]
}

/// What no named cause explains, beside the scatter of a set-up.
pub fn remaining(result: &Workspace) -> Chart {
    let chart = Chart::new(
        format!("{}-remaining", result.test.stem()),
        "What no named cause explains",
        "Measured less predicted displacement per force with the causes in the model. The band is the 95 % interval of a set-up: noise of the readings, repeatability, and what no model is better than.",
    );
    let panel = |k: usize| {
        let own = read(result, k);
        let left = own
            .iter()
            .map(|(i, s)| [*i, error(s, &result.found.explained, k)]);
        let mut edges: Vec<[f64; 3]> = Vec::new();
        for (i, setup) in &own {
            let last = edges.last().map_or(*i, |edge| edge[0]);
            // a band does not span the gap between two directions
            edges.extend((i - last > 1.5).then_some([last + 1.0, f64::NAN, f64::NAN]));
            edges.push(band(result, setup, *i, k));
        }
        part(result, &own, k)
            .with(Series::band("95 % of a set-up", &edges))
            .with(Series::points("left with the causes", left.collect()))
    };
    drawn(result, chart, panel)
}

/// Whether a cause or a group of them changes what is simulated.
fn is_explained(result: &Workspace) -> bool {
    !result.found.causes.is_empty() || !result.found.groups.is_empty()
}

fn stiffness(result: &Workspace) -> Chart {
    let about = "Force over displacement along the same direction, with the 95 % interval of the measurement.";
    let (title, caption) = match is_explained(result) {
        true => (
            "Stiffness at the points: measured, simulated, and with the causes in the model",
            format!(
                "{about} The third bar is predicted: the causes were fitted to the other points alone."
            ),
        ),
        false => (
            "Stiffness at the points: measured and simulated",
            about.into(),
        ),
    };
    let chart = Chart::new(format!("{}-diagnosis", result.test.stem()), title, caption);
    let panel = |d: usize| {
        let own = result.along(d);
        let bars = |slopes: &[M3]| -> Vec<f64> {
            own.iter().map(|s| 1e-3 / slopes[s.point][d][d]).collect()
        };
        let slope = |s: &&Setup| s.lines[d].map_or(f64::NAN, |l| l.slope);
        let measured: Vec<f64> = own.iter().map(|s| 1e-3 / slope(s)).collect();
        let ends = |s: &&Setup| {
            let half = Z95 * deviation(result, s, d);
            [1e-3 / (slope(s) + half), 1e-3 / (slope(s) - half)]
        };
        let y = Axis::new(format!("Stiffness in {}", DIRECTIONS[d]), "N/mm");
        let panel = Panel::new(Axis::new("Point", ""), y)
            .over(own.iter().map(|s| format!("P{}", s.point + 1)))
            .with(Series::bars("measured", &measured).between(own.iter().map(ends).collect()))
            .with(Series::bars(
                "present simulation",
                &bars(&result.found.simulated),
            ));
        match is_explained(result) {
            true => panel.with(Series::bars("with the causes", &bars(&result.found.unseen))),
            false => panel,
        }
    };
    let panels = (0..3).filter(|d| !result.along(*d).is_empty()).map(panel);
    let synthetic = result.test.facts.synthetic;
    panels.fold(chart, Chart::with).synthetic(synthetic)
}

fn components(result: &Workspace) -> Chart {
    let chart = Chart::new(
        format!("{}-components", result.test.stem()),
        "Error of the simulated displacement, component by component",
        "Measured less simulated displacement per force, over the points, under force in x, in y and in z. What a cause explains it explains in all components at once.",
    );
    let panel = |k: usize| {
        let own = read(result, k);
        let points = |slopes: &[M3]| -> Vec<[f64; 2]> {
            own.iter().map(|(i, s)| [*i, error(s, slopes, k)]).collect()
        };
        let present = points(&result.found.simulated);
        let panel = part(result, &own, k).with(Series::points("present simulation", present));
        let with = points(&result.found.explained);
        match is_explained(result) {
            true => panel.with(Series::points("with the causes", with).emphasised()),
            false => panel,
        }
    };
    drawn(result, chart, panel)
}

/// The set-ups of which a component was read, each with its place along the axis: points side by
/// side, the directions of the force one after the other.
fn read(result: &Workspace, k: usize) -> Vec<(f64, &Setup)> {
    let points = result.test.facts.joint_angles.len() as f64;
    let setups = result.found.shapes.setups.iter();
    let place = |s: &Setup| s.direction as f64 * (points + 1.0) + s.point as f64;
    let mut own: Vec<(f64, &Setup)> = setups
        .filter(|s| s.lines[k].is_some())
        .map(|s| (place(s), s))
        .collect();
    own.sort_by(|a, b| a.0.total_cmp(&b.0));
    own
}

fn part(result: &Workspace, own: &[(f64, &Setup)], k: usize) -> Panel {
    let points = result.test.facts.joint_angles.len();
    let directions: Vec<&str> = (0..3)
        .filter(|d| own.iter().any(|(_, s)| s.direction == *d))
        .map(|d| DIRECTIONS[d])
        .collect();
    let last = own.iter().fold(0, |m, (_, s)| s.direction.max(m));
    let name = |i: usize| match i % (points + 1) {
        gap if gap == points => String::new(),
        point => format!("{}", point + 1),
    };
    let count = (last + 1) * (points + 1) - 1;
    let x = format!("Point, under force in {}", directions.join(", then in "));
    let y = format!("Error in {}", DIRECTIONS[k]);
    Panel::new(Axis::new(x, ""), Axis::new(y, "µm/kN")).over((0..count).map(name))
}

fn drawn(result: &Workspace, chart: Chart, panel: impl Fn(usize) -> Panel) -> Chart {
    let some = (0..3).filter(|k| !read(result, *k).is_empty());
    let synthetic = result.test.facts.synthetic;
    some.map(panel)
        .fold(chart, Chart::with)
        .synthetic(synthetic)
}

/// Measured less predicted, µm/kN.
fn error(setup: &Setup, slopes: &[M3], k: usize) -> f64 {
    let own = slopes[setup.point][setup.direction][k];
    setup.lines[k].map_or(f64::NAN, |line| 1e9 * (line.slope - own))
}

fn deviation(result: &Workspace, setup: &Setup, k: usize) -> f64 {
    let setups = &result.found.shapes.setups;
    let same = |s: &&Setup| s.point == setup.point && s.direction == setup.direction;
    let own = setups
        .iter()
        .filter(|s| s.lines.iter().any(Option::is_some));
    let at = own.clone().position(|s| same(&s));
    at.map_or(f64::NAN, |i| result.found.deviation[i][k])
}

fn band(result: &Workspace, setup: &Setup, at: f64, k: usize) -> [f64; 3] {
    let half = 1e9 * Z95 * deviation(result, setup, k);
    [at, -half, half]
}
