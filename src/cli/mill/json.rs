//! The JSON of `ident mill`.

use super::{Driven, Result, Written, account};
use crate::compensation::corrected::Met;
use crate::ground::spatial::norm;
use crate::ground::stats::Z95;
use crate::report::json::{number, numbers};
use serde_json::{Value, json};
use std::path::PathBuf;

/// The body.
pub fn body(result: &Result, written: &Written) -> Value {
    let milled = &result.milled;
    json!({
        "robot_is": result.support.name(),
        "removed_mm3": number(milled.removed_m3 * 1e9),
        "duration_s": number(milled.duration_s),
        "cutting_s": number(milled.cutting_s),
        "peak_force_N": number(milled.peak_n),
        "mean_force_size_N": number(milled.mean_size_n),
        "mean_force_N": (milled.cutting_s > 0.0).then(|| numbers(&milled.mean_n)),
        "deviation_mm": deviation(result),
        "joints": result.driven.as_ref().map(driven),
        "steps": milled.steps,
        "step_us": number(milled.step_s * 1e6),
        "energy": energy(result),
        "interval_from": result.doubts.iter().map(|d| json!({
            "name": d.name, "site": d.site, "rel_ci95": number(Z95 * d.rel_std),
        })).collect::<Value>(),
        "tolerance_met": result.met().map(Met::word),
        "remarks": account::remarks(result),
        "course": named(&written.course),
        "report": named(&written.report),
    })
}

fn named(path: &Option<PathBuf>) -> Value {
    path.as_ref()
        .map_or(Value::Null, |path| json!(path.display().to_string()))
}

fn driven(driven: &Driven) -> Value {
    let [max, rms] = driven.recorded.off_path();
    json!({
        "file": driven.joints.path.display().to_string(),
        "rows": driven.joints.rows.len(),
        "left_out": driven.joints.left_out,
        "off_path_mm": {"max": number(1e3 * max), "rms": number(1e3 * rms)},
    })
}

fn deviation(result: &Result) -> Value {
    let milled = &result.milled;
    let at = |i: usize| &milled.course[i];
    let normal = milled.worst(|cut| norm(cut.normal()));
    let worst = result.worst.as_ref();
    json!({
        "max": worst.map(|w| number(w.size * 1e3)),
        "rms": number(milled.rms(|cut| norm(cut.deviation)) * 1e3),
        "max_normal": normal.map(|i| number(norm(at(i).normal()) * 1e3)),
        "rms_normal": number(milled.rms(|cut| norm(cut.normal())) * 1e3),
        "ci95_max": worst.and_then(|w| w.ci95).map(|ends| numbers(&ends.map(|x| x * 1e3))),
        "max_at_s_mm": worst.map(|w| number(at(w.station).s_m * 1e3)),
    })
}

fn energy(result: &Result) -> Value {
    result.milled.energy.map_or(Value::Null, |energy| {
        json!({
            "work_J": number(energy.work),
            "stored_J": number(energy.stored),
            "damped_J": number(energy.damped),
            "not_accounted_for": number(energy.gap()),
        })
    })
}
