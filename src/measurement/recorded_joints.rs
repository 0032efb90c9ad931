//! Joint angles as a controller recorded them while it ran a job: `trajectory.csv` of a plan, or encoders
//! behind the gears (kind `joint-motion`).

use super::facts::measured;
use super::load_cycle::check_time;
use super::table::Table;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;
use std::path::{Path, PathBuf};

/// Joints of the robots that mill.
const JOINTS: usize = 6;
/// Kinds of file that hold joint angles over time.
const KINDS: [&str; 2] = ["trajectory", "joint-motion"];

/// A recording, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedJoints {
    /// The file.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Times, s, ascending, and joint angles on the link side of the gears, rad.
    pub rows: Vec<(f64, [f64; JOINTS])>,
    /// Rows left out for an empty cell.
    pub left_out: usize,
}

impl RecordedJoints {
    /// Reads columns `time_s` and `q1_deg` to `q6_deg`, or `link_angle_deg_1` to `link_angle_deg_6`.
    ///
    /// # Errors
    /// Another kind of file, a column that is missing, time that does not ascend.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::of(Table::read(path)?).map_err(|problem| problem.in_text(path))
    }

    fn of(table: Table) -> Outcome<Self> {
        let header = table.first_line - 1;
        if let Some(kind) = table.front.text("kind")?
            && !KINDS.contains(&kind)
        {
            let remedy = "give a file of kind trajectory or joint-motion";
            let what = format!("is `{kind}`: no joint angles over time");
            return Err(table.front.problem("kind", what, remedy));
        }
        let missing = |what: String| {
            let remedy = "write the header `time_s,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg`";
            Problem::new(what, remedy).at_line(header)
        };
        let time = measured(&table, "time", Dimension::Time)?
            .ok_or_else(|| missing("has no time column".into()))?;
        check_time(&table)?;
        let mut columns: [&[f64]; JOINTS] = [&[]; JOINTS];
        for (k, column) in columns.iter_mut().enumerate() {
            let [short, long] = [format!("q{}", k + 1), format!("link_angle_{}", k + 1)];
            let found = match measured(&table, &short, Dimension::Angle)? {
                Some(found) => Some(found),
                None => measured(&table, &long, Dimension::Angle)?,
            };
            *column = found.ok_or_else(|| missing(format!("has no angle of joint {}", k + 1)))?;
        }
        let row = |i: usize| (time[i], columns.map(|column| column[i]));
        let whole = |row: &(f64, [f64; JOINTS])| {
            row.0.is_finite() && row.1.iter().all(|angle| angle.is_finite())
        };
        let rows: Vec<_> = (0..table.rows).map(row).filter(whole).collect();
        if let Some(pair) = rows.windows(2).find(|pair| pair[1].0 <= pair[0].0) {
            let what = format!("two rows at {} s", pair[1].0);
            return Err(Problem::new(what, "give every row a time of its own").at_line(header + 1));
        }
        match rows.len() {
            0 | 1 => Err(missing("holds no motion".into())),
            count => Ok(Self {
                left_out: table.rows - count,
                sha256: table.sha256,
                path: table.path,
                rows,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Outcome<RecordedJoints> {
        let table = Table::from_reader(Path::new("r.csv"), text.as_bytes(), text.len() as u64)?;
        RecordedJoints::of(table)
    }

    #[test]
    fn angles_of_both_kinds_are_read_and_others_refused() {
        let short = "time_s,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,1,2,3,4,5,180\n1,1,,3,4,5,6\n2,1,2,3,4,5,6\n";
        let found = read(short).unwrap();
        assert_eq!((found.rows.len(), found.left_out), (2, 1));
        assert!((found.rows[0].1[5] - std::f64::consts::PI).abs() < 1e-15);
        let long = short.replace("q", "link_angle_").replace("_deg", "");
        let long = (1..=6).fold(long, |text, k| {
            text.replacen(
                &format!("link_angle_{k}"),
                &format!("link_angle_deg_{k}"),
                1,
            )
        });
        assert_eq!(read(&long).unwrap().rows, found.rows);
        let other = format!("# kind = \"screw\"\n{short}");
        for wrong in [
            &other,
            "time_s,q1_deg\n0,1\n1,2\n",
            &short.replace("2,1,2", "0,1,2"),
        ] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
