//! A plan as JSON.

use crate::findings::next_setups::{Plan, SetupDocument};
use serde_json::{Value, json};
use std::path::Path;

/// The body of the document of `--next`; `report`: where the page was written.
pub fn body(plan: &Plan, report: Option<&Path>) -> Value {
    json!({
        "next": SetupDocument::of(plan),
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
