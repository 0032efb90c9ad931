//! The JSON of measuring cubes.

use super::Identified;
use crate::fit::axis_tests::AxisTest;
use crate::fit::cubes::relative::Relative;
use crate::fit::cubes::together::Together;
use crate::report::json::{self, number, numbers};
use serde_json::{Value, json};
use std::path::Path;

/// The document.
pub fn document(found: &Identified, dry: bool) -> String {
    let mut inputs: Vec<(&Path, &str)> = found
        .tests
        .iter()
        .map(|t| (t.path.as_path(), t.sha256.as_str()))
        .collect();
    inputs.push((Path::new(&found.base.path), found.base.sha256.as_str()));
    let account = &found.account;
    let solved = &account.solved;
    let mut map = json::head("stiffness", &inputs);
    map.insert("kind".into(), json!("cubes"));
    map.insert("robot".into(), json!(found.base.path));
    map.insert("synthetic".into(), json!(found.synthetic()));
    map.insert("parameters".into(), json!(account.parameters));
    map.insert(
        "together".into(),
        account.together.iter().map(together).collect(),
    );
    map.insert(
        "relative".into(),
        account.relative.iter().map(relative).collect(),
    );
    map.insert(
        "fit".into(),
        json!({
            "rms_m": number(solved.rms[1][0]), "rms_rad": number(solved.rms[1][1]),
            "rms_before_m": number(solved.rms[0][0]), "rms_before_rad": number(solved.rms[0][1]),
            "noise_m": number(solved.noise[0]), "noise_rad": number(solved.noise[1]),
            "readings": solved.readings, "p_value": number(solved.p_value),
        }),
    );
    map.insert("warnings".into(), json!(found.warnings()));
    map.insert("doubts".into(), json!(found.doubts));
    let path = (!dry).then(|| found.robot_path().display().to_string());
    map.insert("axis_tests".into(), compared(found));
    let fit = (!dry).then(|| found.fit_path().display().to_string());
    map.insert("fit_file".into(), json!(fit));
    map.insert("identified_robot".into(), json!(path));
    json::print(map)
}

/// What axis tests of the campaign say of the same sites.
fn compared(found: &Identified) -> Value {
    let own = |test: &AxisTest| {
        let own = found
            .account
            .parameters
            .iter()
            .find(|p| p.site == test.site);
        let value = own.and_then(|p| p.value);
        json!({
            "site": test.site, "cubes": value, "axis_test": number(test.stiffness.0),
            "axis_test_ci95": numbers(&test.ci95), "unit": "N·m/rad",
            "difference_percent": value.map(|v| number(100.0 * (v / test.stiffness.0 - 1.0))),
        })
    };
    found.axis_tests.iter().map(own).collect()
}

fn together(group: &Together) -> Value {
    let (value, ci95) = group.stiffness.unzip();
    json!({"sites": group.sites, "stiffness": value, "unit": "N·m/rad", "ci95": ci95})
}

fn relative(pair: &Relative) -> Value {
    let thousand = |v: [f64; 3]| numbers(&v.map(|x| x * 1e3));
    json!({
        "from": pair.from, "to": pair.to, "test": pair.test, "file": pair.file,
        "rotation_mrad": thousand(pair.rotation),
        "shift_mm": thousand(pair.shift),
        "moment_Nm": numbers(&pair.moment),
        "moment_about_m": numbers(&pair.about),
    })
}
