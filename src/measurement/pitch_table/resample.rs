//! Controllers that want interpolation points at equal distances.

use super::{PitchTable, Row};
use crate::ground::problem::{Outcome, Problem};

/// First point, distance and values at equal distances, mm and µm.
pub(super) struct Even {
    pub(super) first_mm: f64,
    pub(super) step_mm: f64,
    pub(super) rows: Vec<Row>,
}

impl Even {
    /// As many points as the table has, over its whole length.
    pub(super) fn of(table: &PitchTable) -> Outcome<Self> {
        let (Some(first), Some(last)) = (table.rows.first(), table.rows.last()) else {
            return Err(too_short());
        };
        let intervals = table.rows.len() - 1;
        if intervals == 0 {
            return Err(too_short());
        }
        let step_mm = (last.target_mm - first.target_mm) / intervals as f64;
        let row = |i: usize| {
            let at = first.target_mm + step_mm * i as f64;
            Row {
                target_mm: at,
                forward_um: table.correction_um(at, true),
                backward_um: table.correction_um(at, false),
            }
        };
        Ok(Self {
            first_mm: first.target_mm,
            step_mm,
            rows: (0..=intervals).map(row).collect(),
        })
    }

    /// The last point, mm.
    pub(super) fn last_mm(&self) -> f64 {
        self.first_mm + self.step_mm * (self.rows.len() - 1) as f64
    }
}

fn too_short() -> Problem {
    Problem::new("a table needs two targets", "measure at more targets")
}

/// The value behind `name` in `$NAME[...]=value`, and the numbers in its brackets.
pub(super) fn variable<'a>(line: &'a str, name: &str) -> Option<(Vec<&'a str>, f64)> {
    let rest = line.trim().strip_prefix(name)?.strip_prefix('[')?;
    let (inside, value) = rest.split_once(']')?;
    let value = value.trim().strip_prefix('=')?.trim().parse().ok()?;
    Some((inside.split(',').collect(), value))
}

/// Whether a line holds no value: a remark, what every file begins and ends with, or one of `others`.
pub(super) fn is_frame(line: &str, others: &[&str]) -> bool {
    let every = [";", "%", "CHANDATA", "M17"];
    let mut starts = every.iter().chain(others);
    line.is_empty() || starts.any(|start| line.starts_with(start))
}

/// The table of values at equal distances, mm and µm.
pub(super) fn evenly([first, step]: [f64; 2], forward: &[f64], backward: &[f64]) -> PitchTable {
    let values = forward.iter().zip(backward).enumerate();
    let row = |(i, (forward, backward)): (usize, (&f64, &f64))| Row {
        target_mm: first + step * i as f64,
        forward_um: *forward,
        backward_um: *backward,
    };
    PitchTable {
        rows: values.map(row).collect(),
        ..PitchTable::default()
    }
}
