//! A plan as JSON.

use crate::findings::next_setups::{Chosen, Plan, Tells};
use crate::ground::units::DEGREE;
use crate::measurement::workspace_test::DIRECTIONS;
use serde_json::{Value, json};
use std::path::Path;

/// The body of the document of `--next`; `report`: where the page was written.
pub fn body(plan: &Plan, report: Option<&Path>) -> Value {
    json!({
        "next": setups(plan),
        "gain_nats": plan.chosen.iter().map(|one| one.gain).sum::<f64>(),
        "compared": plan.compared,
        "noise": {
            "displacement_m_N": plan.noise.slope,
            "setup_repeatability": plan.noise.repeatability,
            "measured": plan.noise.measured,
        },
        "report": report.map(|path| path.display().to_string()),
    })
}

/// The set-ups, the most telling first.
pub fn setups(plan: &Plan) -> Vec<Value> {
    let numbered = plan.chosen.iter().enumerate();
    numbered.map(|(i, one)| setup(i + 1, one)).collect()
}

fn setup(rank: usize, one: &Chosen) -> Value {
    let degrees: Vec<f64> = one
        .setting
        .angles
        .iter()
        .map(|q| rounded(q / DEGREE))
        .collect();
    let tells = match &one.tells {
        Tells::Apart { sites, correlation } => json!({"sites": sites, "correlation": correlation}),
        Tells::Size { site, std } => json!({"sites": [site], "relative_std": std}),
    };
    json!({
        "rank": rank,
        "joint_angles_deg": degrees,
        "tool": one.setting.reach.word(),
        "direction": DIRECTIONS[one.setting.direction],
        "sensor": one.setting.seat.name(),
        "gain_nats": one.gain,
        "tells": tells,
    })
}

/// Four decimals, as controllers show.
fn rounded(degrees: f64) -> f64 {
    (degrees * 1e4).round() / 1e4
}
