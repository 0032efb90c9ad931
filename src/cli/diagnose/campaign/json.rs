//! A campaign as JSON.

use super::Campaign;
use crate::cli::diagnose::One;
use crate::cli::diagnose::next::setups;
use crate::findings::belief::Place;
use crate::findings::campaign::Check;
use crate::findings::joint::{Joint, Together};
use crate::ground::problem::Outcome;
use serde_json::{Map, Value, json};

/// The body of the JSON document.
pub fn body(campaign: &Campaign, dry: bool) -> Outcome<Map<String, Value>> {
    let mut map = Map::new();
    map.insert("kind".into(), json!("campaign"));
    map.insert("campaign".into(), json!(campaign.place.campaign));
    map.insert("synthetic".into(), json!(campaign.synthetic()));
    map.insert("verdict".into(), json!(campaign.verdict.name()));
    map.insert("sentence".into(), json!(campaign.sentence()));
    let mut gathered = [Vec::new(), Vec::new()];
    let mut experiments = Vec::new();
    for one in &campaign.files {
        let body = one.body(dry)?;
        let listed = |key: &str| body.get(key).and_then(Value::as_array).cloned();
        let [causes, groups] = &mut gathered;
        let own = listed("causes").into_iter().flatten();
        causes.extend(own.map(|cause| with_file(cause, one)));
        let own = listed("cannot_separate").into_iter().flatten();
        for (value, group) in own.zip(&one.found.answer().groups) {
            match campaign.told(group) {
                Some(told) => causes.push(with_file(told_json(&told, &value), one)),
                None => groups.push(with_file(value, one)),
            }
        }
        experiments.push(with_file(Value::Object(body), one));
    }
    let [mut causes, groups] = gathered;
    if let Some(joint) = &campaign.joint {
        map.insert("joint".into(), joint_json(joint));
    }
    causes.sort_by(|a, b| gain(b).total_cmp(&gain(a)));
    map.insert("causes".into(), Value::Array(causes));
    map.insert("cannot_separate".into(), Value::Array(groups));
    map.insert(
        "checks".into(),
        campaign.checks.iter().map(check_json).collect(),
    );
    map.insert("remarks".into(), json!(campaign.remarks));
    let next = campaign.next.as_ref();
    map.insert("next".into(), json!(next.map(|next| setups(&next.plan))));
    map.insert("experiments".into(), Value::Array(experiments));
    let robot = campaign
        .robot
        .as_ref()
        .filter(|_| !dry)
        .map(|_| campaign.robot_path());
    map.insert(
        "model".into(),
        json!(robot.map(|path| path.display().to_string())),
    );
    Ok(map)
}

fn gain(cause: &Value) -> f64 {
    cause["gain"]["reduction_percent"].as_f64().unwrap_or(0.0)
}

fn with_file(mut value: Value, one: &One) -> Value {
    if let Value::Object(map) = &mut value {
        map.insert("file".into(), json!(one.path().display().to_string()));
    }
    value
}

/// A cause that one experiment cannot tell from others, and all together can.
fn told_json(((effect, site), probability): &(Place, f64), group: &Value) -> Value {
    json!({
        "effect": effect,
        "site": site,
        "probability": probability,
        "alternatives": [],
        "parameters": [],
        "gain": group["gain"],
    })
}

fn joint_json(joint: &Joint) -> Value {
    let cause = |cause: &Together| {
        let alone = joint.tests.iter().zip(&cause.alone);
        let alone: Map<String, Value> = alone.map(|(test, p)| (test.clone(), json!(p))).collect();
        let (effect, site) = &cause.place;
        json!({"effect": effect, "site": site, "probability": cause.probability, "alone": alone})
    };
    joint.causes.iter().map(cause).collect()
}

fn check_json(check: &Check) -> Value {
    json!({
        "from": check.from,
        "causes": check.causes,
        "against": check.against,
        "rms_before": check.before,
        "rms_after": check.after,
        "unit": check.unit,
        "prediction": check.word(),
    })
}
