//! The axis in motion: figure, table and JSON.

use super::Judged;
use crate::fit::screw::in_motion::Run;
use crate::motion::servo::BANDWIDTH;
use crate::report::json::number;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::{ABSENT, fixed, significant};
use crate::sheet::table::Table;
use serde_json::{Value, json};

/// m/s in m/min.
const MINUTE: f64 = 60.0;

/// What each correction does to speed and position.
pub fn table(judged: &Judged) -> Table {
    let demand = &judged.demand;
    let header = [
        "correction",
        "speed m/min",
        "speed holds",
        "position error µm",
        "position holds",
    ];
    let title = format!(
        "The axis in motion at {} m/min",
        significant(demand.speed * MINUTE, 3)
    );
    let mut table = Table::new(title, header).numeric([1, 3]);
    let yes = |holds: Option<bool>| match holds {
        None => ABSENT.to_string(),
        Some(true) => "yes".into(),
        Some(false) => "no".into(),
    };
    let range = |ends: Option<[f64; 2]>, factor: f64, decimals: usize| {
        ends.map_or(ABSENT.into(), |[low, high]| {
            let end = |x: f64| fixed(x * factor, decimals);
            format!("{} to {}", end(low), end(high))
        })
    };
    for run in &judged.motion {
        table.push([
            run.name.to_string(),
            range(run.speed, MINUTE, 2),
            yes(run.holds_speed(demand)),
            range(run.error, 1e6, 1),
            yes(run.holds_position(demand)),
        ]);
    }
    table.noted(format!(
        "simulated, not measured: motor under a PID loop of {BANDWIDTH} Hz sampled every 62.5 µs, screw as measured here; asked: {} ± {} m/min, ± {} µm, where the speed should be constant, both ways",
        significant(demand.speed * MINUTE, 3),
        significant(demand.speed_tolerance * MINUTE, 3),
        significant(demand.position_tolerance * 1e6, 3)
    ))
}

/// Speed with a point table and with quadratics, and the error of the position, over the stroke.
pub fn chart(judged: &Judged) -> Chart {
    let demand = &judged.demand;
    let mut chart = Chart::new(
        format!("{}-motion", judged.stem()),
        "The axis in motion, forward",
        "Simulated speed of the slide while a card of high gain corrects the measured screw by its point table and by quadratics, and the position it reaches; bands are what the work allows. A correction that jumps is amplified by the loop.",
    );
    let limits = [1.0, -1.0].map(|sign| demand.speed + sign * demand.speed_tolerance);
    for key in ["points", "quadratics"] {
        if let Some(run) = judged.motion.iter().find(|run| run.key == key) {
            let speed = run
                .course
                .iter()
                .map(|[fast, _]| [fast.command * 1e3, fast.speed * MINUTE])
                .collect::<Vec<_>>();
            let ends = ends(&speed);
            let band: Vec<[f64; 3]> = ends
                .map(|x| [x, limits[1] * MINUTE, limits[0] * MINUTE])
                .to_vec();
            chart = chart.with(
                Panel::new(Axis::new("Position", "mm"), Axis::new("Speed", "m/min"))
                    .with(Series::band("allowed", &band))
                    .with(Series::line(run.name, speed)),
            );
        }
    }
    let mut panel = Panel::new(
        Axis::new("Position", "mm"),
        Axis::new("Position error", "µm"),
    );
    let allowed = demand.position_tolerance * 1e6;
    let drawn = ["none", "points", "quadratics"];
    for run in judged.motion.iter().filter(|run| drawn.contains(&run.key)) {
        let error = run
            .course
            .iter()
            .map(|[_, far]| [far.command * 1e3, far.error * 1e6])
            .collect::<Vec<_>>();
        if panel.series.is_empty() {
            let band: Vec<[f64; 3]> = ends(&error).map(|x| [x, -allowed, allowed]).to_vec();
            panel = panel.with(Series::band("allowed", &band));
        }
        panel = panel.with(Series::line(run.name, error));
    }
    chart.with(panel).synthetic(judged.table.synthetic)
}

fn ends(points: &[[f64; 2]]) -> [f64; 2] {
    let end = |p: Option<&[f64; 2]>| p.map_or(0.0, |p| p[0]);
    [end(points.first()), end(points.last())]
}

/// The JSON.
pub fn json(judged: &Judged) -> Value {
    let demand = &judged.demand;
    let run = |run: &Run| {
        json!({
            "correction": run.key,
            "speed_m_min": run.speed.map(|ends| ends.map(|v| number(v * MINUTE))),
            "speed_holds": run.holds_speed(demand),
            "position_error_um": run.error.map(|ends| ends.map(|e| number(e * 1e6))),
            "position_holds": run.holds_position(demand),
        })
    };
    json!({
        "simulated": true,
        "speed_m_min": number(demand.speed * MINUTE),
        "speed_tolerance_m_min": number(demand.speed_tolerance * MINUTE),
        "position_tolerance_um": number(demand.position_tolerance * 1e6),
        "runs": judged.motion.iter().map(run).collect::<Value>(),
    })
}
