//! Kind `load-cycle`: load and deflection of one axis over several tension/compression cycles.

use super::front::Front;
use super::table::Table;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;
use std::path::{Path, PathBuf};

/// Whether a joint turns or a linear spring is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Port {
    /// Load N·m, deflection rad.
    Rotational,
    /// Load N, deflection m.
    Linear,
}

impl Port {
    /// Unit of the load.
    pub fn load_unit(self) -> &'static str {
        match self {
            Self::Rotational => "N·m",
            Self::Linear => "N",
        }
    }
    /// Unit of the deflection.
    pub fn deflection_unit(self) -> &'static str {
        match self {
            Self::Rotational => "rad",
            Self::Linear => "m",
        }
    }
    /// Unit of the stiffness.
    pub fn stiffness_unit(self) -> &'static str {
        match self {
            Self::Rotational => "N·m/rad",
            Self::Linear => "N/m",
        }
    }
    /// What the load is called.
    pub fn load_name(self) -> &'static str {
        match self {
            Self::Rotational => "Moment",
            Self::Linear => "Force",
        }
    }
    /// What the deflection is called.
    pub fn deflection_name(self) -> &'static str {
        match self {
            Self::Rotational => "Angle",
            Self::Linear => "Displacement",
        }
    }
}

/// Which elasticity of the joint was loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// About the drive axis.
    Rotation,
    /// Across it: the bearing.
    Tilt,
}

/// The facts of a load-cycle file, SI.
#[derive(Debug, Clone, Default)]
pub struct Facts {
    /// Robot name or file.
    pub robot: Option<String>,
    /// Joint number 1..6.
    pub joint: Option<usize>,
    /// Rotation or tilt.
    pub axis: Option<Axis>,
    /// Lever of the force, m.
    pub load_lever: Option<f64>,
    /// Lever of the first displacement sensor, m.
    pub sensor_lever: Option<f64>,
    /// Lever of the second, m.
    pub sensor2_lever: Option<f64>,
    /// Duration of the unloaded start, s.
    pub rest: Option<f64>,
    /// Stiffness the simulation uses at present, N·m/rad (N/m for a linear spring).
    pub nominal_stiffness: Option<f64>,
    /// Its relative standard deviation.
    pub nominal_rel_std: Option<f64>,
    /// Relative standard deviation of each lever.
    pub lever_rel_std: Option<f64>,
    /// Data-sheet noise of the displacement sensor, m.
    pub sensor_noise: Option<f64>,
    /// Declared delay of the deflection channel behind the load channel, s.
    pub sensor_delay: f64,
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

/// Relative standard deviation of a lever that nobody stated.
pub const LEVER_REL_STD: f64 = 0.003;

/// Relative standard deviation that the levers of a file leave in its stiffness: in
/// k = F·a / (x/b) the lever a of the load and the lever b of the sensor stand once each, measured
/// one by one. Without levers (moment and angle in the file) there is none.
pub fn lever_spread(front: &Front) -> Outcome<f64> {
    let each = front
        .not_negative("lever_rel_std")?
        .unwrap_or(LEVER_REL_STD);
    let stated = ["load_lever_m", "sensor_lever_m"].map(|key| front.facts.contains_key(key));
    let levers = stated.into_iter().filter(|given| *given).count();
    Ok(each * (levers as f64).sqrt())
}

/// One load-cycle file, SI, rows with a missing load or deflection left out (and counted).
#[derive(Debug, Clone)]
pub struct LoadCycle {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub facts: Facts,
    /// Rotational or linear.
    pub port: Port,
    /// Time, s.
    pub time: Vec<f64>,
    /// Moment N·m or force N.
    pub load: Vec<f64>,
    /// Angle rad or displacement m, first sensor.
    pub deflection: Vec<f64>,
    /// The same from the second sensor; NaN where missing.
    pub second: Option<Vec<f64>>,
    /// Data rows of the file.
    pub rows: usize,
    /// Rows left out because a cell was empty.
    pub left_out: usize,
    /// First row of data in the file (1-based line), to point at rows.
    pub first_line: usize,
    /// What was converted into what, one line per channel.
    pub conversions: Vec<String>,
    /// How the file was written: delimiter and decimal sign.
    pub dialect: String,
}

impl LoadCycle {
    /// Reads a file of kind `load-cycle`.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::from_table(Table::read(path)?).map_err(|problem| problem.in_file(path))
    }

    /// Interprets a table that was read already.
    pub fn from_table(table: Table) -> Outcome<Self> {
        table.front.expect_kind("load-cycle")?;
        let facts = Facts::of(&table.front)?;
        let ports = Channels::find(&table, &facts)?;
        ports.check_facts(&table.front, &facts)?;
        let cycle = ports.assemble(table, facts)?;
        cycle.check_rows()?;
        Ok(cycle)
    }

    /// Name of the place: `A6`, `A6-tilt`, or `spring` for a linear one.
    pub fn site(&self) -> String {
        match (self.facts.joint, self.facts.axis) {
            (Some(joint), Some(Axis::Tilt)) => format!("A{joint}-tilt"),
            (Some(joint), _) => format!("A{joint}"),
            _ => "spring".to_string(),
        }
    }

    /// File name without its ending.
    pub fn stem(&self) -> String {
        let stem = self
            .path
            .file_stem()
            .map(|s| s.to_string_lossy().to_string());
        stem.unwrap_or_else(|| "measurement".into())
    }

    fn check_rows(&self) -> Outcome<()> {
        if self.load.len() >= 4 {
            return Ok(());
        }
        Err(Problem::new(
            format!(
                "holds {} usable row{} ({} of {} left out for an empty cell)",
                self.load.len(),
                if self.load.len() == 1 { "" } else { "s" },
                self.left_out,
                self.rows
            ),
            "a load cycle needs at least 4 rows with time, load and deflection",
        )
        .at_line(self.first_line))
    }
}

/// Time must not run backwards; missing cells do not count.
fn check_time(table: &Table) -> Outcome<()> {
    let Some((column, time)) = table.column("time").and_then(|c| Some((c, c.numbers()?))) else {
        return Ok(());
    };
    let mut before = f64::NEG_INFINITY;
    for (row, now) in time.iter().enumerate().filter(|(_, t)| !t.is_nan()) {
        if *now < before {
            return Err(Problem::new(
                format!("time runs backwards, from {before} s to {now} s"),
                "sort the rows by time, or split the file into one per run",
            )
            .in_column(&column.name)
            .at_line(table.line_of(row)));
        }
        before = *now;
    }
    Ok(())
}

impl Facts {
    fn of(front: &Front) -> Outcome<Self> {
        Ok(Self {
            robot: front.text("robot")?.map(str::to_string),
            joint: joint_of(front)?,
            axis: axis_of(front)?,
            load_lever: front.positive("load_lever_m")?,
            sensor_lever: front.positive("sensor_lever_m")?,
            sensor2_lever: front.positive("sensor2_lever_m")?,
            rest: front.not_negative("rest_s")?,
            nominal_stiffness: match front.positive("nominal_stiffness_Nm_rad")? {
                None => front.positive("nominal_stiffness_N_m")?,
                some => some,
            },
            nominal_rel_std: front.not_negative("nominal_stiffness_rel_std")?,
            lever_rel_std: front.not_negative("lever_rel_std")?,
            sensor_noise: front.not_negative("sensor_noise_mm")?.map(|mm| mm * 1e-3),
            sensor_delay: front.number("sensor_delay_s")?.unwrap_or(0.0),
            synthetic: front.synthetic(),
        })
    }
}

fn joint_of(front: &Front) -> Outcome<Option<usize>> {
    match front.number("joint")? {
        None => Ok(None),
        Some(j) if j.fract() == 0.0 && (1.0..=6.0).contains(&j) => Ok(Some(j as usize)),
        Some(j) => Err(front.problem("joint", format!("is {j}"), "give the joint as 1 to 6")),
    }
}

fn axis_of(front: &Front) -> Outcome<Option<Axis>> {
    match front.text("axis")? {
        None => Ok(None),
        Some("rotation") => Ok(Some(Axis::Rotation)),
        Some("tilt") => Ok(Some(Axis::Tilt)),
        Some(other) => Err(front.problem(
            "axis",
            format!("is `{other}`"),
            "write `rotation` (about the drive axis) or `tilt` (across it)",
        )),
    }
}

/// Which columns carry load and deflection, and how they become SI at the joint.
struct Channels {
    port: Port,
    load: (&'static str, f64),
    deflection: (&'static str, f64),
    second: Option<(&'static str, f64)>,
}

/// The columns of the kind and what each must measure.
const COLUMNS: &[(&str, Dimension)] = &[
    ("time", Dimension::Time),
    ("force", Dimension::Force),
    ("moment", Dimension::Moment),
    ("displacement", Dimension::Length),
    ("displacement2", Dimension::Length),
    ("angle", Dimension::Angle),
    ("angle2", Dimension::Angle),
];

impl Channels {
    fn find(table: &Table, facts: &Facts) -> Outcome<Self> {
        check_dimensions(table)?;
        let has = |stem: &str| table.column(stem).is_some();
        let header = table.first_line - 1;
        let missing = |what: &str, remedy: &str| Problem::new(what, remedy).at_line(header);
        if !has("time") {
            return Err(missing("has no time column", "add a column `time_s`"));
        }
        let turning =
            has("moment") || has("angle") || facts.load_lever.or(facts.sensor_lever).is_some();
        let port = if turning {
            Port::Rotational
        } else {
            Port::Linear
        };
        let load = match (has("moment"), has("force")) {
            (true, false) => ("moment", 1.0),
            (false, true) => (
                "force",
                lever(turning, facts.load_lever, &table.front, "load_lever_m")?,
            ),
            (true, true) => {
                return Err(missing("has both moment and force", "keep one load column"));
            }
            _ => {
                return Err(missing(
                    "has no load column",
                    "add `force_N`, or `moment_Nm`",
                ));
            }
        };
        let deflection = match (has("angle"), has("displacement")) {
            (true, false) => ("angle", 1.0),
            (false, true) => {
                let lever = lever(turning, facts.sensor_lever, &table.front, "sensor_lever_m")?;
                ("displacement", 1.0 / lever)
            }
            (true, true) => {
                return Err(missing(
                    "has both angle and displacement",
                    "keep one deflection column",
                ));
            }
            _ => {
                return Err(missing(
                    "has no deflection column",
                    "add `displacement_mm`, or `angle_mrad`",
                ));
            }
        };
        let second = match (has("angle2"), has("displacement2")) {
            (true, _) => Some(("angle2", 1.0)),
            (_, true) => {
                let lever = lever(
                    turning,
                    facts.sensor2_lever,
                    &table.front,
                    "sensor2_lever_m",
                )?;
                Some(("displacement2", 1.0 / lever))
            }
            _ => None,
        };
        Ok(Self {
            port,
            load,
            deflection,
            second,
        })
    }

    fn check_facts(&self, front: &Front, facts: &Facts) -> Outcome<()> {
        if self.port == Port::Linear {
            return Ok(());
        }
        let missing = |key: &str, remedy: &str| {
            Problem::new(format!("the fact `{key}` is missing"), remedy).at_line(1)
        };
        if front.facts.get("joint").is_none() {
            return Err(missing("joint", "add `# joint = 6`: which axis was loaded"));
        }
        if facts.axis.is_none() {
            return Err(missing("axis", "add `# axis = \"rotation\"` or `\"tilt\"`"));
        }
        Ok(())
    }

    fn assemble(self, mut table: Table, facts: Facts) -> Outcome<LoadCycle> {
        check_time(&table)?;
        let conversions = self.conversions(&table, &facts);
        let time = take(&mut table, "time", 1.0);
        let load = take(&mut table, self.load.0, self.load.1);
        let deflection = take(&mut table, self.deflection.0, self.deflection.1);
        let second = self
            .second
            .map(|(stem, factor)| take(&mut table, stem, factor));
        let mut cycle = LoadCycle {
            sha256: std::mem::take(&mut table.sha256),
            dialect: dialect(&table),
            facts,
            port: self.port,
            time,
            load,
            deflection,
            second,
            rows: table.rows,
            left_out: 0,
            first_line: table.first_line,
            conversions,
            path: table.path,
        };
        cycle.leave_out_missing();
        cycle.undo_declared_delay();
        Ok(cycle)
    }

    fn conversions(&self, table: &Table, facts: &Facts) -> Vec<String> {
        let name = |stem: &str| table.column(stem).map_or(String::new(), |c| c.name.clone());
        let mut lines = vec![format!("time from `{}`", name("time"))];
        let lever = |value: Option<f64>| match value {
            Some(lever) if self.port == Port::Rotational => format!(" at a lever of {lever} m"),
            _ => String::new(),
        };
        let load = if self.load.0 == "force" {
            lever(facts.load_lever)
        } else {
            String::new()
        };
        lines.push(format!(
            "load in {} from `{}`{load}",
            self.port.load_unit(),
            name(self.load.0)
        ));
        let unit = self.port.deflection_unit();
        let sensor = |stem: &str, value| match stem.starts_with("displacement") {
            true => lever(value),
            false => String::new(),
        };
        lines.push(format!(
            "deflection in {unit} from `{}`{}",
            name(self.deflection.0),
            sensor(self.deflection.0, facts.sensor_lever)
        ));
        if let Some((stem, _)) = self.second {
            lines.push(format!(
                "second deflection in {unit} from `{}`{}",
                name(stem),
                sensor(stem, facts.sensor2_lever)
            ));
        }
        lines
    }
}

fn check_dimensions(table: &Table) -> Outcome<()> {
    for column in &table.columns {
        let Some((_, wanted)) = COLUMNS.iter().find(|(stem, _)| *stem == column.stem) else {
            continue;
        };
        if column.dimension != Some(*wanted) {
            return Err(Problem::new(
                format!(
                    "is in a unit of {:?}, expected {wanted:?}",
                    column.dimension.unwrap_or(*wanted)
                ),
                "correct the unit at the end of the name, or swap the columns back",
            )
            .in_column(&column.name)
            .at_line(table.first_line - 1));
        }
    }
    Ok(())
}

fn lever(turning: bool, value: Option<f64>, front: &Front, key: &str) -> Outcome<f64> {
    match (turning, value) {
        (false, _) => Ok(1.0),
        (true, Some(lever)) => Ok(lever),
        (true, None) => Err(front.problem(
            key,
            format!("the fact `{key}` is missing"),
            format!(
                "add `# {key} = 0.8`: without it this channel does not become a moment or an angle"
            ),
        )),
    }
}

fn take(table: &mut Table, stem: &str, factor: f64) -> Vec<f64> {
    let column = table.columns.iter_mut().find(|column| column.stem == stem);
    let mut values = match column.map(|c| &mut c.cells) {
        Some(super::table::Cells::Numbers(values)) => std::mem::take(values),
        _ => Vec::new(),
    };
    if factor != 1.0 {
        values.iter_mut().for_each(|v| *v *= factor);
    }
    values
}

fn dialect(table: &Table) -> String {
    let delimiter = match table.delimiter {
        '\t' => "tab".to_string(),
        other => format!("`{other}`"),
    };
    let sign = if table.decimal_comma {
        "comma"
    } else {
        "point"
    };
    format!("delimiter {delimiter}, decimal {sign}")
}

impl LoadCycle {
    fn leave_out_missing(&mut self) {
        let keep: Vec<bool> = (0..self.time.len())
            .map(|i| {
                !(self.time[i].is_nan() || self.load[i].is_nan() || self.deflection[i].is_nan())
            })
            .collect();
        self.left_out = keep.iter().filter(|k| !**k).count();
        if self.left_out == 0 {
            return;
        }
        let channels = [
            Some(&mut self.time),
            Some(&mut self.load),
            Some(&mut self.deflection),
            self.second.as_mut(),
        ];
        for channel in channels.into_iter().flatten() {
            let mut kept = keep.iter();
            channel.retain(|_| *kept.next().unwrap_or(&true));
        }
    }

    /// A declared delay of the deflection channel is taken out by reading the load later.
    fn undo_declared_delay(&mut self) {
        if self.facts.sensor_delay == 0.0 {
            return;
        }
        let delay = self.facts.sensor_delay;
        self.load = self
            .time
            .iter()
            .map(|t| interpolate(&self.time, &self.load, t - delay))
            .collect();
        self.conversions
            .push(format!("load shifted by the declared delay of {delay} s"));
    }
}

/// Linear interpolation in ascending `x`, constant beyond its ends.
pub fn interpolate(x: &[f64], y: &[f64], at: f64) -> f64 {
    let i = x.partition_point(|v| *v <= at);
    if i == 0 {
        return y[0];
    }
    if i == x.len() {
        return y[i - 1];
    }
    let (x0, x1) = (x[i - 1], x[i]);
    y[i - 1] + (y[i] - y[i - 1]) * ((at - x0) / (x1 - x0))
}
