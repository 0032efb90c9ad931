//! Which columns carry load and deflection, and how they become SI at the joint.

use super::LoadCycle;
use super::facts::Facts;
use super::port::Port;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;
use crate::measurement::front::Front;
use crate::measurement::table::{Cells, Table};

/// Which columns carry load and deflection, and how they become SI at the joint.
pub(super) struct Channels {
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
    pub(super) fn find(table: &Table, facts: &Facts) -> Outcome<Self> {
        check_dimensions(table)?;
        let has = |stem: &str| table.column(stem).is_some();
        let header = table.first_line - 1;
        let missing = |what: &str, remedy: &str| Problem::new(what, remedy).at_line(header);
        let needs_time = [facts.rest.is_some(), facts.sensor_delay != 0.0];
        if !has("time") && needs_time.contains(&true) {
            let what = "has no time column, which `rest_s` and `sensor_delay_s` speak of";
            return Err(missing(what, "add a column `time_s`, or remove the fact"));
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

    pub(super) fn check_facts(&self, front: &Front, facts: &Facts) -> Outcome<()> {
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

    pub(super) fn assemble(self, mut table: Table, facts: Facts) -> Outcome<LoadCycle> {
        check_time(&table)?;
        let conversions = self.conversions(&table, &facts);
        let counts_rows = table.column("time").is_none();
        let time = match counts_rows {
            true => (0..table.rows).map(|row| row as f64).collect(),
            false => take(&mut table, "time", 1.0),
        };
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
            counts_rows,
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
        let mut lines = vec![match table.column("time") {
            Some(own) => format!("time from `{}`", own.name),
            None => "time not given: rows are counted".into(),
        }];
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

/// Time must not run backwards; missing cells do not count.
pub(crate) fn check_time(table: &Table) -> Outcome<()> {
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

fn check_dimensions(table: &Table) -> Outcome<()> {
    for column in &table.columns {
        let Some((_, wanted)) = COLUMNS.iter().find(|(stem, _)| *stem == column.stem) else {
            continue;
        };
        if column.dimension != Some(*wanted) {
            return Err(column.misplaced(*wanted, table.first_line - 1));
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
        Some(Cells::Numbers(values)) => std::mem::take(values),
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
