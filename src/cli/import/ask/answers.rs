//! Answers as the values of facts.

use crate::cli::import::value_of;
use crate::ground::problem::{Outcome, Problem};

/// The number of a joint.
pub(super) fn joint(answer: &str) -> Outcome<toml::Value> {
    match answer.trim_start_matches(['A', 'a']).parse() {
        Ok(joint) if (1..=6).contains(&joint) => Ok(toml::Value::Integer(joint)),
        _ => Err(Problem::new(
            format!("`{answer}` is no joint"),
            "give 1 to 6",
        )),
    }
}

/// An answer as the value of a fact, of the form that the key asks for.
pub(super) fn fact(key: &str, answer: &str) -> Outcome<toml::Value> {
    let refuse = |remedy: &str| Err(Problem::new(format!("`{answer}` does not fit"), remedy));
    let value = value_of(&answer.replace(';', ","));
    let number = |value: &toml::Value| value.as_float().or(value.as_integer().map(|n| n as f64));
    match key {
        "joint" => joint(answer),
        "axis" if !["rotation", "tilt"].contains(&answer) => refuse("write rotation or tilt"),
        "joint_angles_deg" => {
            let list = match value.is_array() {
                true => value,
                false => value_of(&format!("[{answer}]")),
            };
            let whole = list
                .as_array()
                .is_some_and(|all| !all.is_empty() && all.iter().all(|v| number(v).is_some()));
            if whole {
                Ok(list)
            } else {
                refuse("write numbers, as 0, -90, 90, 0, 0, 0")
            }
        }
        key if key.ends_with("_m") || key.ends_with("_mm") => match number(&value) {
            Some(length) if length > 0.0 => Ok(value),
            _ => refuse("write a number above zero, with a decimal point"),
        },
        _ => Ok(value),
    }
}
