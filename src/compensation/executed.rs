//! The corrected path as the controller will run it: planned anew from the file that is written.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{norm, rotate, sub};
use crate::measurement::toolpath::Toolpath;
use crate::planning::plan::Row;
use crate::process::Planned;
use crate::process::way::{self, Way};
use std::path::Path;

/// A corrected path, planned.
pub struct Executed {
    /// Its plan.
    pub planned: Planned,
    /// Its motion; arc lengths are those of the programmed path.
    pub way: Way,
}

/// Plans the text of a corrected path that will stand at `path`.
///
/// # Errors
/// A place that the robot no longer reaches.
pub fn executed(job: &Planned, path: &Path, text: &str) -> Outcome<Executed> {
    let toolpath = Toolpath::of_bytes(path, text.as_bytes())?;
    let planned = Planned::of(job.job.clone(), toolpath)?.map_err(|unplanned| unplanned.problem)?;
    let stations = Stations::of(&planned);
    let spindle = planned.plan.cell.spindle;
    let row = |row: &Row| way::Row {
        time_s: row.t,
        s_m: stations.programmed(row.s),
        tip: row.point,
        axis: rotate(&row.orientation.matrix(), spindle),
        joints: row.q.to_vec(),
    };
    let way = Way::new(planned.plan.rows.iter().map(row).collect());
    Ok(Executed {
        way: way.ok_or_else(|| Problem::new("the corrected path is no motion", "check the job"))?,
        planned,
    })
}

/// Arc lengths of the corrected path and of the programmed one at the same points, m.
struct Stations(Vec<[f64; 2]>);

impl Stations {
    fn of(planned: &Planned) -> Self {
        let moves = &planned.toolpath.moves;
        let mut length = 0.0;
        let mut all: Vec<[f64; 2]> = Vec::new();
        for (i, one) in moves.iter().enumerate() {
            length += i
                .checked_sub(1)
                .map_or(0.0, |b| norm(sub(one.to, moves[b].to)));
            all.push([length, one.station.unwrap_or(length)]);
        }
        // blends cut corners by next to nothing
        let share = planned.plan.path.length / length.max(f64::MIN_POSITIVE);
        all.iter_mut().for_each(|pair| pair[0] *= share);
        Self(all)
    }

    fn programmed(&self, s: f64) -> f64 {
        let last = self.0.len() - 1;
        let after = self
            .0
            .partition_point(|pair| pair[0] < s)
            .clamp(1, last.max(1));
        let ([a, p], [b, q]) = (self.0[after - 1], self.0[after.min(last)]);
        let share = ((s - a) / (b - a).max(1e-12)).clamp(0.0, 1.0);
        p + share * (q - p)
    }
}
