//! The JSON of `ident validate`.

use super::Validated;
use crate::fit::separability::Group;
use crate::fit::validation::Comparison;
use crate::measurement::workspace_test::DIRECTIONS;
use crate::report::json;
use serde_json::{Map, Value, json};
use std::path::Path;

/// One document.
pub fn json(validated: &Validated, dry: bool) -> String {
    let found = &validated.found;
    let mut map = head(validated);
    let mut put = |key: &str, value: Value| map.insert(key.into(), value);
    put("kind", json!("workspace"));
    put("robot", json!(validated.base.path));
    put("synthetic", json!(validated.test.facts.synthetic));
    put("points", found.comparisons.iter().map(point).collect());
    let (mean, max) = pair(found.errors(|c| c.simulated));
    put("mean_abs_error_percent", mean);
    put("max_abs_error_percent", max);
    let (mean, max) = pair(found.errors(|c| c.without_tilt));
    let (refit_p, refit_chi) = match &found.rigid_bearings {
        Some(refit) => (json::number(refit.p_value), json::number(refit.chi_squared)),
        None => (Value::Null, Value::Null),
    };
    let ratio = [0, 1, 2].map(|d| {
        (
            DIRECTIONS[d].to_string(),
            found.tilt_ratio(d).map_or(Value::Null, json::number),
        )
    });
    put(
        "without_tilt",
        json!({
            "mean_abs_error_percent": mean,
            "max_abs_error_percent": max,
            "stiffness_ratio": Map::from_iter(ratio),
            "refit_chi_squared": refit_chi,
            "refit_p_value": refit_p,
        }),
    );
    put("parameters", parameters(validated));
    let (mean, max) = pair(found.errors(|c| c.refitted));
    put(
        "refit",
        json!({
            "mean_abs_error_percent": mean,
            "max_abs_error_percent": max,
            "chi_squared": json::number(found.refit.chi_squared),
            "slopes": found.refit.slopes,
            "p_value": json::number(found.refit.p_value),
        }),
    );
    put("cannot_separate", found.groups.iter().map(group).collect());
    put("rows", json!(validated.test.rows));
    put("rows_left_out", json!(validated.test.left_out));
    put("warnings", json!(found.warnings));
    put("doubts", json!(found.doubts));
    let model = match dry {
        true => Value::Null,
        false => json!(validated.robot_path().display().to_string()),
    };
    put("model", model);
    json::print(map)
}

fn head(validated: &Validated) -> Map<String, Value> {
    let base = Path::new(&validated.base.path);
    let mut inputs: Vec<(&Path, &str)> = vec![
        (&validated.test.path, &validated.test.sha256),
        (base, &validated.base.sha256),
    ];
    let fits = validated
        .tests
        .iter()
        .map(|t| (t.path.as_path(), t.sha256.as_str()));
    inputs.extend(fits);
    json::head("validate", &inputs)
}

fn pair(errors: Option<(f64, f64)>) -> (Value, Value) {
    errors.map_or((Value::Null, Value::Null), |(mean, max)| {
        (json::number(mean), json::number(max))
    })
}

fn point(c: &Comparison) -> Value {
    let percent = |k: f64| c.error_percent(k).map_or(Value::Null, json::number);
    let mm = |k: f64| c.error_m(k).map_or(Value::Null, |m| json::number(1e3 * m));
    let wild: usize = c.setup.lines.iter().flatten().map(|line| line.wild).sum();
    json!({
        "point": c.setup.point + 1,
        "direction": DIRECTIONS[c.setup.direction],
        "measured_N_m": c.measured.value,
        "measured_stderr_N_m": c.measured.stderr,
        "measured_ci95_N_m": c.measured.ci95,
        "status": c.measured.status,
        "simulated_N_m": json::number(c.simulated),
        "simulated_without_tilt_N_m": json::number(c.without_tilt),
        "refitted_N_m": json::number(c.refitted),
        "error_percent": percent(c.simulated),
        "error_without_tilt_percent": percent(c.without_tilt),
        "error_mm_at_750_N": mm(c.simulated),
        "inside_interval": c.agrees(),
        "measured_slope_m_N": c.setup.lines.map(|line| line.map(|l| l.slope)),
        "cycles": c.setup.cycles,
        "rows": c.setup.rows,
        "readings_left_out": wild,
    })
}

fn parameters(validated: &Validated) -> Value {
    let refit = &validated.found.refit;
    let list = validated
        .found
        .parameters()
        .into_iter()
        .enumerate()
        .map(|(i, parameter)| {
            let prior = &refit.priors[i];
            let mut value = json!(parameter);
            if let Value::Object(map) = &mut value {
                map.insert(
                    "prior".into(),
                    json!({
                        "source": if prior.measured { "axis test" } else { "nominal" },
                        "stiffness": json::number(prior.stiffness),
                        "rel_std": json::number(prior.rel_std),
                    }),
                );
                map.insert("learned_from_points".into(), json::number(refit.learned(i)));
            }
            value
        });
    list.collect()
}

fn group(group: &Group) -> Value {
    let weights = group.sites.iter().zip(&group.weights);
    let weights = weights.map(|(site, w)| (site.clone(), json::number(*w)));
    let mut map = Map::new();
    map.insert("kind".into(), json!(group.kind.name()));
    map.insert("sites".into(), json!(group.sites));
    let effects: Vec<&str> = group.sites.iter().map(|site| effect(site)).collect();
    map.insert("effects".into(), json!(effects));
    let key = match group.weights.is_empty() {
        true => "cosine",
        false => "relative_std",
    };
    map.insert(key.into(), json::number(group.measure));
    map.insert("weights".into(), Value::Object(weights.collect()));
    map.insert("would_tell".into(), json!(group.would_tell));
    Value::Object(map)
}

/// The effect that a site stands for, by the names of the workspace diagnosis.
fn effect(site: &str) -> &'static str {
    match site {
        s if s.ends_with("-tilt") => "tilt_stiffness",
        s if s.starts_with("base") => "base_compliance",
        s if s.starts_with('A') => "drive_stiffness",
        _ => "link_compliance",
    }
}
