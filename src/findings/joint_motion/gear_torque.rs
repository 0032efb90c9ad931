//! The torque in the gear: what its motor gives less what the motor's own rotor takes.

use super::channels::Channels;
use super::friction::{Friction, sign};
use super::projection::partial;
use crate::findings::table::{unit_range, waves};

/// Waves over the angle beside which the inertia of the rotor is fitted.
const SLOW: usize = 2;

/// N·m on the link's side, its friction in it, unless the torque pays for nothing but that and inertia. The twist, less what is
/// blamed already, follows it alone, so that the twist over torque and acceleration tells the inertia of the rotor; beside a
/// presumed compliance, over acceleration alone.
pub(super) fn gear_torque(data: &Channels, twist: &[f64], presumed: Option<f64>) -> Vec<f64> {
    let mut others = vec![
        vec![1.0; data.rows()],
        data.speed.clone(),
        sign(data),
        data.quick.clone(),
    ];
    others.extend(data.bends.clone());
    others.extend(waves(&unit_range(&data.motor), SLOW));
    let slope = |channel: &Vec<f64>, other: &Vec<f64>| {
        let beside = [&others[..], std::slice::from_ref(other)].concat();
        partial(&beside, channel, twist).slope
    };
    let (by_torque, by_acceleration) = match presumed {
        Some(compliance) => {
            let each = twist.iter().zip(&data.torque);
            let beyond: Vec<f64> = each.map(|(y, t)| y + compliance * t).collect();
            let slope = partial(&others, &data.acceleration, &beyond).slope;
            (-compliance, slope)
        }
        None => (
            slope(&data.torque, &data.acceleration),
            slope(&data.acceleration, &data.torque),
        ),
    };
    let rotor = match by_torque < 0.0 {
        true => (-by_acceleration / by_torque).max(0.0),
        false => 0.0,
    };
    let torque = match presumed {
        Some(_) => Friction::of(data).less(data, &data.torque),
        None => data.torque.clone(),
    };
    let each = torque.iter().zip(&data.acceleration);
    each.map(|(t, a)| t - rotor * a).collect()
}
