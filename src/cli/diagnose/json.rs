//! The JSON of an answer.

use crate::findings::Answer;
use crate::findings::gain::Gain;
use crate::findings::sentence::sentence;
use crate::fit::suitability::Doubt;
use serde_json::{Map, Value, json};
use std::path::Path;

/// The body of `formats.md`; `model`: where the extended model was written.
pub fn body(found: &Answer, synthetic: bool, model: Option<&Path>) -> Map<String, Value> {
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| map.insert(key.into(), value);
    put("synthetic", json!(synthetic));
    put("verdict", json!(found.verdict.name()));
    put("sentence", json!(sentence(found)));
    put(
        "discrepancy",
        json!({
            "rms": found.discrepancy.rms,
            "noise_rms": found.discrepancy.noise_rms,
            "unit": found.unit,
            "where": found.discrepancy.place,
            "noise": found.noise,
        }),
    );
    put("causes", causes_json(found));
    put("cannot_separate", groups_json(found));
    put(
        "unexplained",
        json!({
            "share_of_variance": found.unexplained.share_of_variance,
            "shape": found.unexplained.shape,
            "shape_over_time": found.unexplained.over_time,
            "p_value": found.p_value,
            "description": found.unexplained.description,
        }),
    );
    let candidates = found
        .candidates
        .iter()
        .map(|(c, p, n)| json!({"effects": c, "probability": p, "nats": n}));
    put("candidates", Value::Array(candidates.collect()));
    put("doubts", doubts_json(&found.doubts));
    put("model", json!(model.map(|path| path.display().to_string())));
    map
}

/// What is odd about the data.
pub fn doubts_json(doubts: &[Doubt]) -> Value {
    let one = |doubt: &Doubt| {
        json!({
            "rule": doubt.rule, "weight": doubt.weight.name(),
            "what": doubt.what, "remedy": doubt.remedy,
        })
    };
    Value::Array(doubts.iter().map(one).collect())
}

fn gain_json(gain: &Gain) -> Value {
    json!({
        "held_out_rms_before": gain.before,
        "held_out_rms_after": gain.after,
        "reduction_percent": gain.reduction_percent,
        "ci95_percent": gain.ci95_percent,
    })
}

fn causes_json(answer: &Answer) -> Value {
    let causes = answer.causes.iter().map(|cause| {
        let alternatives: Vec<Value> = cause
            .alternatives
            .iter()
            .map(|(effect, site, probability)| json!({"effect": effect, "site": site, "probability": probability}))
            .collect();
        let parameters: Vec<Value> = cause
            .parameters
            .iter()
            .map(|(name, value, unit)| json!({"name": name, "site": cause.site, "value": value, "unit": unit}))
            .collect();
        json!({
            "effect": cause.effect,
            "site": cause.site,
            "probability": cause.probability,
            "alternatives": alternatives,
            "parameters": parameters,
            "gain": gain_json(&cause.gain),
        })
    });
    Value::Array(causes.collect())
}

fn groups_json(answer: &Answer) -> Value {
    let groups = answer.groups.iter().map(|group| {
        json!({
            "effects": group.effects,
            "sites": group.sites,
            "would_tell": group.would_tell,
            "gain": gain_json(&group.gain),
        })
    });
    Value::Array(groups.collect())
}
