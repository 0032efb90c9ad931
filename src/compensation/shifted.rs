//! The programmed motion with a correction: the same law of time, other places, other joint angles.

use super::correction::Correction;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{add, rotate};
use crate::planning::Plan;
use crate::planning::follow::Follower;
use crate::process::way::{Row, Way};

/// The plan's rows moved by a correction.
///
/// # Errors
/// A place that the robot no longer reaches.
pub fn shifted(plan: &Plan, correction: &Correction) -> Outcome<Way> {
    let mut follower = Follower::new(&plan.cell);
    let row = |row: &crate::planning::plan::Row| {
        let tip = add(row.point, correction.at(row.s));
        let pose = plan.cell.in_base(tip, row.orientation);
        let joints = follower.next(&pose).map_err(|_| unreached(row.s))?;
        Ok(Row {
            time_s: row.t,
            s_m: row.s,
            tip,
            axis: rotate(&row.orientation.matrix(), plan.cell.spindle),
            joints: joints.to_vec(),
        })
    };
    let rows = plan.rows.iter().map(row).collect::<Outcome<Vec<Row>>>()?;
    Way::new(rows).ok_or_else(|| unreached(0.0))
}

fn unreached(s: f64) -> Problem {
    Problem::new(
        format!(
            "the corrected path leaves the reach of the robot at {:.1} mm",
            1e3 * s
        ),
        "place the part nearer with [workpiece]",
    )
}
