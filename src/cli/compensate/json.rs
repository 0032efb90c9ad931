//! The JSON of `ident compensate`.

use super::{Result, Written};
use crate::compensation::remaining::Size;
use crate::process::uncertainty::NORMAL95;
use crate::report::json::{number, numbers};
use serde_json::{Value, json};
use std::path::PathBuf;

/// The body.
pub fn body(result: &Result, written: &Written) -> Value {
    let found = &result.found;
    json!({
        "method": result.method.name,
        "iterations": found.iterations,
        "converged": found.converged,
        "last_change_mm": number(1e3 * found.last_change_m),
        "before": size(&result.before),
        "after": size(&result.after),
        "after_ci95_max_mm": result.ci95.map(|ends| numbers(&ends.map(|x| 1e3 * x))),
        "reduction_percent": result.reduction_percent().map(number),
        "tolerance_mm": result.planned.job.limits.tolerance.map(|t| number(1e3 * t)),
        "tolerance_met": result.met.word(),
        "largest_correction_mm": number(1e3 * found.correction.largest().0),
        "interval_from": result.doubts.iter().map(|d| json!({
            "name": d.name, "site": d.site, "rel_ci95": number(NORMAL95 * d.rel_std),
        })).collect::<Value>(),
        "checked": result.checked.iter().map(|c| json!({
            "what": c.what,
            "site": c.site,
            "s_mm": number(1e3 * c.s_m),
            "worst": number(c.worst),
            "limit": c.limit.map(number),
            "unit": c.unit,
            "ok": c.ok,
        })).collect::<Value>(),
        "path": named(&written.path),
        "program": Value::Null,
        "report": named(&written.report),
    })
}

fn size(size: &Size) -> Value {
    json!({
        "max_mm": number(1e3 * size.max_m),
        "rms_mm": number(1e3 * size.rms_m),
        "max_at_s_mm": number(1e3 * size.at_m),
    })
}

fn named(path: &Option<PathBuf>) -> Value {
    path.as_ref()
        .map_or(Value::Null, |path| json!(path.display().to_string()))
}
