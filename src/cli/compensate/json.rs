//! The JSON of `ident compensate`.

use super::Written;
use crate::compensation::corrected::Corrected;
use crate::compensation::remaining::Size;
use crate::ground::stats::Z95;
use crate::report::json::{number, numbers};
use serde_json::{Value, json};
use std::path::PathBuf;

/// The body.
pub fn body(result: &Corrected, written: &Written) -> Value {
    let found = &result.found;
    json!({
        "method": result.method.name,
        "iterations": found.iterations,
        "converged": found.converged,
        "last_change_mm": number(1e3 * found.last_change_m),
        "before": size(&result.before),
        "after": size(&result.after),
        "beside": result.beside.as_ref().map(|(name, left)| json!({
            "method": name, "after": size(&Size::of(left)),
        })),
        "after_ci95_max_mm": result.certainty.ci95.map(|ends| numbers(&ends.map(|x| 1e3 * x))),
        "reduction_percent": result.reduction_percent().map(number),
        "tolerance_mm": result.planned.job.limits.tolerance.map(|t| number(1e3 * t)),
        "tolerance_met": result.met.word(),
        "force_over_springs_alone": result.chatter.as_ref().map(|c| number(c.times)),
        "rapid_motions_slowed": result.slowed,
        "largest_correction_mm": number(1e3 * found.correction.largest().0),
        "interval_from": result.doubts.iter().map(|d| json!({
            "name": d.name, "site": d.site, "rel_ci95": number(Z95 * d.rel_std),
        })).collect::<Value>(),
        "limited_by": result.certainty.limits.iter().map(|l| json!({
            "name": l.doubt.name,
            "site": l.doubt.site,
            "change_mm": number(1e3 * l.change_m),
            "ci95_high_without_mm": number(1e3 * l.high_without_m),
        })).collect::<Value>(),
        "next": result.certainty.next.as_ref().map(|n| json!({
            "measure": n.what,
            "ci95_high_after_mm": number(1e3 * n.high_after_m),
        })),
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
        "program": named(&written.program),
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
