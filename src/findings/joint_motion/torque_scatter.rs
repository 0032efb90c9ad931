//! What neither motion, nor weight, nor anything slow makes of a torque: noise of its reading, and how the arm swings. In a column of its own
//! it takes nothing from the spring, whose column is then all but free of noise: else a smaller spring would have less of it, and speed or
//! acceleration, which have none, would make up for the rest, as a late encoder or a loop (regression dilution; Fuller 1987).

use super::channels::Channels;
use super::coulomb_friction::dry;
use super::friction::inertia_and_weight;
use super::projection::left;
use crate::findings::table::{unit_range, waves};

/// Half waves over time for every second, up to three quarters of a hertz, and at most so many. A choice: on 120 files by a stranger 0.5 to 3 answered
/// all but the same; on the real run of a KR 300 less than 1.5 took a drift for friction.
const PER_SECOND: f64 = 1.5;
const MOST: usize = 150;

/// Of a joint's channels, N·m.
pub(super) fn torque_scatter(data: &Channels) -> Vec<f64> {
    let lasts = data.time[data.rows() - 1] - data.time[0];
    let slow = ((PER_SECOND * lasts) as usize).min(MOST);
    let mut columns = inertia_and_weight(data);
    columns.push(data.speed.clone());
    columns.extend(dry(data));
    columns.extend(waves(&unit_range(&data.time), slow));
    left(&columns, &data.torque)
}
