//! A zero that jumps once.

use super::joint::Joint;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};

/// As the engine takes it: one amount is the jump, rad.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "sensor_offset",
    summary: "The zero of an encoder is off, or jumps.",
    mechanism: "zero",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |joint| {
        let members = joint.jumps.iter().map(|row| jump(joint, *row));
        vec![Place::new(&joint.site, members.collect())]
    },
    parameters: |_, blamed| {
        vec![
            ("jump", blamed.amounts[0], "rad"),
            ("instant", blamed.shape[1], "s"),
        ]
    },
    would_tell: "return to one pose several times during the record: a zero that jumped stays where it went",
};

/// Share of the rows about a jump that was found in which its instant is sought again.
const REACH: usize = 80;

/// Every instant near the one that was found.
pub(super) fn about(joint: &Joint, blamed: &Blamed) -> Vec<Member> {
    let (row, n) = (blamed.shape[0] as usize, joint.data.rows());
    let reach = n / REACH;
    let near = row.saturating_sub(reach).max(2)..(row + reach + 1).min(n - 2);
    near.map(|row| jump(joint, row)).collect()
}

fn jump(joint: &Joint, row: usize) -> Member {
    let column = joint.column(|i| if i < row { 0.0 } else { 1.0 });
    Member::free(column).shaped(&[row as f64, joint.data.time[row]])
}

/// Instants among which a jump is sought.
pub(super) fn tried(joint: &Joint) -> f64 {
    (joint.data.rows() / 20).max(1) as f64
}
