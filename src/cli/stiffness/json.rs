//! The JSON of `ident stiffness`.

use super::Result;
use super::tables::{finite, straight_difference};
use crate::fit::stiffness::Account;
use crate::measurement::load_cycle::Axis;
use crate::report::json;
use serde_json::{Value, json};
use std::path::Path;

/// The document.
pub fn as_json(results: &[Result]) -> String {
    let inputs: Vec<(&Path, &str)> = results
        .iter()
        .map(|r| (r.file.path.as_path(), r.file.sha256.as_str()))
        .collect();
    let mut map = json::head("stiffness", &inputs);
    map.insert(
        "results".into(),
        Value::Array(results.iter().map(result_json).collect()),
    );
    json::print(map)
}

fn result_json(result: &Result) -> Value {
    let account = &result.account;
    let axis = match result.file.facts.axis {
        Some(Axis::Tilt) => json!("tilt"),
        Some(Axis::Rotation) => json!("rotation"),
        None => Value::Null,
    };
    json!({
        "file": result.file.path.display().to_string(),
        "joint": result.file.facts.joint,
        "axis": axis,
        "synthetic": result.file.facts.synthetic,
        "effects": account.solution.model.effects().iter().map(|e| e.card().name).collect::<Vec<_>>(),
        "parameters": account.parameters,
        "straight_line": {
            "stiffness": finite(account.straight),
            "unit": result.file.port.stiffness_unit(),
            "differs_percent": straight_difference(account),
        },
        "measured_loss_per_cycle_J": account.losses,
        "imposed": if account.imposed { "displacement" } else { "load" },
        "branches": branches(account),
        "second_sensor_excess": account.second.map(|s| json!({"value": s.0, "stderr": s.1})),
        "fit": {
            "rms": account.solution.rms,
            "noise_rms": account.noise_rms,
            "noise": account.noise,
            "unit": if account.imposed { result.file.port.load_unit() } else { result.file.port.deflection_unit() },
            "rows": result.file.load.len(),
            "rows_left_out": result.file.left_out,
            "rows_replaced": account.data.wild.len(),
        },
        "warnings": account.warnings,
        "doubts": account.doubts,
    })
}

/// Points of each branch of a settled cycle in the JSON.
const BRANCH_POINTS: usize = 24;

/// Unloading and loading branch of one settled cycle at full load: [load, deflection].
fn branches(account: &Account) -> Value {
    let Some((load, deflection)) = &account.branches else {
        return Value::Null;
    };
    let middle = load.len() / 2;
    let branch = |from: usize, to: usize| {
        let step = ((to - from) / BRANCH_POINTS).max(1);
        (from..=to)
            .step_by(step)
            .map(|i| [load[i], deflection[i]])
            .collect::<Vec<_>>()
    };
    json!({"unloading": branch(0, middle), "loading": branch(middle, load.len() - 1)})
}
