//! Kind `joint-motion`: encoders on both sides of the gears, and motor torques, while the robot moves.

mod lists;

use super::load_cycle::{check_time, interpolate};
use super::table::Table;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;
use lists::Lists;
use std::path::{Path, PathBuf};

/// The facts of this kind, as they are written.
pub(super) const FACTS: &[&str] = &[
    "gear_ratio",
    "encoder_delay_s",
    "sensor_delay_s",
    "nominal_stiffness_Nm_rad",
    "nominal_stiffness_rel_std",
    "encoder_zero_std_deg",
];

/// The facts of a file, SI.
#[derive(Debug, Clone, Default)]
pub struct Facts {
    /// Robot name or file.
    pub robot: Option<String>,
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

/// One joint: SI, angles and speeds on the link side of the gear, the torque too.
#[derive(Debug, Clone, Default)]
pub struct JointRecord {
    /// Its number, 1 to 6.
    pub number: usize,
    /// Time, s.
    pub time: Vec<f64>,
    /// Angle of the motor, divided by the gear ratio, rad.
    pub motor: Vec<f64>,
    /// Angle of the link, rad.
    pub link: Vec<f64>,
    /// Torque of the motor, times the gear ratio, N·m.
    pub torque: Vec<f64>,
    /// Gear ratio; without it the torque is as the motor gives it, and says nothing of a stiffness.
    pub ratio: Option<f64>,
    /// Declared delay of the link encoder behind the motor encoder, s; undone on reading.
    pub delay: Option<f64>,
    /// Stiffness that the file says the simulation uses, N·m/rad.
    pub nominal_stiffness: Option<f64>,
    /// Its relative standard deviation.
    pub nominal_rel_std: f64,
    /// Standard deviation to which the zeros of the two encoders are known to agree, rad.
    pub zero_std: Option<f64>,
    /// Rows left out because a cell was empty.
    pub left_out: usize,
}

#[cfg(test)]
impl JointRecord {
    /// Time, motor, link and torque of A2 and nothing else.
    pub fn bare([time, motor, link, torque]: [Vec<f64>; 4]) -> Self {
        Self {
            number: 2,
            time,
            motor,
            link,
            torque,
            ratio: None,
            delay: None,
            nominal_stiffness: None,
            nominal_rel_std: 0.1,
            zero_std: None,
            left_out: 0,
        }
    }
}

impl JointRecord {
    /// Its site: `A2`.
    pub fn site(&self) -> String {
        format!("A{}", self.number)
    }
}

/// A file of this kind.
#[derive(Debug, Clone)]
pub struct JointMotion {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub facts: Facts,
    /// The joints that were measured.
    pub joints: Vec<JointRecord>,
}

/// Rows of a joint below which nothing can be told.
const FEWEST_ROWS: usize = 64;

/// Columns of a joint: stem and what it measures; the last may be left out.
const COLUMNS: [(&str, Dimension); 4] = [
    ("motor_angle", Dimension::Angle),
    ("link_angle", Dimension::Angle),
    ("motor_torque", Dimension::Moment),
    ("motor_speed", Dimension::AngularSpeed),
];

impl JointMotion {
    /// Reads a file of kind `joint-motion`.
    ///
    /// # Errors
    /// What is missing or wrong, with line, column and remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::from_table(Table::read(path)?).map_err(|problem| problem.in_text(path))
    }

    /// Interprets a table that was read already.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn from_table(table: Table) -> Outcome<Self> {
        table.front.expect_kind("joint-motion")?;
        table.front.only(FACTS)?;
        let numbers = joints_of(&table)?;
        check_time(&table)?;
        let lists = Lists::of(&table.front, numbers.len())?;
        let joint = |(place, number): (usize, &usize)| joint(&table, *number, place, &lists);
        let joints = numbers
            .iter()
            .enumerate()
            .map(joint)
            .collect::<Outcome<Vec<_>>>()?;
        Ok(Self {
            facts: Facts {
                robot: table.front.text("robot")?.map(str::to_string),
                synthetic: table.front.synthetic(),
            },
            joints,
            path: table.path,
            sha256: table.sha256,
        })
    }
}

/// Numbers of the joints that have columns; each must have what it needs, in the right unit.
fn joints_of(table: &Table) -> Outcome<Vec<usize>> {
    let header = table.first_line - 1;
    let refuse = |what: String, remedy: String| Problem::new(what, remedy).at_line(header);
    if table.column("time").is_none() {
        return Err(refuse(
            "has no time column".into(),
            "add a column `time_s`".into(),
        ));
    }
    let has = |stem: &str, i: usize| table.column(&format!("{stem}_{i}")).is_some();
    let numbers: Vec<usize> = (1..=6)
        .filter(|i| COLUMNS.iter().any(|(stem, _)| has(stem, *i)))
        .collect();
    if numbers.is_empty() {
        return Err(refuse(
            "has no joint".into(),
            "add `motor_angle_deg_1, link_angle_deg_1, motor_torque_Nm_1` for joint 1, and so on"
                .into(),
        ));
    }
    for i in &numbers {
        for (stem, dimension) in COLUMNS {
            check_column(table, stem, *i, dimension)?;
        }
    }
    Ok(numbers)
}

fn check_column(table: &Table, stem: &str, i: usize, dimension: Dimension) -> Outcome<()> {
    let header = table.first_line - 1;
    let unit = match dimension {
        Dimension::Moment => "Nm",
        Dimension::AngularSpeed => "deg_s",
        _ => "deg",
    };
    match table.column(&format!("{stem}_{i}")) {
        None if stem == "motor_speed" => Ok(()),
        None => Err(Problem::new(
            format!("joint {i} has no {}", stem.replace('_', " ")),
            format!("add a column `{stem}_{unit}_{i}`, or take the other columns of joint {i} out"),
        )
        .at_line(header)),
        Some(column) if column.dimension != Some(dimension) => Err(Problem::new(
            format!("measures no {dimension}"),
            format!("correct the unit in the name, as in `{stem}_{unit}_{i}`"),
        )
        .in_column(&column.name)
        .at_line(header)),
        Some(_) => Ok(()),
    }
}

fn joint(table: &Table, number: usize, place: usize, lists: &Lists) -> Outcome<JointRecord> {
    let column = |stem: &str| {
        let name = format!("{stem}_{number}");
        let found = table.column(&name).and_then(|c| c.numbers());
        found.unwrap_or_default()
    };
    let time = table
        .column("time")
        .and_then(|c| c.numbers())
        .unwrap_or_default();
    let channels = [
        column("motor_angle"),
        column("link_angle"),
        column("motor_torque"),
    ];
    let whole = |i: &usize| !time[*i].is_nan() && channels.iter().all(|c| !c[*i].is_nan());
    let kept: Vec<usize> = (0..table.rows).filter(whole).collect();
    check_rows(table, number, &kept, time)?;
    let take = |values: &[f64], factor: f64| -> Vec<f64> {
        kept.iter().map(|i| values[*i] * factor).collect()
    };
    let mut joint = JointRecord {
        number,
        time: take(time, 1.0),
        motor: take(channels[0], 1.0),
        link: take(channels[1], 1.0),
        torque: take(channels[2], lists.ratio[place].unwrap_or(1.0)),
        ratio: lists.ratio[place],
        delay: lists.delay[place],
        nominal_stiffness: lists.nominal[place],
        nominal_rel_std: lists.rel_std[place].unwrap_or(0.05),
        zero_std: lists.zero_std_deg[place].map(f64::to_radians),
        left_out: table.rows - kept.len(),
    };
    undo_declared_delay(&mut joint);
    Ok(joint)
}

fn check_rows(table: &Table, number: usize, kept: &[usize], time: &[f64]) -> Outcome<()> {
    if kept.len() < FEWEST_ROWS {
        return Err(Problem::new(
            format!("joint {number} has {} usable rows", kept.len()),
            format!("a joint motion needs at least {FEWEST_ROWS} rows without an empty cell"),
        )
        .at_line(table.first_line));
    }
    match kept.windows(2).find(|w| time[w[1]] <= time[w[0]]) {
        None => Ok(()),
        Some(w) => Err(Problem::new(
            format!("two rows stand at the time {} s", time[w[0]]),
            "write the time with more digits, or take the repeated row out",
        )
        .in_column("time_s")
        .at_line(table.line_of(w[1]))),
    }
}

/// The link encoder shows what was `delay` ago: the motor's channels are read as much earlier.
fn undo_declared_delay(joint: &mut JointRecord) {
    let Some(delay) = joint.delay.filter(|d| *d != 0.0) else {
        return;
    };
    let earlier = |channel: &[f64]| -> Vec<f64> {
        let at = |t: &f64| interpolate(&joint.time, channel, t - delay);
        joint.time.iter().map(at).collect()
    };
    (joint.motor, joint.torque) = (earlier(&joint.motor), earlier(&joint.torque));
}
