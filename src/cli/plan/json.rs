//! The JSON of `ident plan`.

use super::{Planned, Written};
use crate::ground::units::DEGREE;
use crate::path::corner::Passage;
use crate::planning::exceeded::{Exceeded, JointUse};
use crate::planning::{Plan, Unreached};
use crate::report::json::number;
use serde_json::{Value, json};
use std::path::PathBuf;

/// The body.
pub fn body(planned: &Planned, written: &Written) -> Value {
    let plan = &planned.plan;
    let passages = plan.passages.iter();
    let passed = passages
        .map(|[t, s]| json!({"site": "wrist", "at_s": number(*t), "line": plan.path.line(*s)}));
    json!({
        "path": path(planned),
        "feed": {
            "asked_m_s": number(plan.feed.asked),
            "held_share": number(plan.feed.held_share),
            "min_m_s": number(plan.feed.min),
            "acceleration_share": number(plan.feed.eased),
        },
        "joints": plan.joints.iter().map(joint).collect::<Value>(),
        "exceeded": plan.exceeded.iter().map(exceeded).collect::<Value>(),
        "spin": plan.compliance.map(|[carried, chosen]| json!({
            "mean_normal_compliance_m_N": number(chosen),
            "fixed_mean_normal_compliance_m_N": number(carried),
        })),
        "singularities_passed": passed.collect::<Value>(),
        "trajectory": named(&written.trajectory),
        "program": named(&written.program),
        "report": named(&written.report),
    })
}

/// The body where a place is out of reach: nothing is planned.
pub fn unreached(unreached: &Unreached) -> Value {
    json!({
        "exceeded": [exceeded(&unreached.exceeded())],
        "unreached": {
            "line": unreached.line,
            "point_mm": unreached.point.map(|x| number(x * 1e3)),
        },
        "trajectory": null,
        "program": null,
    })
}

fn named(path: &Option<PathBuf>) -> Value {
    path.as_ref()
        .map_or(Value::Null, |path| json!(path.display().to_string()))
}

fn path(planned: &Planned) -> Value {
    let (plan, path) = (&planned.plan, &planned.plan.path);
    let passed_over = planned.toolpath.passed_over.iter();
    let passed_over =
        passed_over.map(|p| json!({"what": p.what, "count": p.count, "line": p.line}));
    json!({
        "points": path.programme.points,
        "lines": path.lines(),
        "blends": path.blends(),
        "length_m": number(path.length),
        "duration_s": number(plan.timeline.duration),
        "samples": plan.rows.len(),
        "max_corner_deviation_mm": number(path.max_deviation() * 1e3),
        "arcs_and_curves": path.programme.elements.len() - path.lines(),
        "stops": stops(plan),
        "shrunk_blends": path.corners.iter().filter(|c| c.is_shrunk()).count(),
        "repeated_points": path.programme.duplicates,
        "tangential_joints": tangential(plan),
        "passed_over": passed_over.collect::<Value>(),
    })
}

/// Halts between start and end.
pub fn stops(plan: &Plan) -> usize {
    plan.path.halts.len().saturating_sub(2)
}

/// Joints of an arc or a curve that nothing is blended at.
pub fn tangential(plan: &Plan) -> usize {
    let elements = &plan.path.programme.elements;
    let corners = plan.path.corners.iter().zip(elements.windows(2));
    corners
        .filter(|(corner, pair)| {
            let straight = pair[0].curve.is_line() && pair[1].curve.is_line();
            corner.passage == Passage::Through && !straight
        })
        .count()
}

fn joint(joint: &JointUse) -> Value {
    let [low, high] = joint.range.map(|q| q / DEGREE);
    let share = joint
        .speed_limit
        .map(|limit| 100.0 * joint.max_speed / limit);
    json!({
        "site": joint.site,
        "min_deg": number(low),
        "max_deg": number(high),
        "max_speed_deg_s": number(joint.max_speed / DEGREE),
        "limit_deg_s": joint.speed_limit.map(|limit| number(limit / DEGREE)),
        "use_percent": share.map(number),
        "max_acceleration_deg_s2": number(joint.max_acceleration / DEGREE),
        "limit_deg_s2": joint.acceleration_limit.map(|limit| number(limit / DEGREE)),
        "limits_deg": joint.limits.map(|limit| number(limit / DEGREE)),
    })
}

fn exceeded(exceeded: &Exceeded) -> Value {
    json!({
        "what": exceeded.what,
        "site": exceeded.site,
        "at_s": number(exceeded.at),
        "value": number(exceeded.value),
        "limit": number(exceeded.limit),
        "line": exceeded.line,
    })
}
