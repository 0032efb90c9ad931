//! Whether a motion fixes the stiffness of a joint at all: twist that follows the torque must not be
//! twist that follows speed, direction, acceleration or angle, and every piece of time must say the same.

use super::channels::Channels;
use super::friction::sign;
use super::joint::Joint;
use super::presumed::OWN;
use super::projection::{left, partial};
use crate::findings::engine::Noise;
use crate::findings::table::{unit_range, waves};
use crate::ground::stats::rms;

/// A compliance with the interval that all pieces and all accounts support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compliance {
    /// Twist per torque, rad/(N·m).
    pub value: f64,
    /// Its standard deviation, disagreement of the pieces included.
    pub std: f64,
}

/// Largest relative standard deviation of a compliance that is printed.
const TIGHT: f64 = 0.1;
/// The torque's own part of the twist must stand so far above what is left, as smooth as the torque.
const STANDS_OUT: f64 = 1.5;
/// Pieces of time: which of how many.
const PIECES: [(usize, usize); 6] = [(0, 1), (0, 2), (1, 2), (0, 3), (1, 3), (2, 3)];

/// The compliance, or why there is none. `parts`: what else is in the twist.
///
/// # Errors
/// The reason, a clause.
pub fn compliance(joint: &Joint, parts: &[Vec<f64>]) -> Result<Compliance, &'static str> {
    if joint.ratio.is_none() {
        return Err("the file states no gear ratio");
    }
    let data = &joint.data;
    let accounts = accounts(joint, parts);
    let telling = telling(&accounts, data);
    let white = |c: &Vec<f64>| joint.noise.whiten(c);
    let beside: Vec<Vec<f64>> = telling.iter().map(white).collect();
    let found = partial(&beside, &white(&data.torque), &white(&data.twist));
    let value = -found.slope;
    if value <= 0.0 {
        return Err("the twist does not grow with the torque once speed is accounted for");
    }
    let std = found
        .square
        .sqrt()
        .recip()
        .hypot(spread(joint, &accounts, value));
    if std > TIGHT * value {
        return Err(
            "pieces of the record and the terms for friction and angle do not agree on one",
        );
    }
    let own = value * rms(&left(telling, &data.torque));
    // what is left scatters from reading to reading, the torque's part does not
    let beside = data.smoothed(&left(&with(telling, &data.torque), &data.twist));
    if own < STANDS_OUT * rms(&beside) {
        return Err("the torque's own part of the twist does not stand out from what is left");
    }
    Ok(Compliance { value, std })
}

/// Columns beside the torque: as few as found, with friction, with slow structure over the angle, and
/// with more of it and a drift.
fn accounts(joint: &Joint, parts: &[Vec<f64>]) -> Vec<Vec<Vec<f64>>> {
    let data = &joint.data;
    let few = [&joint.beside_spring(), parts].concat();
    let rubbed = with(&with(&few, &sign(data)), &data.speed);
    let slow = waves(&unit_range(&data.motor), 2);
    let full = [rubbed.clone(), slow].concat();
    let slower = [
        waves(&unit_range(&data.motor), 4),
        waves(&unit_range(&data.time), 2),
    ]
    .concat();
    let fullest = [rubbed.clone(), slower].concat();
    vec![few, rubbed, full, fullest]
}

/// The account with most beside the torque that leaves a part of it, speed and direction beside it in any case, which a late encoder follows; the
/// last where none does. Where hardly anything of the torque is left, what laws miss of the twist would tell the spring: all accounts must agree, so
/// that the last one mostly tells none.
fn telling<'a>(accounts: &'a [Vec<Vec<f64>>], data: &Channels) -> &'a [Vec<f64>] {
    let whole = data.torque_moves();
    let leaves = |account: &&Vec<Vec<f64>>| rms(&left(account, &data.torque)) > OWN * whole;
    let found = accounts.iter().skip(1).rev().find(leaves);
    found.or(accounts.last()).map_or(&[], Vec::as_slice)
}

fn with(columns: &[Vec<f64>], one: &[f64]) -> Vec<Vec<f64>> {
    [columns, &[one.to_vec()]].concat()
}

/// Root mean square deviation from `value` of what every account says of every piece of time, each weighted by
/// how much torque of its own the piece has.
fn spread(joint: &Joint, accounts: &[Vec<Vec<f64>>], value: f64) -> f64 {
    let (data, n) = (&joint.data, joint.data.rows());
    let (mut sum, mut weight) = (0.0, f64::MIN_POSITIVE);
    for account in accounts {
        for (k, of) in PIECES {
            let piece = |c: &[f64]| c[n * k / of..n * (k + 1) / of].to_vec();
            let others: Vec<Vec<f64>> = account.iter().map(|c| piece(c)).collect();
            let own = partial(&others, &piece(&data.torque), &piece(&data.twist));
            sum += own.square * (own.slope + value).powi(2);
            weight += own.square;
        }
    }
    (sum / weight).sqrt()
}
