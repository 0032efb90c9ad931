//! Reads tables of Denavit and Hartenberg: TOML with `[[joints]]`, or CSV with the same keys as columns
//! and the rest as front matter.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::V3;
use crate::measurement::keys::{Document, Keys};

/// Where the a and α of a row stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convention {
    /// Behind the joint of the row (Denavit and Hartenberg 1955).
    Classic,
    /// Before it (Craig 1986).
    Modified,
}

impl Convention {
    /// What the robot file says of it.
    pub(super) fn note(self) -> &'static str {
        match self {
            Self::Classic => "geometry from a table of Denavit and Hartenberg, classic convention",
            Self::Modified => {
                "geometry from a table of Denavit and Hartenberg, modified convention"
            }
        }
    }
}

/// The table of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct DhTable {
    /// Name of the robot.
    pub name: String,
    /// Who published it.
    pub source: String,
    /// Which convention.
    pub convention: Convention,
    /// A row per joint.
    pub rows: Vec<Row>,
    /// Tool centre point in the last frame, m.
    pub tool: V3,
    /// Mass of the whole robot, kg.
    pub mass_kg: Option<f64>,
}

/// One row.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// θ with the joint at zero, degrees.
    pub theta_deg: f64,
    /// d, m.
    pub d_m: f64,
    /// a, m.
    pub a_m: f64,
    /// α, degrees.
    pub alpha_deg: f64,
    /// Whether the maker counts the joint against z.
    pub reversed: bool,
    /// Where the bearing lies along z from the origin of the frame that the joint turns about, m.
    pub bearing_m: f64,
    /// Lowest and highest angle, degrees.
    pub limits_deg: [f64; 2],
    /// Highest speed, degrees/s.
    pub max_speed_deg_s: Option<f64>,
    /// Stiffness of the drive, N·m/rad.
    pub stiffness: Option<f64>,
    /// Of the bearing across the axis, N·m/rad.
    pub tilt_stiffness: Option<f64>,
    /// Relative standard deviation of both.
    pub rel_std: Option<f64>,
    /// Mass of the link moved, kg.
    pub mass_kg: Option<f64>,
}

const KEYS: &[&str] = &[
    "name",
    "source",
    "convention",
    "tool_m",
    "mass_kg",
    "notes",
    "joints",
];
const COLUMNS: &[&str] = &[
    "theta_deg",
    "d_m",
    "a_m",
    "alpha_deg",
    "sign",
    "bearing_m",
    "low_deg",
    "high_deg",
    "max_speed_deg_s",
    "stiffness_Nm_rad",
    "tilt_stiffness_Nm_rad",
    "stiffness_rel_std",
    "mass_kg",
];
/// Most joints of a robot.
const MOST: usize = 64;

/// Reads a table. `convention` goes before what the table says.
///
/// # Errors
/// A table that does not say its convention, a missing or unknown key, a number that is none: with line.
pub fn read(text: &str, convention: Option<Convention>) -> Outcome<DhTable> {
    let text = text.trim_start_matches('\u{feff}');
    let as_toml = match is_csv(text) {
        true => rows_as_toml(text)?,
        false => text.to_string(),
    };
    let document = Document::parse(&as_toml)?;
    let keys = document.keys(KEYS)?;
    let words = [
        ("classic", Convention::Classic),
        ("modified", Convention::Modified),
    ];
    let stated = keys.choice("convention", &words)?;
    let convention = convention.or(stated).ok_or_else(|| {
        keys.missing(
            "convention",
            "convention = \"classic\"` or `convention = \"modified\"",
        )
    })?;
    let rows = keys.tables("joints", COLUMNS)?;
    let rows = rows.iter().map(row).collect::<Outcome<Vec<Row>>>()?;
    if rows.is_empty() || rows.len() > MOST {
        let what = format!("{} joints", rows.len());
        return Err(Problem::new(what, "give one row per joint, A1 first").in_column("joints"));
    }
    Ok(DhTable {
        name: keys.text("name")?.unwrap_or("robot").into(),
        source: keys.text("source")?.unwrap_or("").into(),
        convention,
        rows,
        tool: keys.vector("tool_m")?.unwrap_or_default(),
        mass_kg: keys.positive("mass_kg")?,
    })
}

fn row(keys: &Keys) -> Outcome<Row> {
    let needed = |key: &str| {
        let found = keys.number(key)?;
        found.ok_or_else(|| keys.missing(key, &format!("{key} = 0.0")))
    };
    let sign = keys.number("sign")?.unwrap_or(1.0);
    if sign.abs() != 1.0 {
        let what = format!("is {sign}, which is no sign");
        return Err(keys.problem(
            "sign",
            what,
            "write 1, or -1 where the maker counts against z",
        ));
    }
    let low = keys.number("low_deg")?.unwrap_or(-180.0);
    let high = keys.number("high_deg")?.unwrap_or(180.0);
    if low >= high {
        let what = format!("lies at {high}, not above low_deg = {low}");
        return Err(keys.problem("high_deg", what, "give the lower limit first"));
    }
    Ok(Row {
        theta_deg: needed("theta_deg")?,
        d_m: needed("d_m")?,
        a_m: needed("a_m")?,
        alpha_deg: needed("alpha_deg")?,
        reversed: sign < 0.0,
        bearing_m: keys.number("bearing_m")?.unwrap_or(0.0),
        limits_deg: [low, high],
        max_speed_deg_s: keys.positive("max_speed_deg_s")?,
        stiffness: keys.positive("stiffness_Nm_rad")?,
        tilt_stiffness: keys.positive("tilt_stiffness_Nm_rad")?,
        rel_std: keys.positive("stiffness_rel_std")?,
        mass_kg: keys.positive("mass_kg")?,
    })
}

/// Whether the first line that is neither empty nor a comment names columns.
fn is_csv(text: &str) -> bool {
    let first = text
        .lines()
        .map(str::trim)
        .find(|line| !line.is_empty() && !line.starts_with('#'));
    first.is_some_and(|line| !line.contains('=') && !line.starts_with('['))
}

/// The same as TOML, line for line: front matter without `#`, then one inline table per row.
fn rows_as_toml(text: &str) -> Outcome<String> {
    let mut out = String::new();
    let mut columns: Option<(Vec<String>, char)> = None;
    for (i, line) in text.lines().enumerate() {
        let line = line.trim();
        match (&columns, line.strip_prefix('#')) {
            (None, Some(fact)) => out.push_str(fact.trim()),
            (_, Some(_)) => {}
            (_, None) if line.is_empty() => {}
            (None, None) => {
                let mark = [';', '\t']
                    .into_iter()
                    .find(|mark| line.contains(*mark))
                    .unwrap_or(',');
                columns = Some((cells(line, mark), mark));
                out.push_str("joints = [");
            }
            (Some((names, mark)), None) => out.push_str(&inline(line, names, *mark, i + 1)?),
        }
        out.push('\n');
    }
    Ok(match columns {
        Some(_) => out.trim_end().to_string() + "]\n",
        None => out,
    })
}

fn cells(line: &str, mark: char) -> Vec<String> {
    line.split(mark)
        .map(|cell| cell.trim().trim_matches('"').to_string())
        .collect()
}

fn inline(line: &str, names: &[String], mark: char, number: usize) -> Outcome<String> {
    let values = cells(line, mark);
    if values.len() != names.len() {
        let what = format!("{} cells under {} titles", values.len(), names.len());
        return Err(Problem::new(what, "give every row a cell per column").at_line(number));
    }
    let mut pairs = Vec::new();
    for (name, value) in names
        .iter()
        .zip(&values)
        .filter(|(_, value)| !value.is_empty())
    {
        let decimal = match mark {
            ',' => value.clone(),
            _ => value.replace(',', "."),
        };
        let parsed: f64 = decimal.parse().map_err(|_| {
            let what = format!("`{value}` is not a number");
            Problem::new(what, "write a number, or leave the cell empty")
                .in_column(name)
                .at_line(number)
        })?;
        pairs.push(format!(
            "\"{}\" = {parsed:e}",
            name.replace(['"', '\\'], "")
        ));
    }
    Ok(format!("{{ {} }},", pairs.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CSV: &str = "# name = \"two\"\n# convention = \"classic\"\n\ntheta_deg;d_m;a_m;alpha_deg;stiffness_Nm_rad\n0;0,5;0,3;-90;2e6\n0;0;1;0;\n";

    #[test]
    fn csv_and_toml_say_the_same() {
        let toml = "name = \"two\"\nconvention = \"classic\"\n[[joints]]\ntheta_deg = 0\nd_m = 0.5\na_m = 0.3\nalpha_deg = -90\nstiffness_Nm_rad = 2e6\n[[joints]]\ntheta_deg = 0\nd_m = 0\na_m = 1\nalpha_deg = 0\n";
        assert_eq!(read(CSV, None).unwrap(), read(toml, None).unwrap());
    }

    #[test]
    fn faults_name_their_line() {
        let cases = [
            (CSV.replace("0;0;1;0;", "0;0;x;0;"), 6, "`x`"),
            (CSV.replace("0;0;1;0;", "0;0;;0;"), 6, "missing"),
            (CSV.replace("0;0;1;0;", "0;0;1"), 6, "cells"),
            (CSV.replace("a_m", "a_mm"), 5, "a_m"),
        ];
        for (text, line, says) in cases {
            let problem = read(&text, None).unwrap_err();
            assert_eq!(problem.line, Some(line), "{problem}");
            assert!(problem.to_string().contains(says), "{problem}");
        }
        let silent = CSV.replace("# convention = \"classic\"\n", "\n");
        assert!(read(&silent, None).unwrap_err().remedy.contains("modified"));
        assert!(read(&silent, Some(Convention::Modified)).is_ok());
    }
}
