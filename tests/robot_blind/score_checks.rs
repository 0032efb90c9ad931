//! The scoring itself, on answers written by hand.

use super::judge::read;
use super::score::{Score, alarm, place_right, score, unknown};
use super::workspace_case::workspace_case;
use serde_json::{Value, json};

fn judged(said: &Value) -> (Score, bool) {
    let mut case = workspace_case("drive_stiffness", 1);
    case.truths[0].sites = vec!["A2".into()];
    let answer = read(said);
    (score(&case, &answer), place_right(&case, &answer))
}

fn cause(effect: &str, site: &str) -> Value {
    json!({"effect": effect, "site": site})
}

#[test]
fn causes_are_scored() {
    let exact = json!({"verdict": "explained", "causes": [cause("drive_stiffness", "A2")]});
    assert_eq!(judged(&exact), (Score::Exact, true));
    let part = json!({"verdict": "partly-explained", "causes": [cause("drive_stiffness", "A2")]});
    assert_eq!(judged(&part), (Score::Covered, true));
    let more = json!({"verdict": "explained",
        "causes": [cause("drive_stiffness", "A2"), cause("force_gain", "sensor")]});
    assert_eq!(judged(&more), (Score::Extra, true));
    let elsewhere = json!({"verdict": "explained", "causes": [cause("drive_stiffness", "A3")]});
    assert_eq!(judged(&elsewhere), (Score::Wrong, false));
    let misnamed = json!({"verdict": "explained", "causes": [cause("backlash", "A2")]});
    assert_eq!(judged(&misnamed), (Score::Wrong, true));
    let missed = json!({"verdict": "sufficient", "causes": []});
    assert_eq!(judged(&missed), (Score::Missed, false));
    assert!(!alarm(&read(&missed)) && alarm(&read(&part)) && unknown(&read(&part)));
}

/// A group may have a member among the causes, which stands for it.
#[test]
fn groups_are_scored() {
    let group =
        json!([{"effects": ["tilt_stiffness", "drive_stiffness"], "sites": ["A1-tilt", "A2"]}]);
    let open = json!({"verdict": "cannot-tell", "causes": [], "cannot_separate": group});
    assert_eq!(judged(&open), (Score::Covered, true));
    let stands = json!({"verdict": "explained", "causes": [cause("tilt_stiffness", "A1-tilt")],
        "cannot_separate": group});
    assert_eq!(judged(&stands), (Score::Covered, true));
    let wide = json!({"verdict": "cannot-tell", "causes": [], "cannot_separate": [{
        "effects": ["drive_stiffness", "drive_stiffness", "tilt_stiffness", "force_gain"],
        "sites": ["A1", "A2", "A1-tilt", "sensor"]}]});
    assert_eq!(judged(&wide), (Score::Wide, false));
    let other = json!({"verdict": "cannot-tell", "causes": [], "cannot_separate": [{
        "effects": ["drive_stiffness", "tilt_stiffness"], "sites": ["A1", "A2-tilt"]}]});
    assert_eq!(judged(&other), (Score::Wrong, false));
}
