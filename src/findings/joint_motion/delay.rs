//! The delay between the encoders with an interval that holds for every account of the rest.

use super::friction::sign;
use super::joint::{Joint, TORQUE};
use super::projection::partial;
use crate::findings::engine::Noise;
use crate::findings::table::{unit_range, waves};
use crate::ground::stats::mean;

/// A delay of the link encoder behind the motor encoder, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Delay {
    /// Value, what the file declares in it.
    pub value: f64,
    /// Standard deviation, disagreement between the accounts included.
    pub std: f64,
}

/// Estimates it with the parts that other causes have in the twist beside the speed; further accounts add friction
/// and slow structure over the angle.
pub fn delay(joint: &Joint, parts: &[Vec<f64>]) -> Delay {
    let data = &joint.data;
    let plain: Vec<Vec<f64>> = [&joint.base(), parts].concat();
    let dry = vec![sign(data)];
    let slow = waves(&unit_range(&data.motor), 2);
    let both = [dry.clone(), slow.clone()].concat();
    let late = |more: &[Vec<f64>]| {
        let beside = [&plain, more].concat();
        let rate = partial(&beside, &data.speed, &data.twist).slope;
        let mut beside = beside;
        beside[TORQUE].clone_from(&data.speed);
        let compliance = -partial(&beside, &data.torque, &data.twist).slope;
        compliance.max(0.0) * joint.friction.viscous.max(0.0) - rate
    };
    let values = [&[], &dry[..], &slow, &both].map(late);
    let value = mean(&values);
    let squares = values
        .iter()
        .map(|v| (v - value) * (v - value))
        .sum::<f64>();
    let white = |c: &Vec<f64>| joint.noise.whiten(c);
    let beside: Vec<Vec<f64>> = plain.iter().map(white).collect();
    let own = partial(&beside, &white(&data.speed), &white(&data.twist));
    Delay {
        value: value + joint.declared.unwrap_or(0.0),
        std: (squares / (values.len() - 1) as f64)
            .sqrt()
            .hypot(own.square.sqrt().recip()),
    }
}
