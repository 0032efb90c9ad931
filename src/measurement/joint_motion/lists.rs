//! Facts of a joint motion that are one number for all joints, or a list with one for each.

use crate::ground::problem::Outcome;
use crate::measurement::front::Front;

/// Facts that are one number for all joints, or a list with one for each.
pub(super) struct Lists {
    pub(super) ratio: Vec<Option<f64>>,
    pub(super) delay: Vec<Option<f64>>,
    pub(super) nominal: Vec<Option<f64>>,
    pub(super) rel_std: Vec<Option<f64>>,
    pub(super) zero_std_deg: Vec<Option<f64>>,
}

impl Lists {
    pub(super) fn of(front: &Front, joints: usize) -> Outcome<Self> {
        let delay = match front.facts.contains_key("encoder_delay_s") {
            true => "encoder_delay_s",
            false => "sensor_delay_s",
        };
        Ok(Self {
            ratio: positive(front, "gear_ratio", joints)?,
            delay: one_or_each(front, delay, joints)?,
            nominal: positive(front, "nominal_stiffness_Nm_rad", joints)?,
            rel_std: positive(front, "nominal_stiffness_rel_std", joints)?,
            zero_std_deg: positive(front, "encoder_zero_std_deg", joints)?,
        })
    }
}

fn one_or_each(front: &Front, key: &str, joints: usize) -> Outcome<Vec<Option<f64>>> {
    if !matches!(front.facts.get(key), Some(toml::Value::Array(_))) {
        return Ok(vec![front.number(key)?; joints]);
    }
    let list = front.numbers(key)?.unwrap_or_default();
    if list.len() != joints {
        return Err(front.problem(
            key,
            format!("has {} numbers for {joints} joints", list.len()),
            "give one number for every joint with columns, in their order, or one for all",
        ));
    }
    Ok(list.into_iter().map(Some).collect())
}

fn positive(front: &Front, key: &str, joints: usize) -> Outcome<Vec<Option<f64>>> {
    let list = one_or_each(front, key, joints)?;
    match list.iter().flatten().find(|v| **v <= 0.0 || !v.is_finite()) {
        None => Ok(list),
        Some(v) => Err(front.problem(
            key,
            format!("holds {v}, which is not above zero"),
            "give positive values; a reversed axis is a matter of the signs of its angles",
        )),
    }
}
